#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# papers.sh ROOT BUILD: the surveys of the paper's figures with coarse cells: everything they tell of is made, both orders of
# slip are told apart, Marmousi-II and the model like it go the same way, another setting makes everything again.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
# survey NAME OUT ARGUMENT...
survey() {
  name=$1
  out=$work/$2
  shift 2
  "$root/surveys/run" "$name" OUT="$out" "$@"
}
# all_made NAME OUT: every file of the README's table is there and not empty.
all_made() {
  sed -n 's/^| \(`[^|]*`\) |.*/\1/p' "$root/surveys/$1/README.md" | tr -d '`,' | tr ' ' '\n' | grep -v '^$' |
    while read -r file; do
      [ -s "$work/$2/$file" ] || echo "$1: there is no $file"
    done
}
# share FILE HEADING: relative L2 of p behind that heading.
share() { awk -v heading="$2" '$0 == heading { on = 1 } on && $1 == "all" && $2 == "p" { print $4; exit }' "$1"; }

survey paper-plane-wave wave STEP=20 -j 2 >/dev/null 2>&1 || broken 'paper-plane-wave failed'
missing=$(all_made paper-plane-wave wave)
[ -z "$missing" ] || broken "$missing"
# In cells of 20 m as in fine ones the order of slip is some per mille of the field and some per cent of the response.
whole=$(share "$work/wave/corrections.txt" '# the whole field')
response=$(share "$work/wave/corrections.txt" '# what the fractures send back')
echo "$whole $response" | awk '{ exit !($1 > 5e-4 && $1 < 0.02 && $2 > 0.01 && $2 < 0.3) }' ||
  broken "corrections.txt: $(cat "$work/wave/corrections.txt")"

# 500 x 174 cells of one rock, as the files of Marmousi-II are.
mkdir "$work/data"
raw() {
  printf '%b' "$2" > "$work/four"
  for _ in $(seq 17); do
    cat "$work/four" "$work/four" > "$work/more"
    mv "$work/more" "$work/four"
  done
  head -c 348000 "$work/four" > "$work/data/marmousi_II_marine.$1"
}
raw vp '\0000\0200\0073\0105'  # 3000
raw vs '\0000\0200\0273\0104'  # 1500
raw rho '\0000\0000\0372\0104' # 2000
survey paper-marmousi sea STEP=40 -j 2 >/dev/null 2>&1 || broken 'paper-marmousi failed'
missing=$(all_made paper-marmousi sea)
[ -z "$missing" ] || broken "$missing"
plan=$(survey paper-marmousi sea STEP=40 -n)
case $plan in
  *'sw-shoot '*) broken "paper-marmousi wants to shoot again what is there: $plan" ;;
esac
plan=$(survey paper-marmousi sea STEP=40 DATA="$work/data" -n)
case $plan in
  *'sw-import '*'sw-shoot '*) ;;
  *) broken "paper-marmousi takes one model for the other: $plan" ;;
esac
survey paper-marmousi sea STEP=40 DATA="$work/data" summary >"$work/said" 2>&1 || broken 'paper-marmousi failed with DATA'
grep -q '^ *vp  *3000 m/s$' "$work/said" || broken "paper-marmousi did not take DATA: $(cat "$work/said")"
exit "$status"
