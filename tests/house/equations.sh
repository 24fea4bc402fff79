#!/bin/sh
# equations.sh ROOT: every equation tag (E1), (S2a) ... defined in docs/theory.md names tests, and those exist.
# A tag is defined where it ends a line of mathematics or starts a row of a table; its tests are named as
# `Suite.Test` on the lines down to the next definition. Tests that other pages of docs/ name exist, too.
set -eu
cd "$1"
theory=docs/theory.md
[ -f "$theory" ] || { echo "$theory is missing"; exit 1; }
tests=$(mktemp)
trap 'rm -f "$tests"' EXIT
find tests -name '*_test.cpp' | sort | xargs awk '
  # A test may be split over two lines.
  { line = held $0; held = "" }
  line ~ /^(TYPED_)?TEST(_F|_P)?\(/ && line !~ /\)/ { held = line; next }
  line ~ /^(TYPED_)?TEST(_F|_P)?\(/ {
    sub(/^[A-Z_]+\(/, "", line)
    sub(/\).*/, "", line)
    gsub(/[ \t]/, "", line)
    sub(/,/, ".", line)
    print line
  }' > "$tests"
status=0
awk -v tests="$tests" -v theory="$theory" '
  function close_tag() {
    if (tag != "" && !named) { printf "%s:%d: (%s) names no test\n", theory, at, tag; bad = 1 }
  }
  BEGIN { while ((getline name < tests) > 0) exists[name] = 1 }
  /  \([A-Z][0-9]+[a-z]?\)$/ {
    close_tag()
    named = 0
    at = FNR
    match($0, /\([A-Z][0-9]+[a-z]?\)$/)
    tag = substr($0, RSTART + 1, RLENGTH - 2)
    if (tag in seen) { printf "%s:%d: (%s) stands at line %d already\n", theory, FNR, tag, seen[tag]; bad = 1 }
    seen[tag] = FNR
    tags++
  }
  {
    rest = $0
    while (match(rest, /`[A-Z][A-Za-z0-9]*[.][A-Z][A-Za-z0-9_]*`/)) {
      name = substr(rest, RSTART + 1, RLENGTH - 2)
      rest = substr(rest, RSTART + RLENGTH)
      if (name in exists) named = 1
      else { printf "%s:%d: there is no test %s\n", theory, FNR, name; bad = 1 }
    }
  }
  END {
    close_tag()
    if (!tags) { print theory ": no equation tags found"; bad = 1 }
    exit bad
  }' "$theory" || status=1
for page in docs/*.md; do
  [ "$page" != "$theory" ] || continue
  names=$(grep -oE '`[A-Z][A-Za-z0-9]*[.][A-Z][A-Za-z0-9_]*`' "$page" | tr -d '`' | sort -u || :)
  for name in $names; do
    grep -qxF "$name" "$tests" || { echo "$page: there is no test $name"; status=1; }
  done
done
exit "$status"
