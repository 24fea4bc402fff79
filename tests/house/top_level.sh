#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# top_level.sh ROOT: the top of the house holds its rooms and nothing else; names are plain.
set -eu
cd "$1"
status=0
for entry in *; do
  case $entry in
    tools | lib | surveys | tests | docs | CMakeLists.txt | CMakePresets.json | README.md) ;;
    build) ;; # ignored by git
    *)
      echo "$entry: the top level holds tools, lib, surveys, tests, docs, the CMake files and README.md only"
      status=1
      ;;
  esac
done
names=$(find lib tools surveys tests docs -name '*[!A-Za-z0-9._-]*' | sort)
if [ -n "$names" ]; then
  printf '%s: a plain file name is of letters, digits, ".", "_" and "-"\n' "$names"
  status=1
fi
exit "$status"
