#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# guide.sh ROOT BUILD PAGE: the commands of docs/guide/PAGE.md, one after the other in a folder of their own, and the answer
# that they give. In cells and at wavelengths 2.5 times as large, which weakens thin beds, so with a tenth of the noise;
# SLIPWAVE_LONG=1: as they stand there, where KEEP may name a folder for the pictures.
set -eu
root=$1
build=$2
page=$3
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
PATH=$build/bin:$PATH
export PATH

commands_of "$root/docs/guide/$page.md" > "$work/as-written"
if [ "${SLIPWAVE_LONG-}" = 1 ]; then
  cp "$work/as-written" "$work/commands"
else
  awk '
    function scaled(name, by,   value, list, n, i) {
      if (!match($0, name "[0-9.,]+")) return
      gsub(/[][]/, "", name)
      value = substr($0, RSTART + length(name), RLENGTH - length(name))
      n = split(value, list, ",")
      value = list[1] * by
      for (i = 2; i <= n; ++i) value = value "," list[i] * by
      $0 = substr($0, 1, RSTART - 1) name value substr($0, RSTART + RLENGTH)
    }
    { scaled("--step ", 2.5); scaled("ricker:", 0.4); scaled("--band ", 0.4); scaled("peak > 2 [*] ", 0.1); print }' "$work/as-written" > "$work/commands"
  [ "$(diff "$work/as-written" "$work/commands" | grep -c '^>')" -ge 2 ] || {
    echo 'the short form finds no step or no wavelet to change'
    exit 1
  }
fi
run_commands

grep -oE '[a-z0-9-]+\.(png|pdf|svg)\b' "$work/as-written" | sort -u > "$work/pictures"
while IFS= read -r picture; do
  [ -s "$picture" ] || broken "$picture was not made"
  [ -s "$root/docs/pictures/guide/$picture" ] || broken "docs/pictures/guide/$picture is not there"
done < "$work/pictures"
# answer PATTERN CONDITION: the numbers n[1], n[2], ... of all lines that match meet the condition.
answer() {
  grep -E "$1" "$work/said" | sed 's/offset [0-9:]*//' | grep -oE '[0-9.]+(e-[0-9]+)?' |
    awk '{ n[NR] = $1 } END { exit !(NR && ('"$2"')) }' ||
    broken "$(grep -E "$1" "$work/said" | tr '\n' ';') expected $2"
}
case $page in
  # Fractures that stand almost upright change what passes them at an angle.
  marine) answer '^offset .*NRMS' 'n[4] > 3 * n[1] && n[3] > n[2] && n[4] > 20' ;;
  # More beyond the ground roll than in it; losses weaken.
  land)
    answer '^offset .*NRMS' 'n[2] > 2 * n[1] && n[3] > 2 * n[1] && n[3] > 10'
    answer '^ *component .*rms' 'n[NR] > n[NR / 2]'
    ;;
  # Some channels, near the stage or below it.
  borehole)
    answer '^ *traces ' 'n[1] > 50 && n[1] < 350'
    answer '^strongest' 'n[1] > 1100 && n[2] > 4 && n[2] < 40'
    ;;
  # The strike, from the weakest trace and from the strongest.
  three-d) answer '^across' 'n[1] == 30 && n[2] > 3 * n[4] && n[3] > 90 && n[3] < 160' ;;
  *) broken "no answer of $page is known here" ;;
esac
[ -z "${KEEP-}" ] || { mkdir -p "$KEEP"; cp ./*.png "$KEEP"; }
exit "$status"
