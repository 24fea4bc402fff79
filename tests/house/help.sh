#!/bin/sh
# help.sh ROOT BIN TOOL...: --help fits a screen and ends with its example; every tool has a man page that
# names the same options, the exit status and an example.
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

options_in() { grep -oE -- '(^|[^[:alnum:]-])--[a-z][a-z0-9-]*' | sed 's/^[^-]*//' | sort -u; }

for tool in "$@"; do
  help=$("$bin/$tool" --help 2>&1) || { broken "$tool --help: exit status $?"; continue; }
  [ "$(printf '%s\n' "$help" | wc -l)" -le 60 ] || broken "$tool --help: longer than a screen of 60 lines"
  wide=$(printf '%s\n' "$help" | awk 'length($0) > 100')
  [ -z "$wide" ] || broken "$tool --help: wider than 100 columns: $wide"
  case $(printf '%s\n' "$help" | tail -n 1) in
    *"$tool "*) ;;
    *) broken "$tool --help: does not end with its example" ;;
  esac

  page=$root/docs/man/$tool.1
  [ -f "$page" ] || { broken "docs/man/$tool.1 is missing"; continue; }
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES; do
    grep -qE "^\\.SH \"?$section\"?\$" "$page" || broken "docs/man/$tool.1: no section $section"
  done
  # An option is documented by the tagged line after .TP.
  documented=$(awk '/^\.TP/ { getline; print }' "$page" | sed 's/\\-/-/g; s/\\f[BIRP]//g; s/"//g' | options_in)
  declared=$(printf '%s\n' "$help" | options_in)
  for option in $declared; do
    printf '%s\n' "$documented" | grep -qx -- "$option" || broken "docs/man/$tool.1: $option is not documented"
  done
  for option in $documented; do
    printf '%s\n' "$declared" | grep -qx -- "$option" || broken "docs/man/$tool.1: $tool has no option $option"
  done
done
exit "$status"
