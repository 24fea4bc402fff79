#!/bin/sh
# fuzz.sh BIN FOLDER: libFuzzer on the reader of SEG-Y for SLIPWAVE_FUZZ_SECONDS (10), beginning with files by our
# own writer. What it finds stays in FOLDER as crash-*, timeout-* or oom-*.
set -eu
bin=$1
folder=$2
rm -rf "$folder"
mkdir -p "$folder/corpus"
"$bin/segy_seeds" "$folder/corpus"
exec "$bin/segy_fuzz" -max_total_time="${SLIPWAVE_FUZZ_SECONDS:-10}" -max_len=16384 -timeout=5 -malloc_limit_mb=64 \
  -rss_limit_mb=1024 -use_value_profile=1 -verbosity=0 -print_final_stats=1 -artifact_prefix="$folder/" "$folder/corpus"
