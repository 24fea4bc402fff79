#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# completion.sh BUILD TOOL...: what bash offers behind the tools, typed with tabs into a bash on a terminal of its own; and
# zsh and fish where they are installed.
set -eu
everything=$1/completions
completions=$everything/bash
bin=$1/bin
shift
# shellcheck source=tests/house/lib.sh
. "$(dirname -- "$0")/lib.sh"

# Every option is offered, and no other.
for tool in "$@"; do
  [ -s "$completions/$tool" ] || { broken "there is no completion of $tool"; continue; }
  bash -c 'compopt() { :; }
    . "$1" && COMP_WORDS=("$2" --) COMP_CWORD=1 && "_${2//-/_}" "$2" -- "$2" && printf "%s\n" "${COMPREPLY[@]}"' \
    - "$completions/$tool" "$tool" | sort > "$work/offered"
  "$bin/$tool" --help-all | sed -nE 's/^  (-., )?(--[a-z0-9-]+).*/\2/p' | sort > "$work/options"
  diff "$work/options" "$work/offered" || broken "$tool: --help-all lists the first, bash offers the second"
  for other in "$everything/zsh/_$tool" "$everything/fish/$tool.fish"; do
    while IFS= read -r option; do
      grep -qE -- "(\*${option}[=[]|-l ${option#--} )" "$other" || broken "$other does not offer $option"
    done < "$work/options"
  done
done
[ "$status" = 0 ] || exit 1

cd "$work"
echo > model.nc
echo > shots.sgy
python3 - "$completions" <<'END' || status=1
import os, pty, re, select, sys, time

typed_and_wanted = [
    ("sw-shoot --prec\tfl\t", "<--precision><float>"),
    ("sw-shoot mo\t--top=mi\t", "<model.nc><--top=mirror>"),
    ("sw-shoot --record vx,sz\t", "<--record><vx,szz>"),
    ("sw-shoot --fields=vx,slip_\t,cu\t", "<--fields=vx,slip_rate,curl>"),
    ("sw-shoot --without coh\t", "<--without><cohesion>"),
    ("sw-shoot -o sho\t", "<-o><shots.sgy>"),
    ("sw-shoot --output=sho\t", "<--output=shots.sgy>"),
    ("sw-shoot --time mod\t", "<--time><mod>"),
    ("sw-shoot --snap\tmod\t", "<--snapshots><model.nc>"),
    ("sw-plot --map red\t", "<--map><red-blue>"),
    ("sw-plot --overl\tmod\t", "<--overlay><model.nc>"),
    ("sw-spectrum --window=ha\tn\t", "<--window=hann>"),
    ("sw-info mod\t", "<model.nc>"),
]
child, terminal = pty.fork()
if child == 0:
    os.environ.update(PS1="", INPUTRC="/dev/null", TERM="dumb", HISTFILE="/dev/null")
    os.execvp("bash", ["bash", "--norc", "--noprofile", "-i"])


def read_until(mark):
    said, end = "", time.monotonic() + 20
    while not re.search(mark, said) and time.monotonic() < end:
        if select.select([terminal], [], [], 0.5)[0]:
            said += os.read(terminal, 65536).decode()
    return said


def type_in(text):
    os.write(terminal, text.encode())


type_in("bind 'set bell-style none'; bind 'set enable-bracketed-paste off'; stty -echo\n")
for tool in sorted({typed.split()[0] for typed, _ in typed_and_wanted}):
    type_in(f". '{sys.argv[1]}/{tool}'; {tool}() {{ printf '<%s>' \"$@\"; echo; }}\n")
type_in("echo rea''dy\n")
read_until("ready")
failed = False
for typed, wanted in typed_and_wanted:
    type_in(typed + "\necho do''ne\n")
    said = read_until("done")
    found = re.findall(r"^(<.*>)\r?$", said, re.MULTILINE)
    if found != [wanted]:
        print(f"{typed!r} becomes {found}, expected {wanted}; bash said {said!r}")
        failed = True
type_in("exit\n")
sys.exit(failed)
END

# offers COMPLETION WORDS...: what fish offers behind the words typed.
offers() { HOME=$work fish --no-config -c "source '$everything/fish/$1.fish'; complete -C '$2'" | cut -f 1 | sort | tr '\n' ' '; }
if command -v fish >/dev/null; then
  for pair in 'sw-shoot --top m|mirror ' 'sw-shoot --record vx,s|vx,sxx vx,sxz vx,szz ' 'sw-shoot -o sho|shots.sgy '; do
    found=$(offers sw-shoot "${pair%|*}")
    [ "$found" = "${pair#*|}" ] || broken "fish offers behind '${pair%|*}': $found"
  done
fi
if command -v zsh >/dev/null; then
  python3 - "$everything/zsh" <<'END' || status=1
import os, pty, re, select, sys, time

child, terminal = pty.fork()
if child == 0:
    os.environ.update(PS1="", TERM="dumb")
    os.execvp("zsh", ["zsh", "-f", "-i"])


def said_until(mark):
    said, end = "", time.monotonic() + 20
    while not re.search(mark, said) and time.monotonic() < end:
        if select.select([terminal], [], [], 0.5)[0]:
            said += os.read(terminal, 65536).decode()
    return said


def answer(text):
    os.write(terminal, (text + "\necho do''ne\n").encode())
    return re.findall(r"^(<.*>)\r?$", said_until("\ndone\r"), re.MULTILINE)


answer(f"PS1=; fpath=({sys.argv[1]} $fpath); autoload -Uz compinit; compinit -u -D")
answer("sw-shoot() { printf '<%s>' \"$@\"; echo; }; stty -echo")
failed = False
for typed, wanted in [
    ("sw-shoot --prec\tfl\t", "<--precision=float>"),
    ("sw-shoot --top mi\t", "<--top><mirror>"),
    ("sw-shoot --record=vx,sz\t", "<--record=vx,szz>"),
]:
    found = answer(typed)
    if found != [wanted]:
        print(f"zsh: {typed!r} becomes {found}, expected {wanted}")
        failed = True
os.write(terminal, b"exit\n")
sys.exit(failed)
END
fi
exit "$status"
