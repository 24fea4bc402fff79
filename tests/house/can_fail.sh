#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# can_fail.sh ROOT: breaks each rule of the house once, in a small house of its own, and wants it noticed by name.
set -eu
rules=$1/tests/house
house=$(mktemp -d)
trap 'rm -rf "$house"' EXIT
status=0

# fresh: a small house that keeps every rule.
fresh() {
  rm -rf "$house"
  mkdir -p "$house/lib/base" "$house/lib/gather" "$house/lib/output" "$house/lib/accuracy" "$house/tools" "$house/tests/unit" \
    "$house/docs/man" "$house/surveys" "$house/build/bin"
  echo '#include <vector>' > "$house/lib/base/error.hpp"
  echo '#include <fftw3.h>' > "$house/lib/base/fft.cpp"
  echo '#include "base/error.hpp"' > "$house/lib/gather/trace.cpp"
  printf '#include "scene/scene.hpp"\n/// Returns the energy\n/// Of the whole grid, J.\n' > "$house/lib/output/snapshot.cpp"
  echo '#include "solver/kernels/reconstruction.hpp"' > "$house/lib/accuracy/dispersion.cpp"
  echo 'int main() {}' > "$house/tools/sw_x.cpp"
  mkdir -p "$house/docs/theory"
  printf '// Proves (E1).\nTEST(Wave, Travels) {}\n' > "$house/tests/unit/wave_test.cpp"
  printf '# Waves\n\n\nv = c   (E1)\n' > "$house/docs/theory/waves.md"
  sh "$rules/equations.sh" "$house" --write
  echo 'See [the theory](docs/theory/waves.md).' > "$house/README.md"
  printf '```sh\nsw-x\n```\n' > "$house/docs/tools.md"
  printf '.SH NAME\n.SH SYNOPSIS\n.SH DESCRIPTION\n.SH OPTIONS\n.TP\n.B \\-\\-size S\n.SH EXIT STATUS\n.B 0\n.B 1\n.B 2\n.B 128+N\n.SH EXAMPLES\n' \
    > "$house/docs/man/sw-x.1"
  printf '#!/bin/sh\necho "  --size S"\necho "Example:"\necho "  sw-x --size 2"\n' > "$house/build/bin/sw-x"
  chmod +x "$house/build/bin/sw-x"
}

run_rule() {
  case $1 in
    help) sh "$rules/help.sh" "$house" "$house/build/bin" sw-x 2>&1 ;;
    pages) sh "$rules/pages.sh" "$house" "$house/build" 2>&1 ;;
    readme) sh "$rules/readme.sh" "$house" "$house/build" 2>&1 ;;
    *) sh "$rules/$1.sh" "$house" 2>&1 ;;
  esac
}

fresh
for rule in layers style words top_level equations links help readme pages lines; do
  said=$(run_rule "$rule") || { echo "$rule finds fault with a house in order: $said"; status=1; }
done

# noticed RULE FILE TEXT EXPECTED: TEXT appended to FILE must make RULE fail and say EXPECTED.
noticed() {
  fresh
  mkdir -p "$(dirname "$house/$2")"
  printf '%b\n' "$3" >> "$house/$2"
  if said=$(run_rule "$1"); then
    echo "$1 let this pass: $3 in $2"
    status=1
    return 0
  fi
  case $said in
    *"$4"*) ;;
    *)
      echo "$1 on '$3' in $2 did not say '$4' but: $said"
      status=1
      ;;
  esac
}

