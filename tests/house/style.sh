#!/bin/sh
# style.sh ROOT: what the house keeps out of its sources, and how long a file may be.
set -eu
cd "$1"
status=0

# No file above 300 lines.
long=$(find lib tools tests -type f | sort | xargs awk '
  FNR == 1 { name = FILENAME }
  FNR == 301 { print name ": longer than 300 lines, split it by topic" }')
[ -z "$long" ] || { printf '%s\n' "$long"; status=1; }

# forbid PATTERN REASON FILE... : no line of the files holds the pattern.
forbid() {
  pattern=$1
  reason=$2
  shift 2
  [ $# -gt 0 ] || return 0
  # /dev/null makes grep name the file even where there is one only.
  if found=$(grep -nE -- "$pattern" "$@" /dev/null); then
    printf '%s\n' "$found" | sed "s|\$|   <- $reason|"
    status=1
  fi
}

sources() { find "$@" -name '*.?pp' | sort; }
# File names hold no blanks (top_level.sh).
# shellcheck disable=SC2046
{
  below_main=$(sources lib | grep -v '^lib/cli/' || :)
  # shellcheck disable=SC2086
  forbid 'std::(cout|cerr|clog)|(^|[^[:alnum:]_])(f?printf|puts|fputs|perror) *\(' 'nothing below main prints' $below_main
  # shellcheck disable=SC2086
  forbid '(^|[^[:alnum:]_])(std::)?(exit|abort|quick_exit|terminate) *\(' 'nothing below main exits' $below_main
  forbid '^ *# *define ' 'no macros' $(sources lib tools)
  forbid 'shared_ptr' 'no shared ownership' $(sources lib tools)
  forbid '(^|[^[:alnum:]_.>])(std::|::)?(system|popen|wordexp|posix_spawnp?|exec(l|le|lp|v|ve|vp|vpe))\(' \
    'no shell and no other program is started' $(sources lib tools)
  forbid 'using namespace std' 'names of std keep their std::' $(sources lib tools tests)
}
exit "$status"
