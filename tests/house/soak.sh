#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# soak.sh ROOT BUILD [SHOTS]: the survey line under `make -j 2` while its disk is filled at intervals, its memory is limited now and
# then, and tools are killed at random. Whatever file is there is the one of a quiet run, every failure says so, and make
# completes the rest once it is left in peace.
# shellcheck disable=SC3045 # dash and bash have ulimit -v
set -eu
# Where that is allowed, with a small disk of its own that goes away with the process.
if [ -z "${SOAK_APART-}" ]; then
  SOAK_APART=yes
  export SOAK_APART
  if unshare -m true 2>/dev/null; then exec unshare -m sh "$0" "$@"; fi
fi
root=$1
bin=$2/bin
shots=${3:-3}
unset MAKEFLAGS MAKELEVEL
work=$(mktemp -d)
small=$work/small
out=$small/out
mkdir "$small"
helpers=
trap 'rm -f "$work/disturbing"; for helper in $helpers; do kill "$helper" 2>/dev/null || :; done; wait; umount "$small" 2>/dev/null || :
  rm -rf "$work"' EXIT
status=0
broken() {
  echo "$1"
  status=1
}
# random LOW HIGH: a whole number between them.
random() { echo $(($1 + $(od -An -N2 -tu2 /dev/urandom) % ($2 - $1 + 1))); }
pause() { sleep "$(awk "BEGIN { print $(random "$1" "$2") / 1000 }")"; } # ms

survey() {
  TMPDIR=$small exec setsid make --no-print-directory -C "$root/surveys/line" BIN="$bin" OUT="$out" THREADS=1 STEP=50 \
    SHOTS="$shots" "$@"
}

# The quiet run, where the others will be: files tell of the names of their inputs.
(survey -j 2) >/dev/null 2>"$work/told" || { tail -n 3 "$work/told"; exit 1; }
mv "$out" "$work/whole"

used=$(du -sk "$work/whole" | cut -f1)
if mount -t tmpfs -o size=$((used * 3 / 2 + 2048))k none "$small" 2>/dev/null; then disk=small; else disk=limited; fi

fill() {
  while [ -e "$work/disturbing" ]; do
    head -c 4G /dev/zero >"$small/filler" 2>/dev/null || :
    pause 200 700
    rm -f "$small/filler"
    pause 200 900
  done
}
longest_pause=$((900 + 40 * shots)) # ms, between kills
kill_one() {
  session=$(cat "$work/session")
  tool=$([ -z "$session" ] || pgrep -s "$session" '^sw-' | shuf -n 1)
  [ -n "$tool" ] && kill -KILL "$tool" 2>/dev/null && echo "$tool" >>"$work/kills"
}
kill_some() {
  while [ -e "$work/disturbing" ]; do
    pause 200 "$longest_pause"
    until kill_one || [ ! -e "$work/disturbing" ]; do sleep 0.01; done
  done
}

# Killed tools leave temporaries, which the next that writes the same file removes.
count_temporaries() { find "$out" -name '.*.tmp' | wc -l; }

# Files that are there are whole and right.
look() {
  (cd "$out" 2>/dev/null && find . -type f ! -name '.*.tmp') | while read -r file; do
    cmp -s "$out/$file" "$work/whole/$file" || echo "$file"
  done >"$work/wrong"
  [ ! -s "$work/wrong" ] || broken "in round $round there is a wrong $(cat "$work/wrong")"
}

# What failed did so by a status of its own, and with a word, but for what was killed.
words() {
  grep -E '^make.*\*\*\* \[' "$work/told" >"$work/failed" || return 0
  if grep -Ev ' (Error (1|2|126|127|137)|Killed)$' "$work/failed"; then broken "in round $round that is no way to fail"; fi
  mute=$(grep -Ecv ' (Error 137|Killed)$' "$work/failed" || :)
  said=$(grep -Evc '^(make|Killed$)' "$work/told" || :)
  [ "$said" -ge "$mute" ] || broken "in round $round $mute tools failed and $said said so: $(cat "$work/told")"
  cat "$work/failed" >>"$work/failures"
  cat "$work/told" >>"$work/all-told"
}

: >"$work/kills"
: >"$work/left"
: >"$work/failures"
: >"$work/all-told"
: >"$work/disturbing"
: >"$work/session"
if [ "$disk" = small ]; then
  fill &
  helpers="$helpers $!"
fi
kill_some &
helpers="$helpers $!"
round=0
wanted=$((shots / 3 + 3)) # failures, and a kill, or it was no trial
while [ "$round" -lt $((100 * wanted)) ]; do
  round=$((round + 1))
  (
    case $((round % 4)) in
      2) ulimit -v "$(random 60000 600000)" ;;
      3) [ "$disk" = small ] || ulimit -f "$(random 1 600)" ;;
    esac
    survey -k -j 2
  ) >/dev/null 2>"$work/told" &
  made=$!
  echo "$made" >"$work/session.new"
  mv "$work/session.new" "$work/session"
  done=0
  wait "$made" || done=$?
  count_temporaries >>"$work/left"
  look
  words
  [ "$status" -eq 0 ] || break
  if [ "$done" -eq 0 ]; then
    if [ "$(wc -l <"$work/failures")" -ge "$wanted" ] && [ -s "$work/kills" ]; then break; fi
    rm -rf "$out"
  elif [ ! -s "$work/failed" ] && ! grep -q '^make' "$work/told"; then
    broken "in round $round make failed without a word"
  fi
done
rm "$work/disturbing"
for helper in $helpers; do wait "$helper" || :; done
helpers=
rm -f "$small/filler"

failures=$(wc -l <"$work/failures")
[ "$failures" -ge "$wanted" ] || broken "only $failures failures in $round rounds: nothing was tried"
[ -s "$work/kills" ] || broken 'nothing was killed'
left=$(sort -n "$work/left" | tail -n 1)
if (survey -j 2) >/dev/null 2>"$work/told"; then
  # Temporaries would be files too many.
  diff -r "$out" "$work/whole" || broken 'after all that it is not the same survey'
  [ -z "$( (survey -n) 2>&1 | grep -v -e '^make' -e sw-info -e echo -e '^cat' || :)" ] || broken 'make is not done'
else
  broken "left in peace it fails: $(tail -n 3 "$work/told")"
fi
echo "$shots shots, $disk disk: $round rounds, $failures failures, $(wc -l <"$work/kills") tools killed," \
  "$(grep -c 'No space left\|File too large' "$work/all-told") said the disk was full," \
  "$(grep -ci 'memory\|failed to map' "$work/all-told") that memory was short, up to $left temporaries left by a round"
exit "$status"
