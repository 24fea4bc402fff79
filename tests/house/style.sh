#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# style.sh ROOT: what the house keeps out of its sources, and how long a function may be.
set -eu
cd "$1"
status=0

# No function longer than 60 lines. As clang-format leaves it, one outside or inside a class ends with a brace alone, at
# the indentation where it begins; blocks of a function do so too, but are shorter than it.
long=$(find lib tools -name '*.?pp' | sort | xargs awk -v most=60 '
  function tell(  line) {
    for (line in inner) print name inner[line]
    split("", inner)
  }
  FNR == 1 { tell(); split("", begin); name = FILENAME ":" }
  /^(  )?[[:alpha:]_~:[]/ {
    match($0, /^ */)
    begin[RLENGTH] = FNR
  }
  /^(  )?}$/ {
    match($0, /^ */)
    from = begin[RLENGTH]
    if (FNR - from < most) next
    for (line in inner) if (line + 0 > from) delete inner[line]
    inner[from] = from ": a function of " FNR - from + 1 " lines, expected at most " most
  }
  END { tell() }')
[ -z "$long" ] || { printf '%s\n' "$long"; status=1; }

# forbid PATTERN REASON FILE... : no line of the files holds the pattern.
forbid() {
  pattern=$1
  reason=$2
  shift 2
  [ $# -gt 0 ] || return 0
  # /dev/null makes grep name the file even where there is one only.
  if found=$(grep -nE -- "$pattern" "$@" /dev/null); then
    printf '%s\n' "$found" | sed "s|\$|   <- $reason|"
    status=1
  fi
}

sources() { find "$@" -name '*.?pp' | sort; }
# File names hold no blanks (top_level.sh).
# shellcheck disable=SC2046
{
  below_main=$(sources lib | grep -v '^lib/cli/' || :)
  # shellcheck disable=SC2086
  forbid 'std::(cout|cerr|clog)|(^|[^[:alnum:]_])(f?printf|puts|fputs|perror) *\(' 'nothing below main prints' $below_main
  # shellcheck disable=SC2086
  forbid '(^|[^[:alnum:]_])(std::)?(exit|abort|quick_exit|terminate) *\(' 'nothing below main exits' $below_main
  forbid '^ *# *define ' 'no macros' $(sources lib tools | grep -v '^lib/base/instantiate[.]hpp$')
  # Grids share the depths of their rows, which never change: each field of a model holds its grid.
  forbid 'shared_ptr' 'no shared ownership' $(sources lib tools | grep -v '^lib/grid/grid[.]hpp$')
  # ffmpeg is a program, named and told its words one by one there.
  forbid '(^|[^[:alnum:]_.>])(std::|::)?(system|popen|wordexp|posix_spawnp?|exec(l|le|lp|v|ve|vp|vpe))\(' \
    'no shell and no other program is started' $(sources lib tools | grep -v '^lib/plot/movie[.]cpp$')
  forbid 'using namespace std' 'names of std keep their std::' $(sources lib tools tests)
}
exit "$status"
