#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# install.sh ROOT BUILD TOOL...: `cmake --install` brings every tool, its man page and its completion, pages and surveys, and nothing else.
set -eu
root=$1
build=$2
shift 2
prefix=$(mktemp -d)
made=$(mktemp -d)
trap 'rm -rf "$prefix" "$made"' EXIT
cmake --install "$build" --prefix "$prefix" --component tools >/dev/null
status=0
for tool in "$@"; do
  said=$("$prefix/bin/$tool" --version) || { echo "$tool does not run where it is installed"; status=1; }
  case $said in
    "$tool (slipwave "[0-9]*) ;;
    *) echo "$tool --version says '$said'"; status=1 ;;
  esac
  cmp -s "$root/docs/man/$tool.1" "$prefix/share/man/man1/$tool.1" ||
    { echo "the man page of $tool is not installed"; status=1; }
  for completion in "bash-completion/completions/$tool" "zsh/vendor-completions/_$tool" "fish/vendor_completions.d/$tool.fish"; do
    [ -s "$prefix/share/$completion" ] || { echo "there is no share/$completion"; status=1; }
  done
done
others=$(find "$prefix" -type f ! -path "$prefix/bin/sw-*" ! -path "$prefix/share/man/man1/sw-*.1" \
  ! -path "$prefix/share/bash-completion/completions/sw-*" \
  ! -path "$prefix/share/zsh/vendor-completions/_sw-*" ! -path "$prefix/share/fish/vendor_completions.d/sw-*.fish" ! -path "$prefix/share/slipwave/*" ! -path "$prefix/share/doc/slipwave/copyright")
[ -z "$others" ] || { printf 'installed beside what is expected: %s\n' "$others"; status=1; }
tools=$(find "$prefix/bin" "$prefix/share/man" "$prefix/share/bash-completion" "$prefix/share/zsh" "$prefix/share/fish" -type f | wc -l)
[ "$tools" -eq $(($# * 5)) ] || { echo "installed $tools files, expected tool, man page and three completions for each of: $*"; status=1; }

for file in "$prefix/share/doc/slipwave/copyright" "$prefix/share/slipwave/docs/LICENSE" "$prefix/share/slipwave/docs/CITATION.cff"; do
  [ -s "$file" ] || { echo "there is no $file"; status=1; }
done
sh "$root/tests/house/links.sh" "$prefix/share/slipwave" || { echo 'links of the installed pages lead nowhere'; status=1; }

# Surveys run where they are installed, and write nothing there.
unset MAKEFLAGS MAKELEVEL
find "$prefix" | sort > "$made/before"
make -C "$prefix/share/slipwave/surveys/quickstart" STEP=20 OUT="$made/out" >"$made/said" 2>&1 ||
  { cat "$made/said"; echo 'the installed survey fails'; status=1; }
grep -q "^$prefix/bin/sw-shoot " "$made/said" || { cat "$made/said"; echo 'the installed survey takes other tools'; status=1; }
[ -s "$made/out/traces.png" ] || { echo 'the installed survey draws nothing'; status=1; }
find "$prefix" | sort | diff "$made/before" - || { echo 'the survey changed what is installed'; status=1; }
exit "$status"
