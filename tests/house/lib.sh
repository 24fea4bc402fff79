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
