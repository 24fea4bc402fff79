#!/bin/sh
# install.sh ROOT BUILD TOOL...: `cmake --install` brings every tool, its man page and its completion, and nothing else.
set -eu
root=$1
build=$2
shift 2
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" >/dev/null
status=0
for tool in "$@"; do
  said=$("$prefix/bin/$tool" --version) || { echo "$tool does not run where it is installed"; status=1; }
  case $said in
    "$tool (slipwave "[0-9]*) ;;
    *) echo "$tool --version says '$said'"; status=1 ;;
  esac
  cmp -s "$root/docs/man/$tool.1" "$prefix/share/man/man1/$tool.1" ||
    { echo "the man page of $tool is not installed"; status=1; }
  [ -s "$prefix/share/bash-completion/completions/$tool" ] ||
    { echo "the completion of $tool is not installed"; status=1; }
done
files=$(find "$prefix" -type f | wc -l)
if [ "$files" -ne $(($# * 3)) ]; then
  echo "installed $files files, expected a tool, a man page and a completion for each of: $*"
  find "$prefix" -type f
  status=1
fi
exit "$status"
