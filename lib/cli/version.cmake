# SPDX-License-Identifier: BSD-3-Clause
# cmake -DROOT= -DRELEASE= -DOUTPUT= -P version.cmake: writes the version as a header, when it has changed.
# Of a git checkout it names the last commit that touches what the tools are made of, so that other commits build nothing
# again; without git (a tarball) it is the release of CMakeLists.txt.
#   0.2.0                    the commit tagged v0.2.0
#   0.2.0+5.g1a2b3c4         five commits after that tag
#   0.2.0-dev.812+g1a2b3c4   no tag yet; the 812th commit
#   ... .changed             with changes that are not committed
set(made_of lib tools CMakeLists.txt)
set(version ${RELEASE})

# git_says VARIABLE ARGUMENT...: what git says, or an empty string.
function(git_says variable)
  execute_process(COMMAND git --no-optional-locks -C ${ROOT} ${ARGN} OUTPUT_VARIABLE said RESULT_VARIABLE failed ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(said "")
  endif()
  set(${variable} "${said}" PARENT_SCOPE)
endfunction()

# A tarball may lie in somebody else's checkout.
git_says(prefix rev-parse --show-cdup --is-inside-work-tree)
if(prefix STREQUAL "\ntrue" OR prefix STREQUAL "true")
  git_says(commit log -1 --format=%h -- ${made_of})
endif()
if(commit)
  git_says(tag describe --tags --exact-match --match v[0-9]* HEAD)
  git_says(since describe --tags --long --match v[0-9]* ${commit})
  if(tag)
    string(SUBSTRING ${tag} 1 -1 version)
  elseif(since MATCHES "^v(.*)-([0-9]+)-(g[0-9a-f]+)$")
    set(version ${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
  else()
    git_says(count rev-list --count ${commit})
    set(version ${RELEASE}-dev.${count}+g${commit})
  endif()
  git_says(changed status --porcelain --untracked-files=no -- ${made_of})
  if(changed)
    set(version ${version}.changed)
  endif()
endif()

if(OUTPUT)
  file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n\nconstexpr char version_text[] = \"${version}\";\n")
endif()
