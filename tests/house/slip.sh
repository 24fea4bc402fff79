#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# slip.sh ROOT BUILD: the survey slip with few cases in large cells: what does not slip sends nothing back, what does
# sends what the closed form says, and pictures are there.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
out=$work/out
survey() {
  "$root/surveys/run" slip OUT="$out" STEP=10 FRICTIONS='0 1' VISCOSITIES='0 25600' DIPS='0 45' FREQUENCIES=20 ANGLES=30 "$@"
}

said=$(survey)
printf '%s\n' "$said"
response() { awk -v name="$1" '$1 == name { print $4 }' "$out/response.txt"; }
less() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && b != "" && a + 0 < b + 0) }'; }
less "$(response dip-0)" 0.1 || broken "planes across the wave send $(response dip-0) % back"
less 2 "$(response dip-45)" || broken "planes at 45 degrees send $(response dip-45) % back"
less "$(response friction-1)" "$(response friction-0)" || broken 'friction takes nothing off the response'
less "$(response viscosity-25600)" "$(response viscosity-0)" || broken 'viscosity takes nothing off the response'
# Within a tenth of the closed form at all frequencies from 20 Hz on.
awk '
  /^angle/ { exact = $NF; next }
  $1 + 0 >= 20 { seen++; for (n = 2; n <= 3; n++) if ($n < 0.9 * exact || $n > 1.1 * exact) { print; bad = 1 } }
  END { exit bad || seen < 5 }' "$out/linear.txt" || broken 'the linear limit is another than the closed form says'
for picture in friction viscosity dip frequency traces-dip-0 traces-dip-45 model; do
  [ -s "$out/$picture.png" ] || broken "there is no $picture.png"
done

plan=$(survey -n)
case $plan in
  */sw-shoot\ * | */sw-plot\ *) broken "make wants to do again what is there: $plan" ;;
esac
exit "$status"
