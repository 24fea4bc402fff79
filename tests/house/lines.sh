#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# lines.sh ROOT [--write]: lines of pages and man pages, and cells of tables, are of at most 200 characters. --write wraps
# paragraphs that have longer ones; code and cells stay as they are.
set -eu
cd "$1"
status=0
made=$(mktemp)
trap 'rm -f "$made"' EXIT
for page in README.md $(find docs surveys -path '*/out/*' -prune -o \( -name '*.md' -o -name '*.1' \) -print | sort); do
  awk -v page="$page" -v write="${2-}" -v most=200 -v width=130 '
    # Lines are counted in characters, whatever the locale: bytes that continue one do not count.
    function size(text,   copy) { copy = text; gsub(/[\200-\277]/, "", copy); return length(copy) }
    function fault(what) { printf "%s:%d: %s of %d characters, expected at most %d\n", page, FNR, what, long, most > "/dev/stderr"; bad = 1 }
    # A word that would begin a list, a heading or a request, were it the first of a line, stays behind the one before it.
    function bound(word) { return word ~ /^([-+*#|>.%\047]|[0-9]+[.)]$)/ }
    function wrap(   words, n, i, line, indent) {
      n = split(paragraph, words, / +/)
      indent = paragraph ~ /^\* / ? "  " : paragraph ~ /^[0-9]+\. / ? "   " : ""
      line = lead
      for (i = 1; i <= n; ++i) {
        if (words[i] == "") continue
        if (line != lead && line !~ /^ *$/ && size(line " " words[i]) > width && !bound(words[i])) { print line; line = lead indent words[i] }
        else line = line (line == lead && i == 1 || line ~ /^ *$/ ? "" : " ") words[i]
      }
      print line
    }
    function flush(   i) {
      if (count && wide && write == "--write") wrap()
      else for (i = 1; i <= count; ++i) print held[i]
      count = wide = 0
      paragraph = ""
    }
    function plain() { flush(); print }
    { long = size($0) }
    page ~ /[.]md$/ && /^```/ { plain(); code = !code; next }
    # What a page does not show, and code: longer where it must be.
    page ~ /[.]md$/ && /^<!--/ && !/-->/ { hidden = 1 }
    hidden { plain(); if (/^-->/) hidden = 0; next }
    code && page ~ /[.]md$/ { plain(); if (long > most) fault("a line"); next }
    page ~ /[.]md$/ && /^\|/ {
      plain()
      n = split($0, cell, "|")
      for (i = 1; i <= n; ++i) { gsub(/^ +| +$/, "", cell[i]); long = size(cell[i]); if (long > most) fault("a cell") }
      next
    }
    page ~ /[.]1$/ && /^[.](EX|nf)/ { code = 1 }
    page ~ /[.]1$/ && /^[.](EE|fi)/ { code = 0 }
    page ~ /[.]1$/ && (code || /^[.\047]/ || /^ /) { plain(); if (long > most) fault("a line"); next }
    page ~ /[.]md$/ && (/^#/ || /^    / || /^<!--/ || /^-->/ || /^!\[/ || /^ *$/) {
      plain()
      if (long > most) fault("a line")
      next
    }
    /^ *$/ { plain(); next }
    /^ *\* / || /^ *[0-9]+\. / || page ~ /[.]1$/ { flush() }
    {
      if (!count) { match($0, /^ */); lead = substr($0, 1, RLENGTH); paragraph = substr($0, RLENGTH + 1) }
      else { text = $0; sub(/^ +/, "", text); paragraph = paragraph " " text }
      held[++count] = $0
      if (long > most) { wide = 1; if (write != "--write") fault("a line") }
    }
    END { flush(); exit bad }' "$page" > "$made" || status=1
  [ "${2-}" != --write ] || cmp -s "$made" "$page" || cat "$made" > "$page"
done
exit "$status"
