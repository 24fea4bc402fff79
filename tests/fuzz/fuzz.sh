#!/bin/sh
# fuzz.sh BIN FOLDER SEEDS TARGET...: libFuzzer on each target (segy, text) for SLIPWAVE_FUZZ_SECONDS (10),
# beginning with files by our own writer and those in SEEDS. What it finds stays in FOLDER/TARGET as crash-*,
# timeout-* or oom-*.
set -eu
bin=$1
folder=$2
seeds=$3
shift 3
for target in "$@"; do
  at=$folder/$target
  rm -rf "$at"
  mkdir -p "$at/corpus"
  # What one allocation may take, in MiB: text can ask for ten million points.
  most=64
  case $target in
    segy) "$bin/segy_seeds" "$at/corpus" ;;
    text)
      cp "$seeds"/* "$at/corpus"
      most=1024
      ;;
  esac
  "$bin/${target}_fuzz" -max_total_time="${SLIPWAVE_FUZZ_SECONDS:-10}" -max_len=16384 -timeout=10 \
    -malloc_limit_mb="$most" -rss_limit_mb=2048 -use_value_profile=1 -verbosity=0 -print_final_stats=1 \
    -artifact_prefix="$at/" "$at/corpus"
done
