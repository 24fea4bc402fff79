# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh
# What tests of the house begin with: a folder of their own that goes in the end, and a word for what is broken.
# Source it; what a script ends with is `exit "$status"`.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
broken() {
  echo "$1"
  # shellcheck disable=SC2034 # theirs
  status=1
}
# commands_of PAGE: the lines of its ```sh blocks, each block announced.
commands_of() {
  awk '/^```sh$/ { inside = 1; print "echo \"--- block " ++block "\""; next } /^```/ { inside = 0 } inside' "$1"
}
# run_commands: $work/commands in $work/folder, where the test then stands; what they say is shown, and kept in $work/said.
run_commands() {
  mkdir "$work/folder"
  cd "$work/folder" || exit
  sh -eu "$work/commands" </dev/null >"$work/said" 2>&1 || { cat "$work/said"; echo 'a command failed'; exit 1; }
  cat "$work/said"
}
