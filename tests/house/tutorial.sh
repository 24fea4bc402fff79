#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# tutorial.sh ROOT BUILD: the commands of docs/tutorial.md, one after the other in a folder of their own, and what they
# make. In cells and at wavelengths 2.5 times as large, a sixteenth of the work; SLIPWAVE_LONG=1: as it stands there.
set -eu
root=$1
build=$2
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
unset MAKELEVEL
MAKEFLAGS="BUILD=$build"
SLIPWAVE=$root
PATH=$build/bin:$PATH
export MAKEFLAGS SLIPWAVE PATH

commands_of "$root/docs/tutorial.md" > "$work/as-written"
if [ "${SLIPWAVE_LONG-}" = 1 ]; then
  cp "$work/as-written" "$work/commands"
else
  sed -e 's/--step 5 /--step 12.5 /' -e 's/ricker:20/ricker:8/' "$work/as-written" > "$work/commands"
  [ "$(diff "$work/as-written" "$work/commands" | grep -c '^>')" = 2 ] || {
    echo 'the short form finds other steps or wavelets than it expects'
    exit 1
  }
fi
run_commands

grep -oE '[a-z-]+\.(png|pdf|svg)\b' "$work/as-written" | sort -u > "$work/pictures"
while IFS= read -r picture; do
  case $picture in section.png) picture=out/section.png ;; esac
  [ -s "$picture" ] || broken "$picture was not made"
done < "$work/pictures"
# The fractures answer, and finer cells change the answer but do not make another of it.
l2() { awk '$1 == "all" && $2 == "p" { print $4 }' ; }
sw-compare fractured.sgy elastic.sgy --summary | l2 |
  awk '!($1 > 0.005 && $1 < 0.05) { print "relative L2 of the response: " $1 ", expected 0.005 to 0.05"; bad = 1 } END { exit bad || !NR }' ||
  status=1
# Planes that stick answer in proportion to the shot; those that slide do not.
sw-compare quiet-springs.sgy springs.sgy --summary | l2 |
  awk '!($1 < 1e-3) { print "a weaker shot changes the response of springs by " $1 ", expected rounding"; bad = 1 } END { exit bad || !NR }' ||
  status=1
sw-compare quiet-loose.sgy response-loose.sgy --summary | l2 |
  awk '!($1 > 0.3) { print "a weaker shot changes the response of sliding planes by " $1 ", expected more than 0.3"; bad = 1 } END { exit bad || !NR }' ||
  status=1
sw-compare response.sgy fine-response.sgy --summary | l2 |
  awk '!($1 > 0.05 && $1 < 0.4) { print "response against a fine one: " $1 ", expected 0.05 to 0.4"; bad = 1 } END { exit bad || !NR }' ||
  status=1
sw-info out/response.sgy | grep -qE '^ *shots +21( |$)' || { sw-info out/response.sgy; broken 'the survey has not 21 shots'; }
case $(make -n) in
  *sw-shoot*) broken 'make wants to shoot again what is there' ;;
esac
rm out/fractured-1500.sgy
plan=$(make -n | grep -c 'sw-shoot ') || :
[ "$plan" = 1 ] || broken "one shot is gone, make wants to shoot $plan"
exit "$status"
