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
# begin_of FILE: sets $one to $five to its first lines. By the shell alone: a few processes for each file take seconds.
begin_of() {
  one='' two='' three='' four='' five=''
  { IFS= read -r one && IFS= read -r two && IFS= read -r three && IFS= read -r four && IFS= read -r five; } <"$1" || :
}
faults=$(find .ci lib tools surveys tests docs CMakeLists.txt -type f ! -path 'surveys/*/out/*' ! -path '*/__pycache__/*' 2>/dev/null | sort |
while IFS= read -r file; do
  case ${file##*/} in
    *.cpp | *.hpp) mark='//' ;;
    *.1) mark='.\"' ;;
    *.sh | *.py | *.awk | *.mk | *.cmake | Makefile | CMakeLists.txt | Dockerfile) mark='#' ;;
    *.*) continue ;;
    # Scripts that bear no ending.
    *) begin_of "$file"; case $one in '#!'*) mark='#' ;; *) continue ;; esac ;;
  esac
  wanted="$mark $tag: $licence"
  begin_of "$file"
  case $one in '#!'*) at=2 found=$two ;; *) at=1 found=$one ;; esac
  tags=0
  for line in "$one" "$two" "$three" "$four" "$five"; do
    case $line in *"$tag: "*) tags=$((tags + 1)) ;; esac
  done
  if [ "$found" = "$wanted" ] && [ "$tags" = 1 ]; then continue; fi
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
