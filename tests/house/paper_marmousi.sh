#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# paper_marmousi.sh ROOT BUILD SHARED: the survey paper-marmousi in Marmousi-II, where that is at hand.
set -eu
data=${SLIPWAVE_SHARED:-$3}/data/marmousi2
if [ ! -f "$data/marmousi_II_marine.vp" ]; then
  echo "skipped: $data does not hold the Marmousi-II model"
  exit 77
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
unset MAKEFLAGS MAKELEVEL
SLIPWAVE_BUILD=$2 "$1/surveys/run" paper-marmousi STEP=5 ORDER=5 DATA="$data" OUT="$out"

# The response of the cluster is near one per cent of the full field, over all traces.
awk '
  $1 == "all" && $2 == "p" { l2 = $4 }
  END { if (!(l2 > 0.001 && l2 < 0.1)) { print "relative L2 of the response: " l2 ", expected 0.001 to 0.1"; exit 1 } }' "$out/comparison.txt"
