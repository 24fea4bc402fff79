#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# land.sh ROOT BUILD: the survey land in short: shots and geophones are those of the tables, geophones stand on the ground, and a
# shot taken as geometry gives its own traces again.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
bin=$2/bin
"$root/surveys/run" land STEP=20 NUMBERS='101 108' OUT="$work/out" -j 2 >"$work/said" 2>"$work/told" ||
  broken "the survey failed: $(tail -n 2 "$work/told")"
geophones=$(grep -c '^[0-9]' "$root/surveys/land/geophones.csv")
grep -q "^ *traces  *$((2 * 2 * geophones))\$" "$work/said" || broken "the line lacks traces: $(cat "$work/said")"
for picture in model shot line; do
  [ -s "$work/out/$picture.png" ] || broken "there is no $picture.png"
done

# Where a height of the ground is given there stands a geophone at it: hills.txt is as fine as the line.
"$bin/sw-info" "$work/out/shots/101.sgy" >"$work/info"
range() { awk -v name="$1" '{ if ($1 " " $2 == name) print $3, $5 }' "$work/info"; }
lowest=$(awk '/^[0-9]/ { if (low == "" || $2 < low) low = $2; if ($2 > high) high = $2 } END { print low, high }' "$root/surveys/land/hills.txt")
range 'receiver z' | awk -v hills="$lowest" '{ split(hills, at, " "); exit !(($1 - at[1])^2 < 25 && ($2 - at[2])^2 < 25) }' ||
  broken "geophones stand at $(range 'receiver z') m, the ground is at $lowest m"

# The geometry of a shot by its file alone: holes are rounded to millimetres once, then bytes stay.
sed '/^source\|^receivers/d' "$root/surveys/land/shot.cfg" >"$work/shot.cfg"
# taken NAME TO: that file's geometry shot again.
taken() { "$bin/sw-shoot" "$work/out/model.nc" --config "$work/shot.cfg" --geometry "$1" -q -o "$2"; }
for number in 101 108; do
  shot=$work/out/shots/$number.sgy
  taken "$shot" "$work/again.sgy"
  "$bin/sw-compare" "$shot" "$work/again.sgy" --tolerance 1e-4 >/dev/null || broken "shot $number taken as geometry gives other traces"
  taken "$work/again.sgy" "$work/twice.sgy"
  [ "$(tail -c +3601 "$work/twice.sgy" | cksum)" = "$(tail -c +3601 "$work/again.sgy" | cksum)" ] ||
    broken "shot $number taken as geometry twice gives other traces"
done
exit "$status"
