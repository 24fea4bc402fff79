#!/bin/sh
# links.sh ROOT: relative links of the documentation lead to files that exist.
set -eu
cd "$1"
status=0
for page in README.md $(find docs surveys -name '*.md' | sort); do
  links=$(grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//; s/#.*//' || :)
  for link in $links; do
    case $link in
      http://* | https://*) continue ;;
    esac
    if [ ! -e "$(dirname "$page")/$link" ]; then
      echo "$page: the link to $link leads nowhere"
      status=1
    fi
  done
done
exit "$status"
