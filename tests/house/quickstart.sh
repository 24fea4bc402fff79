#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# quickstart.sh ROOT BUILD: the survey quickstart: its figures, files that make trusts, bits that do not depend on
# the number of threads.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
out=$work/out
survey() { "$root/surveys/run" quickstart OUT="$out" "$@"; }
# Larger cells, where the figures do not count.
coarse() { survey OUT="$work/coarse" STEP=10 "$@" "$work/coarse/response.sgy" "$work/coarse/spectrum.txt"; }

survey
sh "$root/tests/house/pages.sh" "$root" "$SLIPWAVE_BUILD" --in "$out" surveys/quickstart/README.md || broken 'its page has other figures'
# The springs of the cluster send back some per cent of the whole field (the incident wave, mostly). Its planes stick under the
# weight above, so without springs nothing is left.
awk '
  $1 == "all" && $2 == "p" { l2 = $4 }
  END { if (!(l2 > 0.01 && l2 < 0.03)) { print "relative L2 of the response: " l2 ", expected 0.01 to 0.03"; exit 1 } }' "$out/comparison.txt" ||
  status=1

coarse
"$SLIPWAVE_BUILD/bin/sw-shoot" -q "$work/coarse/model.nc" --config "$root/surveys/quickstart/shot.cfg" --without compliance -o "$work/stuck.sgy"
"$SLIPWAVE_BUILD/bin/sw-compare" -q "$work/stuck.sgy" "$work/coarse/elastic.sgy" --tolerance 0 -o "$work/compared" ||
  broken 'planes slip that should stick'

plan=$(survey -n)
case $plan in
  *sw-shoot*) broken "make wants to shoot again what is there: $plan" ;;
esac
rm "$out/elastic.nc"
plan=$(survey -n)
case $plan in
  *'sw-shoot '*--without*) ;;
  *) broken "make does not miss snapshots that are gone: $plan" ;;
esac

survey clean >/dev/null
[ ! -e "$out" ] || broken 'make clean leaves results'
mv "$work/coarse/response.sgy" "$work/coarse/spectrum.txt" "$work"
rm -r "$work/coarse"
coarse THREADS=1 >/dev/null
cmp "$work/response.sgy" "$work/coarse/response.sgy" || broken 'with one thread the traces are others'
cmp "$work/spectrum.txt" "$work/coarse/spectrum.txt" || broken 'with one thread the spectrum is another'
exit "$status"
