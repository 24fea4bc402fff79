#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# accuracy.sh ROOT BUILD: the survey accuracy with its short ladders: tables, pictures, what it leaves out and says so.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
out=$work/out
survey() { "$root/surveys/run" accuracy OUT="$out" SHORT=1 "$@"; }

said=$(survey ERROR=0.3)
printf '%s\n' "$said"
case $said in
  *'Marmousi-II is left out: make DATA=FOLDER'*) ;;
  *) broken 'Marmousi-II is left out without a word' ;;
esac
for scene in full-space paper water; do
  # Errors fall with the step, and the setting that is marked is good enough.
  awk -v scene="$scene" '
    /^#/ || $8 == "-" { next }
    { settings++ }
    last != "" && step != $4 && $8 + 0 > last { print scene ": " $8 " % at " $4 " m, " last " % at " step " m"; bad = 1 }
    { last = $8 + 0; step = $4 }
    /<$/ { chosen = $8 + 0 }
    END {
      if (settings < 2) { print scene ": " settings + 0 " settings"; bad = 1 }
      if (scene != "full-space" && !(chosen > 0 && chosen <= 30)) { print scene ": chosen: " chosen; bad = 1 }
      exit bad
    }' "$out/$scene.txt" || status=1
done
for picture in full-space paper water accuracy; do
  for format in png pdf; do
    [ -s "$out/$picture.$format" ] || broken "there is no $picture.$format"
  done
done
# Both corrections are compared, alone and in the whole field.
grep -q '^ *all vx ' "$out/corrections.txt" || broken "corrections.txt: $(cat "$out/corrections.txt")"

plan=$(survey ERROR=0.3 -n)
case $plan in
  */sw-accuracy\ * | */sw-plot\ *) broken "make wants to do again what is there: $plan" ;;
esac
exit "$status"
