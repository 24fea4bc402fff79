#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# help.sh ROOT BIN TOOL...: --help fits a screen and ends with its example; --help-all names what it names and more; every
# tool has a man page that names the same options, all exit statuses and an example.
set -eu
root=$1
bin=$2
shift 2
status=0
broken() {
  echo "$1"
  status=1
}

for source in "$root"/tools/sw_*.cpp; do
  tool=$(basename "$source" .cpp | tr _ -)
  case " $* " in
    *" $tool "*) ;;
    *) broken "tools/$(basename "$source"): $tool is not built: is it in SLIPWAVE_TOOLS?" ;;
  esac
done
for page in "$root"/docs/man/*.1; do
  tool=$(basename "$page" .1)
  [ -f "$root/tools/$(echo "$tool" | tr - _).cpp" ] || broken "docs/man/$tool.1: there is no such tool"
done

# "--size LXxLZ" for each option, without its short form.
in_help() { awk '/^  (-., )?--[a-z]/ { sub(/^  (-., )?/, ""); sub(/  .*/, ""); print }' | sort; }
# An option is documented by the line after .TP.
in_page() {
  awk '/^\.TP/ { getline; gsub(/\\f[BIRP]/, ""); gsub(/\\-/, "-"); sub(/^\.[BIR]+ /, ""); sub(/^-., /, ""); if (/^--/) print }' "$1" | sort
}
# lines_without LINES OTHERS: the lines that are not among the others.
lines_without() {
  printf '%s\n' "$1" | while IFS= read -r line; do
    [ -z "$line" ] || printf '%s\n' "$2" | grep -qxF -- "$line" || printf '%s; ' "$line"
  done
}

for tool in "$@"; do
  help=$("$bin/$tool" --help 2>&1) || { broken "$tool --help: exit status $?"; continue; }
  [ "$(printf '%s\n' "$help" | wc -l)" -le 60 ] || broken "$tool --help: longer than a screen of 60 lines"
  all=$("$bin/$tool" --help-all 2>&1) || { broken "$tool --help-all: exit status $?"; continue; }
  wide=$(printf '%s\n%s\n' "$help" "$all" | awk 'length($0) > 80')
  [ -z "$wide" ] || broken "$tool --help-all: wider than 80 columns: $wide"
  example=$(printf '%s\n' "$help" | sed '1,/^Example:$/d')
  case $example in
    "  $tool "*) ! printf '%s\n' "$example" | grep -q '^[^ ]' ;;
    *) false ;;
  esac || broken "$tool --help: does not end with its example"

  page=$root/docs/man/$tool.1
  [ -f "$page" ] || { broken "docs/man/$tool.1 is missing"; continue; }
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES; do
    grep -qE "^\\.SH \"?$section\"?\$" "$page" || broken "docs/man/$tool.1: no section $section"
  done
  for code in 0 1 2 128+N; do
    sed -n '/^\.SH EXIT STATUS/,/^\.SH EXAMPLES/p' "$page" | grep -qxF ".B $code" ||
      broken "docs/man/$tool.1: no exit status $code"
  done
  common=$(printf '%s\n' "$help" | in_help)
  declared=$(printf '%s\n' "$all" | in_help)
  missing=$(lines_without "$common" "$declared")
  [ -z "$missing" ] || broken "$tool --help-all does not list: $missing"
  documented=$(in_page "$page")
  missing=$(lines_without "$declared" "$documented")
  [ -z "$missing" ] || broken "docs/man/$tool.1 does not document: $missing"
  invented=$(lines_without "$documented" "$declared")
  [ -z "$invented" ] || broken "docs/man/$tool.1 documents what $tool --help-all does not list: $invented"
done
exit "$status"
