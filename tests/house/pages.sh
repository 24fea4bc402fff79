#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# pages.sh ROOT BUILD [--write] [--in FOLDER] [PAGE...]: figures on pages are those of the run. A figure stands between <!--=NAME--> and
# <!--/-->; a comment of the page says how it is made, in the folder where the commands of the page have run:
#   <!-- figures
#   NAME: COMMAND
#   -->
# Commands find what the page said in the file $said, and `number N` rounds the first word of their input to N digits.
# A page of a survey may say what make makes first: `make: TARGET SETTING=VALUE`.
# Without --write the script fails where page and run differ by more than one in the last digit; with it, it fills the page.
# Without pages it takes README.md, and looks at the markers of all; `all` is every page with figures. --in says where the
# commands of the one page have been run already.
set -eu
root=$(cd "$1" && pwd)
build=$2
shift 2
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"
write=
[ "${1-}" != --write ] || { write=yes; shift; }
there=
[ "${1-}" != --in ] || { there=$2; shift 2; }
with_figures() { cd "$root" && grep -lrE '^<!-- figures$|^<!--=|^[^ ].*<!--=' README.md docs surveys --include='*.md' | sort; }
# shellcheck disable=SC2046 # names of pages hold no blanks
case ${1-} in
  '') set -- README.md ;;
  all) set -- $(with_figures) ;;
esac
unset MAKELEVEL
MAKEFLAGS="BUILD=$build"
SLIPWAVE=$root
SLIPWAVE_BUILD=$build
PATH=$build/bin:$PATH
export MAKEFLAGS SLIPWAVE SLIPWAVE_BUILD PATH

# recipes PAGE: its lines NAME: COMMAND.
recipes() { awk '/^<!-- figures$/ { inside = 1; next } /^-->$/ { inside = 0 } inside' "$1"; }

# Markers come in pairs, and each has its command. Indented lines are examples.
for page in $(with_figures); do
  recipes "$root/$page" | sed -n 's/^\([a-z0-9-]*\): .*/\1/p' | grep -vx make | sort > "$work/made" || :
  grep -o '<!--=[a-z0-9-]*-->' "$root/$page" | sed 's/<!--=\(.*\)-->/\1/' | sort -u > "$work/wanted" || :
  diff "$work/made" "$work/wanted" > "$work/differ" || {
    sed -n "s|^< \(.*\)|$page: the figure \1 is made and stands nowhere|p; s|^> \(.*\)|$page: nothing makes the figure \1|p" "$work/differ"
    status=1
  }
  sort "$work/made" | uniq -d | sed "s|.*|$page: the figure & is made twice|" | grep . && status=1
  [ "$(grep -o '<!--=' "$root/$page" | wc -l)" = "$(grep -o '<!--/-->' "$root/$page" | wc -l)" ] ||
    broken "$page: a figure has no end"
done
[ "$status" = 0 ] || exit 1

cat > "$work/tools" <<'TOOLS'
number() {
  awk -v n="$1" '{
    x = $1 + 0
    if (x == 0) { print 0; exit }
    size = x < 0 ? -x : x
    e = int(log(size) / log(10) + 1000) - 1000
    if (sprintf("%.*e", n - 1, size) + 0 >= 10 ^ (e + 1)) e++
    if (e < -3) { text = sprintf("%.*e", n - 1, x); sub(/e-0/, "e-", text); print text }
    else if (n - 1 >= e) printf "%.*f\n", n - 1 - e, x
    else printf "%d\n", (x < 0 ? -1 : 1) * int(size / 10 ^ (e - n + 1) + 0.5) * 10 ^ (e - n + 1)
    exit
  }'
}
TOOLS

# run_page PAGE FOLDER: what the page says to do, done there.
run_page() {
  mkdir -p "$2"
  case $1 in
    surveys/*)
      targets=$(recipes "$root/$1" | sed -n 's/^make: //p')
      # shellcheck disable=SC2086
      make --no-print-directory -C "$root/$(dirname "$1")" OUT="$2" $targets > "$work/made-it" 2>&1 ||
        { cat "$work/made-it"; return 1; }
      cp "$work/made-it" "$2/said"
      ;;
    *)
      commands_of "$root/$1" | sed '/^\.\//d' > "$2/commands"
      (cd "$2" && sh -eu commands </dev/null) > "$2/said" 2>&1
      ;;
  esac
}

for page in "$@"; do
  folder=${there:-$work/run/$page}
  values=$work/values/$page
  mkdir -p "$values"
  [ -n "$there" ] || run_page "$page" "$folder" || { cat "$folder/said"; broken "$page: a command failed"; continue; }
  recipes "$root/$page" | grep -v '^make: ' > "$work/recipes" || :
  while IFS= read -r line; do
    name=${line%%: *}
    printf '%s\n' "${line#*: }" | cat "$work/tools" - > "$work/recipe"
    (cd "$folder" && said=$folder/said sh -eu "$work/recipe" </dev/null) > "$values/$name" || :
    [ -s "$values/$name" ] || { broken "$page: nothing comes of the figure $name"; continue 2; }
  done < "$work/recipes"
  awk -v values="$values" -v page="$page" -v log_file="$work/differences" '
    # near(a, b): the same words, numbers alike but for one in the last digit.
    function near(a, b,   p, q, n, i, digits, unit) {
      n = split(a, p, /[ \n]+/)
      if (split(b, q, /[ \n]+/) != n) return 0
      for (i = 1; i <= n; ++i) {
        if (p[i] == q[i]) continue
        if (p[i] !~ /^-?[0-9.]+$/ || q[i] !~ /^-?[0-9.]+$/) return 0
        digits = index(p[i], ".") ? length(p[i]) - index(p[i], ".") : 0
        unit = 10 ^ -digits
        if (!digits) while (unit < 1e6 && p[i] % (10 * unit) == 0 && q[i] % (10 * unit) == 0) unit *= 10
        if ((p[i] - q[i]) ^ 2 > (1.01 * unit) ^ 2) return 0
      }
      return 1
    }
    { text = text $0 "\n" }
    END {
      while (match(text, /<!--=[a-z0-9-]+-->/)) {
        name = substr(text, RSTART + 5, RLENGTH - 8)
        out = out substr(text, 1, RSTART + RLENGTH - 1)
        text = substr(text, RSTART + RLENGTH)
        stop = index(text, "<!--/-->")
        old = substr(text, 1, stop - 1)
        text = substr(text, stop)
        value = ""
        lines = 0
        while ((getline line < (values "/" name)) > 0) { value = value (lines++ ? "\n" : "") line }
        close(values "/" name)
        if (old ~ /^\n/) value = "\n" value "\n"
        if (!near(old, value)) printf "%s: %s is %s by the run, the page says %s\n", page, name, value, old > log_file
        out = out value
      }
      printf "%s%s", out, text
    }' "$root/$page" > "$work/filled"
  [ ! -s "$work/differences" ] || { cat "$work/differences"; [ -n "$write" ] || status=1; rm -f "$work/differences"; }
  [ -z "$write" ] || cmp -s "$work/filled" "$root/$page" || cat "$work/filled" > "$root/$page"
done
exit "$status"
