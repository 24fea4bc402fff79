#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# python.sh ROOT BUILD: the blocks of docs/python.md, one after the other in a folder of their own, in one Python.
# Exit 77 where a package that they need is not there.
set -eu
root=$1
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
PATH=$2/bin:$PATH
export PATH
# Debian's, whatever else stands on PATH.
python=/usr/bin/python3
for module in segyio xarray netCDF4 matplotlib; do
  "$python" -c "import $module" 2>/dev/null || { echo "there is no $module of Python"; exit 77; }
done
awk '/^```python$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$root/docs/python.md" > "$work/page.py"
mkdir "$work/folder"
cd "$work/folder"
"$python" -W error::DeprecationWarning "$work/page.py" > "$work/said" 2>&1 || { cat "$work/said"; broken 'a block of the page fails'; }
cat "$work/said"
grep -qx 'the largest vz is that of sw-info: True' "$work/said" || broken 'segyio reads other amplitudes'
grep -qx '2 shots, 0.001 s' "$work/said" || broken 'sw-info --json says something else'
[ -z "${KEEP-}" ] || cp gather.png "$KEEP"
for file in line.nc gather.png imported.nc; do
  [ -s "$file" ] || broken "$file was not made"
done
exit "$status"
