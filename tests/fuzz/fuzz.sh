#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# fuzz.sh BIN FOLDER SEEDS TARGET...: libFuzzer on each target (segy, text, model, checkpoint) for SLIPWAVE_FUZZ_SECONDS (10),
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
  longest=16384
  case $target in
    segy | checkpoint) "$bin/${target}_seeds" "$at/corpus" ;;
    text)
      cp "$seeds"/* "$at/corpus"
      most=1024
      ;;
    # Changes to a good file, a few bytes each. The netCDF library keeps what it may need again.
    model)
      most=256
      longest=256
      ;;
  esac
  [ "$target" != checkpoint ] || longest=131072
  ASAN_OPTIONS=quarantine_size_mb=16 "$bin/${target}_fuzz" -max_total_time="${SLIPWAVE_FUZZ_SECONDS:-10}" \
    -max_len="$longest" -timeout=10 -malloc_limit_mb="$most" -rss_limit_mb=2048 -use_value_profile=1 -verbosity=0 \
    -detect_leaks="$([ "$target" = model ] && echo 0 || echo 1)" -print_final_stats=1 -artifact_prefix="$at/" "$at/corpus"
done
