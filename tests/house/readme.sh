#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# readme.sh ROOT BUILD: runs the ```sh blocks of README.md and docs/tools.md in a temporary directory, a block at a
# time; every command must succeed, but for ./surveys/run quickstart and ./tests/run, which are tests of their own.
set -eu
root=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PATH=$build/bin:$PATH
SLIPWAVE_BUILD=$build
export PATH SLIPWAVE_BUILD
blocks=0
for page in README.md docs/tools.md; do
  awk -v base="$work/$(basename "$page")" '
    /^```sh$/ { inside = 1; name = sprintf("%s.%02d.sh", base, ++block); next }
    /^```/ { inside = 0 }
    inside { print > name }' "$root/$page"
done
cd "$work"
for block in "$work"/*.md.*.sh; do
  [ -f "$block" ] || continue
  sed -e '/^\.\/tests\/run/d' -e '/^\.\/surveys\/run quickstart$/d' "$block" > "$block.run"
  echo "--- $(basename "$block" .sh)"
  cat "$block"
  sh -eu "$block.run" </dev/null || { echo "$(basename "$block" .sh): a command failed"; exit 1; }
  blocks=$((blocks + 1))
done
[ "$blocks" -gt 0 ] || { echo "no \`\`\`sh block found"; exit 1; }
