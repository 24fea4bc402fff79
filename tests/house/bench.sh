#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# bench.sh ROOT BUILD: the benchmarks run and `report` makes tables of what they say. What they measure is not judged.
set -eu
program=$2/bin/slipwave_bench
if [ ! -x "$program" ]; then
  echo "skipped: built without Google Benchmark"
  exit 77
fi
status=0
said=$("$1/tests/bench/report" --bin "$2/bin" --quick --filter \
  'triad/.*first_cache|kernel:.*order:5.*float|step/order:5/cells:200x200|cube/order:3/cells:128x128x128/material:uniform/threads:1|effect:(none|all|free)|(growth|memory)/cells:99856|shots:1/') || {
  echo "report failed"
  exit 1
}
for heading in Memory Kernels 'Whole steps' 'Three dimensions' Effects Growth; do
  # Under the heading a table with a row that begins with words, then a number above zero.
  if ! printf '%s\n' "$said" | awk -v heading="## $heading" '
    /^## / { here = $0 == heading }
    here && /^\| [^|]+ \|( \|)* *[0-9.]*[1-9]/ { found = 1 }
    END { exit !found }'; then
    echo "no figures under '$heading' in:"
    printf '%s\n' "$said"
    status=1
  fi
done
exit "$status"
