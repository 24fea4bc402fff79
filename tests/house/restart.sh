#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# restart.sh ROOT BUILD: `make -j` of a survey, interrupted and begun again: shots that were finished are kept, no part of a
# shot is taken for one, and the result is that of a survey that ran through.
set -eu
root=$1
build=$2
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
unset MAKEFLAGS MAKELEVEL
PATH=$build/bin:$PATH
cd "$work"
sw-layers --size 1500x900 --step 10 --layer 0:1500:0:1000 --layer 200:2500:1300:2200 -q -o model.nc
cat > Makefile <<'END'
include $(SURVEY_MK)
X = 300 500 700 900 1100 1300
SHOTS = $(X:%=$(OUT)/shot-%.sgy)
all: $(OUT)/line.sgy## everything
$(OUT)/shot-%.sgy: model.nc | $(OUT)
	if [ $* -gt 900 ] && [ -e hold ]; then sleep 600; fi
	$(BIN)/sw-shoot $< --source $*,10 --wavelet ricker:15 --receivers 0:1500:20,15 --time 1 --first-shot $* --threads 1 -q -o $@
$(OUT)/line.sgy: $(SHOTS)## all shots
	$(BIN)/sw-sort $^ --key shot,channel -o $@
END
survey() { make -s SURVEY_MK="$root/surveys/survey.mk" BUILD="$build" "$@"; }

survey OUT="$work/whole" -j 2 || broken 'the survey failed'
: >hold # the last two shots, so that a busy machine does not run through before it is interrupted
# A make in a process group of its own gets what a terminal sends at Ctrl-C.
setsid sh -c 'trap - INT; exec make -s "$@"' - SURVEY_MK="$root/surveys/survey.mk" BUILD="$build" OUT="$work/out" -j 2 \
  >"$work/said" 2>&1 &
group=$!
tries=0
# Two shots may be in place without make knowing: it takes those for unfinished, and removes them.
until [ "$(find "$work/out" -name 'shot-*.sgy' 2>/dev/null | wc -l)" -ge 3 ] || [ "$tries" -ge 1200 ]; do
  tries=$((tries + 1))
  sleep 0.05
done
kill -TERM -"$group"
rm hold
wait "$group" 2>/dev/null && broken 'an interrupted make ends with status 0'
[ ! -e "$work/out/line.sgy" ] || broken 'the survey ran through before it was interrupted'
find "$work/out" -name 'shot-*.sgy' -exec stat -c '%n %Y %i' {} + | sort > "$work/finished"
count=$(wc -l < "$work/finished")
if ! { [ "$count" -ge 1 ] && [ "$count" -le 5 ]; }; then broken "$count shots were finished, expected some"; fi
for file in "$work/out"/*; do
  case ${file##*/} in shot-*.sgy | settings) ;; *) broken "the interruption left $file" ;; esac
done

survey OUT="$work/out" -j 2 || broken 'the survey failed at its second start'
cut -d ' ' -f 1 "$work/finished" | xargs stat -c '%n %Y %i' | sort | cmp -s - "$work/finished" ||
  broken 'shots that were finished were computed again'
for x in 300 500 700 900 1100 1300; do
  cmp "$work/whole/shot-$x.sgy" "$work/out/shot-$x.sgy" || broken "shot $x is another"
done
# The textual header names the files.
cmp -i 3200 "$work/whole/line.sgy" "$work/out/line.sgy" || broken 'the line is another'
exit "$status"
