#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# licence.sh ROOT [--write]: every source begins with the line of its licence, behind a #! where it has one.
# --write puts the line where it is missing and replaces another one; twice is once.
# Read as a whole before it runs, since it writes itself, too.
{
set -eu
cd "$1"
licence=BSD-3-Clause
tag='SPDX-License-Identifier'
faults=$(find .ci lib tools surveys tests docs CMakeLists.txt -type f ! -path 'surveys/*/out/*' ! -path '*/__pycache__/*' 2>/dev/null | sort |
while IFS= read -r file; do
  case ${file##*/} in
    *.cpp | *.hpp) mark='//' ;;
    *.1) mark='.\"' ;;
    *.sh | *.py | *.awk | *.mk | *.cmake | Makefile | CMakeLists.txt | Dockerfile) mark='#' ;;
    *.*) continue ;;
    # Scripts that bear no ending.
    *) case $(head -c 2 "$file") in '#!') mark='#' ;; *) continue ;; esac ;;
  esac
  wanted="$mark $tag: $licence"
  case $(head -c 2 "$file") in '#!') at=2 ;; *) at=1 ;; esac
  if [ "$(sed -n "${at}p" "$file")" = "$wanted" ] && [ "$(head -n 5 "$file" | grep -c "$tag: ")" = 1 ]; then continue; fi
  if [ "${2-}" != --write ]; then
    echo "$file: line $at should be '$wanted' (sh tests/house/licence.sh . --write)"
    continue
  fi
  made=$(mktemp)
  wanted=$wanted awk -v at="$at" -v tag="$tag: " '
    at == 1 && NR == 1 { print ENVIRON["wanted"] }
    NR > 5 || !index($0, tag) { print }
    at == 2 && NR == 1 { print ENVIRON["wanted"] }' "$file" > "$made"
  # Into the file that is there, which keeps its mode.
  cat "$made" > "$file"
  rm -f "$made"
done)
[ -z "$faults" ] || { printf '%s\n' "$faults"; exit 1; }
exit 0
}