noticed layers lib/base/error.hpp '#include "gather/trace.hpp"' 'lib/base/error.hpp:2: base must not include'
noticed layers lib/gather/trace.cpp '#include "model/model.hpp"' 'gather must not include'
noticed layers lib/output/snapshot.cpp '#include "solver/sweep/sweeps.hpp"' 'output must not include'
noticed layers lib/accuracy/dispersion.cpp '#include "solver/kernels/kernels.hpp"' 'accuracy must not include'
noticed layers lib/plot/panel.cpp '#include "solver/simulation.hpp"' 'plot must not include'
noticed layers lib/gather/trace.cpp '#include "trace.hpp"' 'write "room/file.hpp"'
noticed layers lib/gather/trace.cpp '#include <fftw3.h>' '<fftw3.h> belongs in'
noticed layers lib/gather/trace.cpp '#include <tbb/task_arena.h>' '<tbb/task_arena.h> belongs in'
noticed layers lib/gather/trace.cpp '# include <netcdf.h>' '<netcdf.h> belongs in'
noticed layers lib/gather/trace.cpp '#include <boost/any.hpp>' '<boost/any.hpp> belongs in'
noticed layers lib/gather/trace.cpp '#include <cairo/cairo.h>' '<cairo/cairo.h> belongs in'
noticed layers lib/misc/bits.hpp '' 'lib/misc has no place'
noticed style tools/sw_x.cpp "void f() {\n$(seq 59)\n}" 'tools/sw_x.cpp:2: a function of 61 lines'
noticed style lib/base/error.hpp "struct A {\n  void f(int a,\n         int b) {\n$(seq 58)\n  }\n};" 'error.hpp:3: a function of 61 lines'
noticed style lib/base/error.hpp 'std::cerr << 1;' 'nothing below main prints'
noticed style lib/base/error.hpp '  printf("x");' 'nothing below main prints'
noticed style lib/base/error.hpp 'std::exit(1);' 'nothing below main exits'
noticed style lib/base/error.hpp '#define X 1' 'no macros'
noticed style lib/base/error.hpp 'std::shared_ptr<int> p;' 'no shared ownership'
noticed style tools/sw_x.cpp '  std::system(name.c_str());' 'no other program is started'
noticed style lib/base/error.hpp '  execvp(name, words);' 'no other program is started'
noticed style tests/unit/wave_test.cpp 'using namespace std;' 'names of std'
noticed words docs/theory/waves.md "kept in $(printf '/%s/' home)somebody" 'docs/theory/waves.md:5'
noticed words docs/theory/waves.md "see $(printf '%s%s 12' is sue)" 'docs/theory/waves.md:5'
noticed words tests/unit/wave_test.cpp "// $(printf '%s%s' TO DO): later" 'wave_test.cpp:3'
noticed words docs/theory/waves.md "a $(printf '%s%s' matched ' layer') absorbs" "docs/theory/waves.md:5: 'a $(printf '%s%s' matched ' layer')': write 'PML'"
noticed words lib/base/error.hpp "/// It $(printf '%s%s' err 's by') 2 %%." "write 'has an error of'"
noticed words lib/base/error.hpp '/// Of the whole grid, J.' "lib/base/error.hpp:2: 'Of the whole grid, J.': write a sentence"
noticed top_level notes.txt x 'notes.txt: the top level holds'
noticed top_level 'docs/two words.md' x 'a plain file name'
noticed equations docs/theory/waves.md 's = rho c v  (E2)' '(E2) is proved by no test'
noticed equations docs/theory/waves.md 's = rho c v  (E1)' '(E1) stands at docs/theory/waves.md:4 already'
noticed equations tests/unit/wave_test.cpp '// Proves (E1).\nTEST(Wave, Stops) {}' 'docs/theory/tests.md is not what the tests say'
noticed equations tests/unit/wave_test.cpp '// Proves (E2).\nTEST(Wave, Stops) {}' '(E2) of Wave.Stops stands on no page'
noticed equations tests/unit/wave_test.cpp '// Proves (E1).\nint waves = 1;' 'stands above no test'
noticed equations lib/base/fft.cpp '/// The speed (theory.md (E1), (E7)).' 'lib/base/fft.cpp:2: there is no equation (E7)'
noticed equations docs/traces.md 'as in `Wave.Stands`' 'docs/traces.md: there is no test Wave.Stands'
noticed links README.md '[more](docs/more.md)' 'docs/more.md leads nowhere'
noticed links docs/tools.md '[more](theory/waves.md#water)' 'docs/theory/waves.md has no heading #water'
noticed help build/bin/sw-x 'echo "  --step H"; echo "  sw-x"' 'does not document: --step H'
noticed help build/bin/sw-x 'printf "%090d\\n" 0' 'wider than 80 columns'
noticed help build/bin/sw-x 'echo done' 'does not end with its example'
noticed help build/bin/sw-x 'seq 70; echo "sw-x --size 3"' 'longer than a screen'
noticed help build/bin/sw-x 'exit 3' 'exit status 3'
noticed help docs/man/sw-x.1 '.TP\n.B \\-\\-colour' 'sw-x --help-all does not list: --colour'
noticed help docs/man/sw-y.1 '.SH NAME' 'sw-y.1: there is no such tool'
noticed help tools/sw_y.cpp 'int main() {}' 'sw-y is not built'
noticed readme README.md '```sh\nsw-x --size 2\nsw-z\n```' 'README.md.01: a command failed'
noticed lines docs/tools.md "$(printf '%0201d' 0)" 'docs/tools.md:4: a line of 201 characters'
noticed lines docs/tools.md "| a | $(printf '%0201d' 0) |" 'a cell of 201 characters'
noticed pages README.md '<!--=speed-->1<!--/-->' 'README.md: nothing makes the figure speed'
noticed pages README.md '<!-- figures\nspeed: echo 2\n-->' 'the figure speed is made and stands nowhere'
noticed pages README.md '<!-- figures\nspeed: echo 2\n-->\n<!--=speed-->2' 'README.md: a figure has no end'
noticed pages README.md '```sh\nsw-x >said-here\n```\n<!-- figures\nspeed: wc -l <said-here | number 1\n-->\nspeed <!--=speed-->5<!--/-->' \
  'README.md: speed is 3 by the run, the page says 5'
noticed pages README.md '<!-- figures\nspeed: false\n-->\n<!--=speed-->2<!--/-->' 'nothing comes of the figure speed'

# Every source lacks the line of its licence until it is written, which is done once.
fresh
said=$(run_rule licence) && { echo 'licence finds no fault with sources that name none'; status=1; }
case $said in *"lib/base/fft.cpp: line 1 should be '// SPDX"*) ;; *) echo "licence says $said"; status=1 ;; esac
sh "$rules/licence.sh" "$house" --write
said=$(run_rule licence) || { echo "licence does not write its lines: $said"; status=1; }
cp "$house/build/bin/sw-x" "$house/tests/run"
sh "$rules/licence.sh" "$house" --write
[ "$(sed -n 2p "$house/tests/run")" = "# $(sed -n 's|^// \(SPDX.*\)|\1|p' "$house/lib/base/fft.cpp")" ] ||
  { echo 'licence does not write behind a #!'; status=1; }

exit "$status"
