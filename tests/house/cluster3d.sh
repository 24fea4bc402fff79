#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# cluster3d.sh ROOT BUILD: the survey in three dimensions in short, in cells of 20 m: a response, lines of an area of receivers,
# slices across y and z.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bin=$2/bin
status=0
broken() {
  echo "$1"
  status=1
}
survey() { "$root/surveys/run" cluster3d STEP=20 OUT="$work" "$@"; }

survey "$work/comparison.txt" "$work/line.sgy" "$work/map.png" movie >/dev/null 2>"$work/told" ||
  broken "the survey failed: $(tail -n 2 "$work/told")"
awk '
  $1 == "all" && $2 == "vz" { l2 = $4 }
  END { if (!(l2 > 0.005 && l2 < 0.05)) { print "relative L2 of the response: " l2 ", expected 0.005 to 0.05"; exit 1 } }' "$work/comparison.txt" ||
  status=1
"$bin/sw-info" "$work/line.sgy" | grep -q '^ *traces  *15$' || broken 'a line of the area has not its 15 receivers'
"$bin/sw-info" "$work/fractured.nc" | grep -q '30 x 1 x 20 cells' || broken 'the snapshots are not the slice y=250'
"$bin/sw-info" "$work/surface.nc" | grep -q '30 x 25 x 1 cells' || broken 'the snapshots are not the slice z=0'
[ "$(find "$work/film" -name 'wave-*.png' | wc -l)" -ge 25 ] || broken 'the film has not its 25 pictures'
exit "$status"
