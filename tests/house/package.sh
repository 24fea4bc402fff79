#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# package.sh BUILD TOOL...: `cpack -G DEB` makes packages that say what they depend on, and whose tools run, under a umask of
# people who keep to themselves.
set -eu
build=$1
shift
command -v dpkg-shlibdeps >/dev/null || { echo 'there is no dpkg-shlibdeps'; exit 77; }
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
(cd "$build" && umask 077 && cpack -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=none -B "$work/packages") >"$work/said" 2>&1 ||
  { cat "$work/said"; echo 'cpack failed'; exit 1; }
# The recipe of a container makes them by the same command, of names that cpack gives.
recipe=$(dirname -- "$0")/../../docs/container/Dockerfile
grep -q '^RUN .*cpack -G DEB -B /packages$' "$recipe" || broken 'the Dockerfile makes no packages'
sed -n 's|^COPY --from=build /packages/\([^ ]*\) .*|\1|p' "$recipe" > "$work/copied"
while IFS= read -r name; do
  [ -n "$(find "$work/packages" -name "$name")" ] || broken "the Dockerfile copies $name, cpack makes no such file"
done < "$work/copied"
# field PACKAGE FIELD
field() { dpkg-deb -f "$1" "$2"; }
# must_hold PACKAGE FIELD TEXT...
must_hold() {
  package=$1
  field=$2
  shift 2
  for text in "$@"; do
    case "$(dpkg-deb -f "$package" "$field")," in
      *"$text"*) ;;
      *) broken "$(basename "$package"): $field does not hold '$text': $(dpkg-deb -f "$package" "$field")" ;;
    esac
  done
}
tools=$(find "$work/packages" -maxdepth 1 -name 'slipwave_*.deb')
library=$(find "$work/packages" -maxdepth 1 -name 'libslipwave-dev_*.deb')
for package in "$tools" "$library"; do
  [ -f "$package" ] || { ls "$work/packages"; echo 'expected packages slipwave and libslipwave-dev'; exit 1; }
done

must_hold "$tools" Depends 'libc6 (>= ' 'libcairo2 (>= ' 'libpangocairo-1.0-0 (>= ' 'libfftw3-double3 (>= ' 'libnetcdf' 'libudunits2-0' 'libtbb' 'libboost-program-options' \
  'fonts-dejavu-core'
must_hold "$library" Depends libboost-program-options-dev libtbb-dev libfftw3-dev libnetcdf-dev libudunits2-dev libpango1.0-dev
for package in "$tools" "$library"; do
  must_hold "$package" Architecture "$(dpkg --print-architecture)"
  field "$package" Version | grep -qE '^[0-9][A-Za-z0-9.+~]*$' || broken "the version is $(field "$package" Version)"
  dpkg --compare-versions "$(field "$package" Version)" gt 0 || broken 'dpkg does not take the version'
  # Root's files, which everybody can read and nobody else can write; nothing outside /usr.
  dpkg-deb -c "$package" | awk '
    $2 != "root/root" || ($1 !~ /^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x|lrwxrwxrwx)$/) || $6 !~ /^\.\/(usr\/.*)?$/ {
      print; bad = 1 } END { exit bad }' || broken "$(basename "$package") holds these"
done
said=$("$build/bin/$1" --version)
version=${said##* }
[ "$(field "$tools" Version)" = "$(echo "${version%)}" | tr - '~')" ] ||
  broken "the package is of version $(field "$tools" Version), its tools say $said"

dpkg-deb -x "$tools" "$work/root"
for tool in "$@"; do
  [ -x "$work/root/usr/bin/$tool" ] || { broken "there is no $tool in the package"; continue; }
  [ -f "$work/root/usr/share/man/man1/$tool.1" ] || broken "there is no page of $tool in the package"
  if readelf -S "$work/root/usr/bin/$tool" | grep -q '\.symtab'; then broken "$tool is not stripped"; fi
  if readelf -d "$work/root/usr/bin/$tool" | grep -qE 'RPATH|RUNPATH'; then broken "$tool looks for libraries of its own"; fi
done
PATH=$work/root/usr/bin:$PATH
sw-layers --size 400x300 --step 5 --layer 0:2000:1000:2000 |
  sw-shoot - --source 200,10 --wavelet ricker:15 --receivers 0:400:20,10 --time 0.2 |
  sw-plot - -q -o "$work/shot.png" || :
[ -s "$work/shot.png" ] || broken 'the tools of the package do not shoot'
dpkg-deb -x "$library" "$work/root"
for package in slipwave libslipwave-dev; do
  grep -q '^License: BSD-3-Clause$' "$work/root/usr/share/doc/$package/copyright" || broken "$package says nothing of its licence"
done
find "$work/root" -name slipwave.pc | grep -q . || broken 'the library has no pkg-config file'
[ -f "$work/root/usr/include/slipwave/solver/simulation.hpp" ] || broken 'the library has no headers'
find "$work/root" -name slipwave-config.cmake | grep -q . || broken 'the library has no CMake files'
exit "$status"
