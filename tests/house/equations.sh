#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# equations.sh ROOT [--write]: every equation tag (E1), (S2a) ... of docs/theory/*.md stands once and has a test that
# proves it, and docs/theory/tests.md lists them as the tests say: --write makes that page.
# A tag is defined where it ends a line of mathematics. A test says "// Proves (E1), (S2a)." above its first line.
# Tests that pages of docs/ name exist, and so do equations that comments cite, "theory.md (E1)".
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# "test Suite.Name" of every test, "proves TAG Suite.Name" of what it says, "fault ..." of what is said of no test.
find tests -name '*_test.cpp' | sort | xargs awk '
  FNR == 1 && said != "" { printf "fault %s: \"%s\" stands above no test\n", before, said; said = "" }
  { before = FILENAME }
  /^\/\/ Proves \(/ { said = $0; next }
  # A test may be split over two lines.
  { line = held $0; held = "" }
  line ~ /^(TYPED_)?TEST(_F|_P)?\(/ && line !~ /\)/ { held = line; next }
  line ~ /^(TYPED_)?TEST(_F|_P)?\(/ {
    sub(/^[A-Z_]+\(/, "", line)
    sub(/\).*/, "", line)
    gsub(/[ \t]/, "", line)
    sub(/,/, ".", line)
    print "test", line
    while (match(said, /\([A-Z][0-9]+[a-z]?\)/)) {
      print "proves", substr(said, RSTART + 1, RLENGTH - 2), line
      said = substr(said, RSTART + RLENGTH)
    }
    said = ""
    next
  }
  said != "" && !/^\/\// && !/^(INSTANTIATE|TYPED)/ { printf "fault %s:%d: \"%s\" stands above no test\n", FILENAME, FNR, said; said = "" }
  END { if (said != "") printf "fault %s: \"%s\" stands above no test\n", before, said }' > "$work/said"
sed -n 's/^test //p' "$work/said" > "$work/tests"
if sed -n 's/^fault //p' "$work/said" | grep .; then status=1; fi

pages=$(find docs/theory -name '*.md' ! -name tests.md 2>/dev/null | sort)
[ -n "$pages" ] || { echo 'docs/theory holds no pages'; exit 1; }
# shellcheck disable=SC2086
awk -v said="$work/said" '
  BEGIN {
    while ((getline line < said) > 0) {
      split(line, word, " ")
      if (word[1] == "proves") tests[word[2]] = tests[word[2]] " " word[3]
    }
  }
  FNR == 1 {
    page = FILENAME
    sub(/.*\//, "", page)
    title = $0
    sub(/^# */, "", title)
    heading = sprintf("\n## [%s](%s)\n", title, page)
  }
  /  \([A-Z][0-9]+[a-z]?\)$/ {
    match($0, /\([A-Z][0-9]+[a-z]?\)$/)
    tag = substr($0, RSTART + 1, RLENGTH - 2)
    if (tag in seen) { printf "%s:%d: (%s) stands at %s already\n", FILENAME, FNR, tag, seen[tag] > "/dev/stderr"; bad = 1 }
    seen[tag] = FILENAME ":" FNR
    if (!(tag in tests)) { printf "%s:%d: (%s) is proved by no test\n", FILENAME, FNR, tag > "/dev/stderr"; bad = 1; next }
    if (heading != "") { print heading; heading = "" }
    list = "* **(" tag ")**"
    n = split(tests[tag], name, " ")
    for (i = 1; i <= n; ++i) {
      one = " `" name[i] "`" (i < n ? "," : "")
      if (length(list) + length(one) > 120) { print list; list = " " }
      list = list one
    }
    print list
  }
  END {
    for (tag in tests) if (!(tag in seen)) { printf "(%s) of%s stands on no page\n", tag, tests[tag] > "/dev/stderr"; bad = 1 }
    exit bad
  }' $pages > "$work/rows" 2> "$work/faults" || { cat "$work/faults"; status=1; }
{
  echo '# Equations and the tests that prove them'
  echo
  echo 'Made from the tests, which say above their first line what they prove: `sh tests/house/equations.sh . --write`.'
  cat "$work/rows"
} > "$work/page"
if [ "${2-}" = --write ]; then
  cp "$work/page" docs/theory/tests.md
elif ! cmp -s "$work/page" docs/theory/tests.md; then
  diff docs/theory/tests.md "$work/page" | head -n 12 || :
  echo 'docs/theory/tests.md is not what the tests say: sh tests/house/equations.sh . --write'
  status=1
fi

find docs -name '*.md' ! -path docs/theory/tests.md | sort | while IFS= read -r page; do
  names=$(grep -oE '`[A-Z][A-Za-z0-9]*[.][A-Z][A-Za-z0-9_]*`' "$page" | tr -d '`' | sort -u || :)
  for name in $names; do
    grep -qxF "$name" "$work/tests" || echo "$page: there is no test $name"
  done
done > "$work/unknown"
if grep . "$work/unknown"; then status=1; fi

# "/// ... (theory.md (V4), (V7))": all tags behind the name of the page on its line and, where it ends the line, on the next.
find lib tools tests -name '*.?pp' 2>/dev/null | sort | xargs awk -v rows="$work/rows" '
  BEGIN { while ((getline line < rows) > 0) if (match(line, /^\* \*\*\([A-Z][0-9]+[a-z]?\)/)) seen[substr(line, 6, RLENGTH - 6)] = 1 }
  { text = cited ? $0 : ""; cited = 0 }
  match($0, /theory(\/[a-z-]+)?[.]md/) { text = substr($0, RSTART + RLENGTH); cited = text ~ /^[ ,]*$/ }
  text ~ /^[ ,]*\(?[A-Z][0-9]+[a-z]?[) ,:;.]/ {
    while (match(text, /[A-Z][0-9]+[a-z]?/)) {
      tag = substr(text, RSTART, RLENGTH)
      text = substr(text, RSTART + RLENGTH)
      if (!(tag in seen)) { printf "%s:%d: there is no equation (%s)\n", FILENAME, FNR, tag; bad = 1 }
      # No further than the list of tags goes.
      if (text !~ /^\)?( to|,|-| and)? ?\(?[A-Z][0-9]/ ) break
    }
  }
  END { exit bad }' || status=1
exit "$status"
