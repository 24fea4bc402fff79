#!/bin/sh
# words.sh ROOT: no file names somebody's machine, a package host, an issue number or work left undone.
set -eu
cd "$1"
# Each pattern is written so that this file does not match itself.
pattern='(^|[^[:alnum:]_.])/([w]ork|[h]ome|[r]oot|[U]sers|[m]nt)/'
pattern="$pattern|[d]eb[.]debian|[r]egistry[.]npm|[p]ypi[.]org"
pattern="$pattern|[i]ssue #?[0-9]|(^|[^[:alnum:]])([T]ODO|[F]IXME|[X]XX)([^[:alnum:]]|\$)"
if find . \( -name .git -o -path ./build -o -path './surveys/*/out' \) -prune -o -type f -print | sort |
  xargs grep -nIE -- "$pattern"; then
  exit 1
fi
# Pictures tell how they were made, too.
if find docs -name '*.png' -print | sort | LC_ALL=C xargs grep -laE -- "(^|[^[:alnum:]_.])/([w]ork|[h]ome|[r]oot|[U]sers|[m]nt)/"; then
  echo 'these pictures tell of folders of somebody'
  exit 1
fi
