#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# corpus.sh BUILD SHARED: field files of other programs, shared/data/segy-corpus, as geometry: all that have one are shot and go
# through sw-diff trace by trace; the others say what is missing. Ends with 77 where the files are not there.
set -eu
bin=$1/bin
corpus=$2/data/segy-corpus
if [ ! -d "$corpus" ]; then
  echo "skipped: there is no $corpus"
  exit 77
fi
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
"$bin/sw-layers" -q --size 900x300 --step 20 --layer 0:1800:0:1000 --layer 150:2500:1200:2100 -o "$work/m.nc"

# shoots FILE TRACES T0:T1 DT [OPTION...]: the file's traces, of those times, in its order.
shoots() {
  file=$corpus/$1 traces=$2 times=$3 dt=$4
  shift 4
  if ! "$bin/sw-shoot" "$work/m.nc" --geometry "$file" --top absorbing --record p --wavelet ricker:12 --time "${times#*:}" --dt "$dt" -q \
    -o "$work/shot.sgy" "$@" 2>"$work/told"; then
    broken "$(cat "$work/told")"
    return
  fi
  "$bin/sw-select" "$work/shot.sgy" --time "$times" -o "$work/cut.sgy"
  if ! "$bin/sw-diff" "$file" "$work/cut.sgy" -o "$work/difference.sgy" 2>"$work/told"; then
    broken "$(cat "$work/told")"
    return
  fi
  "$bin/sw-info" "$work/difference.sgy" | grep -q "^ *traces  *$traces\$" || broken "${file##*/}: not all $traces traces were shot"
}
shoots f3.sgy 414 0.004:0.3 0.004 --origin 620410,6074238 --azimuth -1.6
for code in 1lsb 1msb 2msb 3msb 5lsb 5msb 6msb 8msb; do
  shoots "formats/Format$code.sgy" 23 0.004:0.3 0.004 --origin 620195,6074245 --azimuth 90.63
done
shoots rotated-small-rev2.sgy 25 0:0.196 0.004 --origin -2,98
shoots delay-scalar.sgy 1 1:2 0.004 --origin 467092,6557702

# refused FILE TEXT: one line that holds this, and no traces.
refused() {
  rm -f "$work/shot.sgy"
  if "$bin/sw-shoot" "$work/m.nc" --geometry "$corpus/$1" --record p --wavelet ricker:12 --time 0.1 -q -o "$work/shot.sgy" 2>"$work/told"; then
    broken "$1: was shot"
    return
  fi
  [ "$(wc -l <"$work/told")" -eq 1 ] || broken "$1: says more than a line"
  grep -q -e "$1: $2" "$work/told" || broken "$1: expected '$2': $(cat "$work/told")"
  [ ! -e "$work/shot.sgy" ] || broken "$1: wrote traces"
}
refused f3.sgy 'trace 1: the source at .* lies outside the model, .*--origin 620410,6074238 --azimuth -1.6'
for name in small small-lsb stanzas-known-count shot-gather; do
  refused "$name.sgy" 'found no coordinates of sources (bytes 73, 77) and receivers (81, 85), and one offset, 1 m, for all traces'
done
refused broken.sgy 'ends within trace 4'
refused increment.sgy 'trace 1: found scalar scalel (byte 69) -32749'
refused long.sgy 'trace 2: found scalar scalel (byte 69) 16448'
refused interval-neg-bin-pos-trace.sgy 'found no geometry: coordinates of sources (bytes 73, 77)'
refused multi-text.sgy 'found no geometry'
refused text.sgy 'found no trace'
exit "$status"
