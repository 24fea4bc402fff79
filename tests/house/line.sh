#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# line.sh ROOT BUILD: the survey line in short: a target a shot, sorted traces, an interrupted run continues, and the array job
# makes the same bytes.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
bin=$2/bin
survey() { "$root/surveys/run" line STEP=50 SHOTS=3 "$@"; }
# sums FOLDER: what the traces of all files are, whatever commands their texts tell of.
sums() {
  for file in $(cd "$1" && find . -name '*.sgy' | sort); do
    echo "$file $(tail -c +3601 "$1/$file" | cksum)"
  done
}

# One shot alone, then the rest.
survey OUT="$work/out" "$work/out/fractured/2.sgy" >/dev/null 2>&1
plan=$(survey OUT="$work/out" -n)
[ "$(printf '%s\n' "$plan" | grep -c 'sw-shoot ')" -eq 5 ] || broken "with one shot of six there make plans: $plan"
survey OUT="$work/out" -j 2 >"$work/said" 2>"$work/told" || broken "the line failed: $(tail -n 2 "$work/told")"
grep -q '^ *shots  *3$' "$work/said" || broken "the line has not its three shots: $(cat "$work/said")"
for picture in model near near-response cdp shot spectrum; do
  [ -s "$work/out/$picture.png" ] || broken "there is no $picture.png"
done
"$bin/sw-sort" "$work/out/response.sgy" --key cdp,offset -o "$work/again.sgy"
[ "$(tail -c +3601 "$work/again.sgy" | cksum)" = "$(tail -c +3601 "$work/out/response.sgy" | cksum)" ] ||
  broken 'the line is not sorted by midpoint and offset'
# The nearest traces are one a shot, each of its own.
"$bin/sw-info" "$work/out/near.sgy" | grep -q '^ *traces  *3$' || broken 'near.sgy does not hold a trace a shot'

# Killed on its way, however it ends, make continues to the same bytes.
survey OUT="$work/killed" >/dev/null 2>&1 &
made=$!
n=0
while [ ! -e "$work/killed/fractured/1.sgy" ] && [ "$n" -lt 600 ]; do
  sleep 0.05
  n=$((n + 1))
done
kill "$made" 2>/dev/null || :
wait "$made" || :
survey OUT="$work/killed" >/dev/null 2>&1 || broken 'a killed run does not continue'
[ "$(sums "$work/killed")" = "$(sums "$work/out")" ] || broken 'after a kill the traces are others'

# The array job, by an sbatch that runs all tasks at once and prints a number.
said=$(survey OUT="$work/array" slurm 2>/dev/null) || broken 'make slurm failed'
mkdir "$work/path"
cat >"$work/path/sbatch" <<'SBATCH'
#!/bin/sh
set -eu
array=
for argument in "$@"; do
  case $argument in
    --array=*) array=${argument#--array=} ;;
    --parsable | --dependency=afterok:4711) ;;
    -*) echo "sbatch: unknown option $argument" >&2; exit 1 ;;
    *) script=$argument ;;
  esac
done
: "${array:=$(sed -n 's/^#SBATCH --array=//p' "$script")}"
for task in $(seq "${array%-*}" "${array#*-}"); do
  SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=1 sh "$script" >>"$script.log" 2>&1 || exit 1
done
echo 4711
SBATCH
chmod +x "$work/path/sbatch"
submit=$(printf '%s\n' "$said" | sed -n 's/^ *\(sbatch .*\)/\1/p')
(cd "$work/array" && PATH=$work/path:$PATH && sh -eu -c "$submit") >/dev/null ||
  broken "the array job failed: $(tail -n 3 "$work"/array/*.log)"
[ "$(sums "$work/array")" = "$(sums "$work/out")" ] || broken 'the array job makes other traces'
[ -s "$work/array/near.png" ] || broken 'task 0 of the array job makes no pictures'
exit "$status"
