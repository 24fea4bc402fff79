#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# shale.sh ROOT BUILD: the survey shale in larger cells: its axes dip as beds do, each effect changes the reflections as it should,
# and what is switched off is as if it had never been there.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
out=$work/out
bin=$2/bin
survey() { "$root/surveys/run" shale OUT="$out" STEP=20 "$@"; }

survey -j 2 >"$work/said" 2>"$work/told" || broken "the survey failed: $(tail -n 2 "$work/told")"
for picture in model tilt point reflections attenuation vertical tilted both; do
  [ -s "$out/$picture.png" ] || broken "there is no $picture.png"
done
plan=$(survey -n)
case $plan in
  */sw-shoot\ * | */sw-plot\ *) broken "make wants to do again what is there: $plan" ;;
esac

# The dip of beds that are known to dip by 25 degrees towards +x, and of their mirror image, 300 m and more from the sides.
for dip in 25 -25; do
  # shellcheck disable=SC2046
  "$bin/sw-layers" --size 1500x1000 --step 10 --fit none $(seq -900 80 1700 | awk -v dip=$dip '
    { printf " --layer %s:%d:%d:2200:%d", NR == 1 ? -2000 : $1 + (dip < 0 ? 350 : -350), 2000 + 400 * (NR % 3), 1000 + 200 * (NR % 3), dip }') \
    -o "$work/beds.nc" 2>"$work/told" || broken "no model of beds: $(cat "$work/told")"
  "$bin/sw-export" "$work/beds.nc" --property vs --su -o "$work/beds.su"
  od -An -v -w640 -tf4 "$work/beds.su" | LC_ALL=C awk -v step=10 -v reach=80 -f "$root/surveys/shale/tilt.awk" | od -An -v -w400 -tf4 |
    awk -v dip=$dip '
      NR > 30 && NR <= 120 { for (k = 31; k <= 70; k++) { n++; if ($k < dip - 2 || $k > dip + 2) bad++ } }
      END { if (n != 3600 || bad > 36) { print "beds that dip by " dip ": " bad + 0 " of " n + 0 " cells dip otherwise by more than 2"; exit 1 } }' ||
    status=1
done

cat "$out/effects.txt"
# Attenuation takes amplitude; anisotropy moves waves by a good part of the wavelet; tilted axes cost time.
awk '
  FILENAME ~ /attenuation/ && $1 == "all" { kept = 200 * $4 / $3 - 1 }
  FILENAME ~ /effects/ { nrms[$1] = $3; cost[$1] = $4 }
  END {
    if (!(kept > 0.7 && kept < 0.95)) { print "attenuation leaves " kept " of the amplitude, expected 0.7 to 0.95"; bad = 1 }
    if (!(nrms["attenuation"] > 10 && nrms["attenuation"] < 40)) { print "attenuation changes too little or too much"; bad = 1 }
    if (!(nrms["vertical"] > 50 && nrms["tilted"] > 50)) { print "anisotropy changes too little"; bad = 1 }
    if (!(nrms["tilt"] > 20 && nrms["tilt"] < nrms["tilted"])) { print "the tilt changes too little, or more than anisotropy does"; bad = 1 }
    if (!(cost["tilted"] > 1.5)) { print "tilted axes take " cost["tilted"] " of the elastic time, expected more"; bad = 1 }
    exit bad
  }' "$out/attenuation.txt" "$out/effects.txt" || status=1

# Without its effects the model gives the samples of the one that never had them.
shoot() { "$bin/sw-shoot" "$out/shale.nc" --config "$root/surveys/shale/shot.cfg" --time 2 -q "$@"; }
shoot --without attenuation,anisotropy -o "$work/without.sgy"
"$bin/sw-compare" "$work/without.sgy" "$out/elastic.sgy" --summary --tolerance 0 || broken 'effects that are switched off leave traces'
# Both at once are more than the larger of them.
"$bin/sw-compare" "$out/both.sgy" "$out/tilted.sgy" --summary >"$work/both.txt"
awk '$1 == "all" { found = $3 } END { if (!(found > 2 && found < 60)) { print "attenuation changes anisotropic rock by " found " %"; exit 1 } }' \
  "$work/both.txt" || status=1
exit "$status"
