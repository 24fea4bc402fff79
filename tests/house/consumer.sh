#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# consumer.sh ROOT BUILD CXX: somebody else's project finds the installed library, builds against it and shoots.
set -eu
root=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/there" >/dev/null
# Moved: nothing in it may depend on where it was installed to.
mv "$work/there" "$work/prefix"
cp -r "$root/tests/house/consumer" "$work/project"
if ! {
  cmake -S "$work/project" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$3" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" && cmake --build "$work/build"
} >"$work/said" 2>&1; then
  cat "$work/said"
  echo 'the project does not build'
  exit 1
fi
# The same by pkg-config, for who has no CMake.
PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name slipwave.pc)")
export PKG_CONFIG_PATH
# All of the library, so that what the project does not call is linked, too.
words=$(pkg-config --cflags --libs slipwave | sed 's/-lslipwave/-Wl,--whole-archive & -Wl,--no-whole-archive/')
# shellcheck disable=SC2086
"$3" -std=c++20 -Wall -Wextra -Werror "$work/project/echo.cpp" $words -o "$work/build/echo-by-pkg-config" >"$work/said" 2>&1 ||
  { cat "$work/said"; echo 'the project does not build by pkg-config'; exit 1; }
if grep -rn -e "$root/lib" -e "$build" "$work/prefix/lib" --include='*.cmake' --include='*.pc'; then
  echo 'the installed CMake files name the checkout'
  exit 1
fi
# 50 m down to the source, 150 m to the receiver, the floor at 300 m: (250 + 150 - 100) m / 1500 m/s.
said=$("$work/build/echo")
[ "$said" = "$("$work/build/echo-by-pkg-config")" ] || { echo "built by pkg-config the echo is another"; exit 1; }
case $said in
  0.19[89] | 0.20[012]) ;;
  *) echo "the echo comes $said s behind the direct wave, expected 0.2 s"; exit 1 ;;
esac
