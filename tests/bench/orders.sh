#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# orders.sh [BIN]: processor time of a step in each order, over that of order 5; one thread, the least of three runs.
# The choice of settings (lib/planning/setting_search.cpp) ranks them by these ratios.
set -eu
bin=${1:-$(dirname -- "$0")/../../build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/sw-layers" --size 3000x2000 --step 10 --layer 0:1500:0:1000 --layer 400:2500:1200:2000 \
  --layer 900:3500:1900:2300:3 --fit none -o "$work/model.nc"
least() {
  for _ in 1 2 3; do
    "$bin/sw-accuracy" "$work/model.nc" --source 503,203 --wavelet ricker:8 --receivers 700:2900:100,200 --time 3 \
      --steps 10 --orders "$1" --time-orders "$2" --cfls 0.9 --reference "1,0.9,20" --threads 1 |
      awk -v order="$1" -v time="$2" '$1 == order && $2 == time && $4 == 10 { print $10 / $7 }'
  done | sort -g | head -n 1
}
base=$(least 5 2)
for scheme in '3 2' '5 2' '7 2' '9 2' '11 2' '7 4' '9 4' '11 4'; do
  # shellcheck disable=SC2086
  least $scheme | awk -v scheme="$scheme" -v base="$base" '{ printf "order, time order %s: %.2f\n", scheme, $1 / base }'
done
