#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# traces.sh BIN [FOLDER]: seconds that tools take for a gather of 1 GB beside cat and cp, best of five, as a table. FOLDER
# (default $TMPDIR or /tmp) needs 4 GB. On a busy machine read user and system seconds, which are behind the elapsed ones.
set -eu
bin=$(cd "$1" && pwd)
PATH=$bin:$PATH
folder=$(mktemp -d "${2:-${TMPDIR:-/tmp}}/slipwave-bench-XXXXXX")
trap 'rm -rf "$folder"' EXIT
cd "$folder"

sw-layers --size 500x300 --step 5 --layer 0:2500:1250:2200 |
  sw-shoot - -q --source 250,20 --wavelet ricker:30 --receivers 5:500:5,10 --time 1.499 --record vz -o one.sgy
tail -c +3601 one.sgy > traces # 100 traces of 1500 samples
while [ "$(stat -c %s traces)" -lt 250000000 ]; do
  cat traces traces > twice
  mv twice traces
done
{ head -c 3600 one.sgy; head -c 249600000 traces; head -c 249600000 traces; head -c 249600000 traces; head -c 249600000 traces; } > a.sgy
rm traces
cp a.sgy b.sgy

# seconds NAME COMMAND: elapsed, user and system, of the run that took least.
seconds() {
  printf '%-32s' "$1"
  for _ in 1 2 3 4 5; do
    bash -c "TIMEFORMAT='%R %U %S'; time { $2; }" 2>&1 | tail -n 1
  done | sort -n | head -n 1 | awk '{ printf "%8.2f %6.2f %6.2f\n", $1, $2, $3 }'
}

printf '%-32s%8s %6s %6s\n' '' elapsed user system
seconds 'cat to a file' 'cat a.sgy > out'
seconds 'sw-convert to a file' 'sw-convert a.sgy > out'
seconds 'cp' 'cp a.sgy out'
seconds 'sw-diff to a file' 'sw-diff a.sgy b.sgy -o out'
seconds 'cat from a pipe' 'cat a.sgy | cat > /dev/null'
seconds 'sw-convert from a pipe' 'cat a.sgy | sw-convert > /dev/null'
seconds 'sw-convert --format ibm' 'sw-convert --format ibm a.sgy > /dev/null'
seconds 'sw-convert --endian little' 'sw-convert --endian little a.sgy > /dev/null'
seconds 'sw-convert --format int16' 'sw-convert --format int16 a.sgy > /dev/null'
seconds 'sw-info' 'sw-info a.sgy > /dev/null'
