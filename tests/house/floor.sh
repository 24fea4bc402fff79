#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# floor.sh ROOT BUILD: the survey floor in larger cells and with two shots: on the fitted grid the error is a fraction of that over
# stairs, and below that over stairs of half the height; what larger cells say of it stands beside it.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
out=$work/out
survey() { "$root/surveys/run" floor OUT="$out" STEP=10 SHOTS=2 "$@"; }

survey -j 2 >"$work/said" 2>"$work/told" || broken "the line failed: $(tail -n 2 "$work/told")"
grep -q '^ *shots  *2$' "$work/said" || broken "the line has not its two shots: $(cat "$work/said")"
grep -q 'fitted: floor at sine,260,12,600 dip 3, ' "$work/told" || broken "nobody says what is fitted: $(cat "$work/told")"
for picture in model shot error-fitted error-stairs near near-difference; do
  [ -s "$out/$picture.png" ] || broken "there is no $picture.png"
done
# All layers are fitted in one grid, none in the other.
"$root/surveys/run" floor -n >/dev/null || broken 'make -n failed'
[ "$("$SLIPWAVE_BUILD/bin/sw-info" "$out/fitted.nc" | grep -c 'fitted horizons')" = 3 ] || broken 'three horizons are not fitted'
if "$SLIPWAVE_BUILD/bin/sw-info" "$out/stairs.nc" | grep -q 'fitted horizons'; then broken 'the stairs are fitted'; fi

# Relative L2 errors, in the order of the file.
awk '/^#/ && /measured/ { what = $0 } /^ *all / { print $4 "\t" what }' "$out/errors.txt" > "$work/errors"
cat "$out/errors.txt"
awk -F '\t' '
  /measured, fitted/ { fitted = $1 }
  /measured, stairs$/ { stairs = $1 }
  /of half the size/ { half = $1 }
  END {
    if (!(fitted > 0 && fitted < 0.1)) { print "error on the fitted grid: " fitted ", expected below 0.1"; bad = 1 }
    if (!(stairs > 3 * fitted)) { print "error over stairs: " stairs ", on the fitted grid " fitted; bad = 1 }
    if (!(half > fitted)) { print "error over stairs of half the height: " half ", on the fitted grid " fitted; bad = 1 }
    exit bad
  }' "$work/errors" || status=1
grep -q 'measured error' "$out/plan-fitted.txt" || broken "no error is measured: $(cat "$out/plan-fitted.txt")"
exit "$status"
