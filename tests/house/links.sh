#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# links.sh ROOT: relative links of the documentation lead to files that exist, and to headings that these have.
set -eu
cd "$1"
status=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# anchors PAGE: what a link says of its headings: small letters, digits, "-" for blanks, nothing else.
anchors() {
  awk '/^```/ { inside = !inside } !inside && /^#+ / { sub(/^#+ */, ""); print }' "$1" | tr '[:upper:]' '[:lower:]' |
    sed 's/\[\([^]]*\)\]([^)]*)/\1/g; s/[^a-z0-9 _-]//g; s/ /-/g'
}
for page in README.md $(find docs surveys -name '*.md' | sort); do
  grep -oE '\]\([^) ]+\)' "$page" | sed 's/^](//; s/)$//' > "$work/links" || :
  while IFS= read -r link; do
    case $link in
      http://* | https://*) continue ;;
    esac
    file=${link%%#*}
    target=$page
    [ -z "$file" ] || target=$(dirname "$page")/$file
    if [ ! -e "$target" ]; then
      echo "$page: the link to $link leads nowhere"
      status=1
      continue
    fi
    case $link in
      *.md#* | '#'*)
        anchors "$target" | grep -qxF -e "${link#*#}" && continue
        echo "$page: $(realpath --relative-to=. "$target") has no heading #${link#*#}"
        status=1
        ;;
    esac
  done < "$work/links"
done
exit "$status"
