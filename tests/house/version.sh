#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# version.sh ROOT TOOL: the version that version.cmake finds, in a checkout of its own at every stage.
set -eu
script=$1/lib/cli/version.cmake
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
# expect WHAT PATTERN: the version of $work/house.
expect() {
  cmake -DROOT="$work/house" -DRELEASE=0.2.0 -DOUTPUT="$work/version.hpp" -P "$script"
  version=$(sed -n 's/.*"\(.*\)".*/\1/p' "$work/version.hpp")
  printf '%s\n' "$version" | grep -qE "^$2\$" || { echo "$1: the version is '$version', expected $2"; status=1; }
}
in_house() { git -C "$work/house" -c user.name=a -c user.email=a@b -c commit.gpgsign=false "$@" >/dev/null 2>&1; }
# commit FILE: changes and commits it.
commit() {
  echo x >> "$work/house/$1"
  in_house add "$1"
  in_house commit -m "Change $1"
}

# Whoever cites it names the version of the build.
release=$(sed -n 's/^project(slipwave VERSION \([0-9.]*\) .*/\1/p' "$1/CMakeLists.txt")
grep -qx "version: $release" "$1/docs/CITATION.cff" || { echo "docs/CITATION.cff is not of version $release"; status=1; }
grep -qF "version = {$release}" "$1/docs/citing.md" || { echo "docs/citing.md is not of version $release"; status=1; }
grep -q "^## $release" "$1/docs/CHANGELOG.md" || { echo "docs/CHANGELOG.md has no release $release"; status=1; }

case $("$2" --version) in
  *' (slipwave '[0-9]*.[0-9]*.[0-9]*')') ;;
  *) echo "$2 --version says $("$2" --version)"; status=1 ;;
esac
mkdir -p "$work/house/lib" "$work/house/tools" "$work/house/docs"
expect 'no checkout' 0.2.0
command -v git >/dev/null || { echo 'there is no git, the rest is not looked at'; exit "$status"; }

in_house init
expect 'a checkout without commits' 0.2.0
commit lib/a.cpp
expect 'no tag' '0\.2\.0-dev\.1\+g[0-9a-f]{7,}'
untagged=$(printf '%s' "$version" | sed 's/[.+]/\\&/g')
commit docs/a.md
expect 'a commit of documents' "$untagged"
cp "$work/version.hpp" "$work/before.hpp"
touch -d '2020-01-01' "$work/version.hpp"
expect 'again' "$untagged"
[ -z "$(find "$work/version.hpp" -newer "$work/before.hpp")" ] || { echo 'the same version is written again'; status=1; }
in_house tag v0.2.0
expect 'a tag' 0.2.0
echo y >> "$work/house/docs/a.md"
expect 'documents changed' 0.2.0
echo y >> "$work/house/lib/a.cpp"
expect 'sources changed' '0\.2\.0\.changed'
commit lib/a.cpp
expect 'a commit after the tag' '0\.2\.0\+1\.g[0-9a-f]{7,}'
in_house tag somewhere
expect 'a tag of another kind' '0\.2\.0\+1\.g[0-9a-f]{7,}'
rm -rf "$work/outer"
mkdir "$work/outer"
git -C "$work/house" archive --prefix=house/ HEAD | tar -x -C "$work/outer"
rm -rf "$work/house/.git" "$work/house"
git -C "$work/outer" init >/dev/null 2>&1
git -C "$work/outer" -c user.name=a -c user.email=a@b commit --allow-empty -m 'Begin' >/dev/null 2>&1
mv "$work/outer" "$work/somebody"
ln -s "$work/somebody/house" "$work/house"
expect "a tarball in somebody else's checkout" 0.2.0
exit "$status"
