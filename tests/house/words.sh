#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# words.sh ROOT: no file names somebody's machine, a package host, an issue number or work left undone, each thing bears
# its one word of docs/notation.md, and doc comments of the library begin as sentences.
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

# Words of old, each as a pattern, and the one to write. The change log tells of the past and may use them.
found=$(mktemp -d)
trap 'rm -rf "$found"' EXIT
cat > "$found/words" <<'WORDS'
(^|[^y] )[m]atched[ _]layers?	PML
[M]atchedLayers?	Pml
\<[s]pan[ _]ends?\>	interface stencils
\<[S]panEnds?	InterfaceStencils
[p]ass(es)? through memory	time tiles
[P]assesThroughMemory	TheTiling
\<[u]nder[ _]way\>	in progress
\<[Rr]eckon(s|ed|ing)?\>	compute
\<[b]r(ing|ings|inging|ought) ([a-z]+ ){0,3}forward	advance
\<[g]one wrong\>	stale
\<[p]uts? right\>	refresh
\<[t]urns? (the|a) page	release
\<[C]rew\>	rank groups
\<[P]assage\>	time tile
\<[F]reeEdge\>	FreeSurface
\<[Uu]nsound	diverged
\<([e]rr|[e]rrs|[e]rred) (by|alike)\>	has an error of
\<[i]s no number\>	is not finite
\<(a|the|one|two|strong|welded) [c]ontacts?\>	interface
\<[c]ontacts? (of|between) \<	interface
\<(Tilted|Averaged|Plane)?[C]ontacts?\>	Interface
\<[f]ree faces?\>	free surface
\<[d]amped zones?\>	sponge
\<[a]head_pitch\>	pitch
\<[c]ells a ((shortest|dominant|slowest) )?wavelength	cells per wavelength
\<[p]hones\>	geophones, hydrophones
\<([g]o|[g]oes) on\>	continue
\<[t]ell_apart\>	split_by_runs
WORDS
for place in lib tools tests docs surveys README.md; do
  [ ! -e "$place" ] ||
    find "$place" \( -path 'surveys/*/out' -o -path docs/CHANGELOG.md \) -prune -o -type f -print
done | sort > "$found/files"
tab=$(printf '\t')
status=0
while IFS=$tab read -r left right; do
  xargs grep -nIoE -- "$left" /dev/null < "$found/files" > "$found/hits" || continue
  sed "s/:\([^:]*\)\$/: '\1': write '$right'/" "$found/hits"
  status=1
done < "$found/words"

# Where a doc comment begins, not where it continues.
find lib -name '*.?pp' | sort | xargs awk '
  FNR == 1 { inside = 0 }
  !/^ *\/\/\// { inside = 0; next }
  !inside && match($0, /\/\/\/ (Of|The same|Those|By how much)( |$)/) {
    print FILENAME ":" FNR ": \047" substr($0, RSTART + 4) "\047: write a sentence with a subject (\047Returns the ...\047)"
    found = 1
  }
  { inside = 1 }
  END { exit found }' || status=1
exit "$status"
