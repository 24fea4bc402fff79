#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# receivers.sh BIN [PAIRS [FOLDER]]: what 1000 receivers cost beside one: processor time, reading and writing included, of whole
# shots over four layers, in pairs run in turn, as a table: least of each, and the median of the pairs. On a busy machine take more PAIRS (8).
set -eu
bin=$(cd "$1" && pwd)
pairs=${2:-8}
PATH=$bin:$PATH
folder=$(mktemp -d "${3:-${TMPDIR:-/tmp}}/slipwave-bench-XXXXXX")
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# seconds RECEIVERS: user and system.
seconds() {
  bash -c "TIMEFORMAT='%U %S'; time sw-shoot m.nc -q --threads 1 --source 20,20 --wavelet ricker:15 --receivers $1 \
    --record $components --time 4 --dt 0.002 -o out.sgy" 2>&1 | tail -n 1 | awk '{ print $1 + $2 }'
}

printf '%-12s %-9s %8s %8s %7s %7s\n' cells record one 1000 least median
for size in 5000x3750 10000x6000; do
  sw-layers -q --size $size --step 10 --layer 0:1600:500:1800 --layer 800:2200:1000:2100 \
    --layer 1600:3000:1600:2300 --layer 2600:4000:2200:2500 -o m.nc
  for components in p vx,vz,p; do
    n=0
    while [ "$n" -lt "$pairs" ]; do
      echo "$(seconds 1000.5,43) $(seconds 1000:3997:3,43)"
      n=$((n + 1))
    done | awk '{ print $0, $2 / $1 }' | sort -n -k 3 | awk -v name="$size" -v components="$components" '
      { if (NR == 1 || $1 < one) one = $1; if (NR == 1 || $2 < many) many = $2; ratio[NR] = $3 }
      END { printf "%-12s %-9s %8.2f %8.2f %+6.1f%% %+6.1f%%\n", name, components, one, many, 100 * (many / one - 1),
                   100 * (ratio[int((NR + 1) / 2)] - 1) }'
  done
done
