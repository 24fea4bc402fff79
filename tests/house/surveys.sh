#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# surveys.sh ROOT BUILD: what every survey has and says, and that a survey without its data says so and makes nothing.
set -eu
root=$1
SLIPWAVE_BUILD=$2
export SLIPWAVE_BUILD
unset MAKEFLAGS MAKELEVEL
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0
broken() {
  echo "$1"
  status=1
}

for makefile in "$root"/surveys/*/Makefile; do
  survey=$(dirname "$makefile")
  name=$(basename "$survey")
  [ -f "$survey/README.md" ] || broken "surveys/$name has no README.md"
  help=$(make -s -C "$survey" BUILD="$2" OUT="$out" help) || broken "surveys/$name: make help failed"
  made=
  if grep -q slip_pair.mk "$makefile"; then made=$out/response.sgy; fi
  for target in all clean summary $made; do
    case $help in
      *"$target "*) ;;
      *) broken "surveys/$name: make help does not tell of $target" ;;
    esac
  done
  for setting in "OUT=$out" $(sed -n 's/^\([A-Z]*\) = *\([^ #]*\)# .*/\1=\2/p' "$makefile"); do
    case $help in
      *" $setting "*) ;;
      *) broken "surveys/$name: make help does not tell of the setting $setting" ;;
    esac
  done
  said=$("$root/surveys/run" 2>&1) && broken "surveys/run without a name ends with status 0"
  case $said in
    *" $name"*) ;;
    *) broken "surveys/run does not tell of $name" ;;
  esac
done

# What make would run is said without running it.
plan=$(make -C "$root/surveys/quickstart" BUILD="$2" OUT="$out" -n) || broken 'quickstart: make -n failed'
for tool in sw-layers sw-fracture sw-shoot sw-diff sw-spectrum sw-compare sw-info; do
  case $plan in
    *"/$tool "*) ;;
    *) broken "quickstart: make -n does not tell of $tool" ;;
  esac
done

if make -s -C "$root/surveys/gallery" BUILD="$2" OUT="$out" slurm >/dev/null 2>&1; then
  broken 'gallery: make slurm writes a job without tasks'
fi

for target in paper-marmousi 'accuracy marmousi2-model.nc'; do
  # shellcheck disable=SC2086
  set -- $target
  if said=$("$root/surveys/run" "$1" DATA="$out/nowhere" OUT="$out/made" ${2:+"$out/made/$2"} 2>&1); then
    broken "$1 without its data ends with status 0"
  fi
  case $said in
    *"$out/nowhere/marmousi_II_marine."*' is not there'*) ;;
    *) broken "$1 without its data says: $said" ;;
  esac
done
[ -z "$(ls "$out")" ] || broken "what should make nothing made: $(ls "$out")"

"$root/surveys/run" nope >/dev/null 2>&1 && code=0 || code=$?
[ "$code" = 2 ] || broken "surveys/run nope: exit status $code, expected 2"
exit "$status"
