#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# exchange.sh ROOT BUILD SHARED: the recipes of docs/exchange.md in a folder of their own, where Debian's package of the
# program is installed, and what they print; header words and netCDF conventions that other programs rely on.
# Exit 77 when all is well but a program or checker is not there: what was left out is said.
set -eu
root=$1
build=$2
shared=$3
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
PATH=$build/bin:$PATH
export PATH
left_out=0
leave_out() {
  echo "left out: $1"
  left_out=1
}
installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# Blocks in order, NN.block, of the section and kind in NN.section; what a section says of itself.
mkdir "$work/blocks" "$work/folder"
: > "$work/blocks/run"
: > "$work/blocks/not-run"
awk -v base="$work/blocks" '
  BEGIN { section = "files" }
  !block && /^## / { section = substr($0, 4) }
  !block && /^Run by the tests/ { print section "\t" $0 >> (base "/run") }
  !block && /not run here\.$/ { print section >> (base "/not-run") }
  /^```/ && block { block = 0; close(name); next }
  /^```/ {
    block = 1; name = sprintf("%s/%02d.block", base, ++count)
    print section "\t" substr($0, 4) > sprintf("%s/%02d.section", base, count); printf "" > name; next
  }
  block { print > name }' "$root/docs/exchange.md"

# packages SECTION: those that its recipes need; fails where the page does not say that they run.
packages() {
  [ "$1" != files ] || return 0
  line=$(grep "^$1	" "$work/blocks/run") || return 1
  printf '%s\n' "$line" | grep -o '`[^`]*`' | tr -d '`'
}

cd "$work/folder"
ran=0
skipped=
: > "$work/said"
for file in "$work"/blocks/[0-9]*.section; do
  section=$(cut -f 1 "$file")
  block=${file%.section}.block
  if ! needs=$(packages "$section"); then
    grep -qx "$section" "$work/blocks/not-run" || broken "$section: the page does not say whether its recipes are run"
    continue
  fi
  [ "$section" != "$skipped" ] || continue
  for package in $needs; do
    installed "$package" || { leave_out "$section: $package is not installed"; skipped=$section; }
  done
  [ "$section" != "$skipped" ] || continue
  case $(cut -f 2 "$file") in
    sh) sh -eu "$block" </dev/null >>"$work/said" 2>"$work/wrong" ;;
    python) /usr/bin/python3 "$block" </dev/null >>"$work/said" 2>"$work/wrong" ;;
    text)
      diff "$block" "$work/said" >"$work/differs" ||
        broken "$section: the page (<) and the recipe (>) do not show the same:
$(cat "$work/differs")"
      : > "$work/said"
      continue
      ;;
    *) broken "$section: a block that is neither sh, python nor text"; continue ;;
  esac || { cat "$block" "$work/wrong"; broken "$section: a recipe failed"; : > "$work/said"; continue; }
  [ ! -s "$work/wrong" ] || broken "$section: a recipe complains: $(cat "$work/wrong")"
  ran=$((ran + 1))
done
[ "$ran" -gt 0 ] || broken 'no recipe was run'

# What programs that are not here are given, made as the page says.
page_says() { grep -qF -- "$1" "$root/docs/exchange.md" || broken "the page does not say: $1"; }
page_says 'sw-select survey.sgy --where component=vz | sw-sort --key cdp,offset -o line.sgy'
sw-select survey.sgy --where component=vz | sw-sort --key cdp,offset -o line.sgy
page_says 'sw-convert --format ibm'
sw-convert --format ibm line.sgy -o ibm.sgy
page_says '--text ascii'
sw-convert --text ascii gather.sgy -o ascii.sgy
page_says 'sw-convert gather.sgy --su'
sw-convert gather.sgy --su > gather.su
sw-export volume.nc --property vp -o volume.sgy
sw-spectrum gather.sgy -o spectrum.nc
sw-spectrum gather.sgy --each -o spectra.nc
sw-select gather.sgy --where component=vz | sw-spectrum --fk -o fk.nc
if installed python3-numpy; then
  /usr/bin/python3 "$root/tests/house/exchange_bytes.py" || broken 'header words are not what the page says'
else
  leave_out 'header words: python3-numpy is not installed'
fi
if [ -f "$shared/tools/check_segy.py" ] && installed python3-numpy; then
  check() { /usr/bin/python3 "$shared/tools/check_segy.py" -q "$@" || broken "check_segy.py $*"; }
  check --profile shot --strict gather.sgy survey.sgy well.sgy hills.sgy area.sgy
  check --expect format=1 ibm.sgy
  check --expect text=ascii ascii.sgy
  check --su gather.su
else
  leave_out 'SEG-Y by a checker of its own: it is not at hand'
fi
if installed udunits-bin && installed python3-netcdf4; then
  /usr/bin/python3 "$root/tests/house/netcdf_conventions.py" model.nc hills.nc volume.nc waves.nc \
    hills-waves.nc slice.nc spectrum.nc spectra.nc fk.nc || broken 'netCDF files break conventions'
  # One of each kind of fault is noticed.
  /usr/bin/python3 - <<'PYTHON'
import netCDF4, shutil
faults = {"unit": lambda file: file["vp"].setncattr("units", "m per s and a bit"), "flags": lambda file: file["fracture"].setncattr("flag_meanings", "intact"),
          "axis": lambda file: file["z"].delncattr("positive"), "sgrid": lambda file: file["grid"].setncattr("node_dimensions", "x z_face"),
          "range": lambda file: file["vp"].setncattr("actual_range", file["vp"].actual_range * 2), "coordinate": lambda file: file["vs"].setncattr("coordinates", "elsewhere")}
for name, spoil in faults.items():
    shutil.copy("hills.nc" if name == "sgrid" else "model.nc", f"spoilt-{name}.nc")
    with netCDF4.Dataset(f"spoilt-{name}.nc", "a") as file:
        spoil(file)
PYTHON
  for name in unit flags axis sgrid range coordinate; do
    /usr/bin/python3 "$root/tests/house/netcdf_conventions.py" "spoilt-$name.nc" >/dev/null 2>&1 &&
      broken "the check of conventions does not notice a wrong $name"
  done
else
  leave_out 'CF and SGRID: udunits-bin or python3-netcdf4 is not installed'
fi
[ "$status" != 0 ] || [ "$left_out" = 0 ] || status=77
exit "$status"
