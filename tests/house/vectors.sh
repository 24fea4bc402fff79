#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# vectors.sh BUILD: whether every inner loop of lib/solver/kernels/kernels_level.cpp, slip_level.cpp and relaxation_level.cpp was compiled into vectors
# of the full width of its instruction set. Compilers fall back to single numbers without a word, and to a tenth of the speed.
#
# Reads the disassembly. A loop is what a jump leads back to from below. Each kernel must have one in which all of the
# kernel's arithmetic, counted by hand below, is done with vectors of that width; what is left over at the end of a row
# may be done otherwise.
set -eu
build=$1
# objects LEVEL OF: the object files of kernels of an instruction set ("*": all).
objects() { find "$build/lib/solver" -path "*kernels_$1.dir*" -name "$2_level.cpp.o"; }
# Of what machine the objects are, which need not be this one: that word of the ELF header.
object=$(objects '*' kernels | head -n 1)
if [ -z "$object" ]; then
  echo "no object of kernels_level.cpp in $build"
  exit 1
fi
objdump=objdump
case $(od -An -tu1 -j18 -N1 "$object") in
  *62) levels='generic=128 x86_64_v3=256 x86_64_v4=512' ;;
  *183)
    levels='generic=128'
    if [ "$(uname -m)" != aarch64 ]; then objdump=aarch64-linux-gnu-objdump; fi
    ;;
  *)
    echo "skipped: knows the instructions of x86-64 and 64-bit ARM only"
    exit 77
    ;;
esac
if ! command -v "$objdump" >/dev/null 2>&1; then
  echo "skipped: no $objdump"
  exit 77
fi
status=0

# loops OBJECT: a line "KERNEL<tab>WIDTH<tab>OPERATIONS" for each innermost loop: bits of its widest vectors and the
# additions and multiplications done with those. Every kernel has a line with zeros, too.
loops() {
  "$objdump" -d -C --no-show-raw-insn "$1" | awk '
    function close_function(  n, from, i, width, done) {
      gsub(/slipwave::|solver::|\(anonymous namespace\)::/, "", name)
      sub(/^[^<]*</, "", name)
      sub(/^void /, "", name)
      sub(/>\(.*$/, ">", name)
      if (name ~ />$/) printf "%s\t0\t0\n", name
      for (n = 0; n < count; ++n) {
        if (!(n in target) || !(target[n] in place)) continue
        from = place[target[n]]
        if (from > n) continue
        # An inner loop holds no other one.
        for (i = from; i < n; ++i)
          if ((i in target) && (target[i] in place) && place[target[i]] >= from && place[target[i]] <= i) break
        if (i < n) continue
        split("", done)
        width = 0
        for (i = from; i <= n; ++i) {
          done[bits[i]] += flops[i]
          if (bits[i] > width) width = bits[i]
        }
        if (width > 0) printf "%s\t%d\t%d\n", name, width, done[width]
      }
    }
    /^[0-9a-f]+ <.*>:$/ {
      close_function()
      name = $0
      count = 0
      split("", place); split("", target); split("", bits); split("", flops)
      next
    }
    /^ +[0-9a-f]+:\t/ {
      at = $1
      sub(/:$/, "", at)
      place[at] = count
      bits[count] = flops[count] = 0
      if ($2 ~ /^v?(add|sub|mul|div)p[sd]$/) flops[count] = 1
      if ($2 ~ /^vfn?m(add|sub)[0-9]*p[sd]$/) flops[count] = 2
      # A sign is turned, or a number doubled, in other ways too: only these count.
      if (flops[count]) bits[count] = /%zmm/ ? 512 : /%ymm/ ? 256 : 128
      # ARM: vectors of four or two numbers; jumps name what they look at before the place.
      if ($3 ~ /^v[0-9]+[.](4s|2d),$/) {
        if ($2 ~ /^f(add|sub|mul|div)$/) flops[count] = 1
        if ($2 ~ /^fml[as]$/) flops[count] = 2
        if (flops[count]) bits[count] = 128
      }
      if ($2 ~ /^(j|b$|b[.])/) target[count] = $3
      if ($2 ~ /^cbn?z$/) target[count] = $4
      if ($2 ~ /^tbn?z$/) target[count] = $5
      ++count
    }
    END { close_function() }'
}

# want OBJECT LEVEL WIDTH: every kernel of the object does its arithmetic with vectors of WIDTH bits.
want() {
  loops "$1" | awk -F '\t' -v level="$2" -v width="$3" '
    $2 == width && $3 > most[$1] { most[$1] = $3 }
    $2 != width && $3 > other[$1] { other[$1] = $3; its[$1] = $2 }
    function need(kernel, least) {
      ++kernels
      if (most[kernel] >= least) return
      printf "%s: %s: %d operations on vectors of %d bits in a loop, expected %d\n", level, kernel, most[kernel], width, least
      if (other[kernel] > 0) printf "%s: %s: %d operations on vectors of %d bits\n", level, kernel, other[kernel], its[kernel]
      bad = 1
    }
    END {
      split("float double", reals, " ")
      for (r = 1; r <= 2; ++r) {
        real = reals[r]
        for (reach = 0; reach <= 5; ++reach) {
          # Of the two fields of a pair: the own value, then of each neighbour sum, difference and their parts. Of the
          # weights: the Courant number 2, then as reconstruction.hpp makes them.
          sums = reach == 0 ? 3 : 2 * 6 * reach + 6
          weights = reach == 0 ? 0 : 2 + (reach == 1 ? 7 : reach == 2 ? 18 : reach == 3 ? 32 : reach == 4 ? 48 : 70)
          need("reconstruct<" (2 * reach + 1) ", true, " real ">", sums)
          need("reconstruct<" (2 * reach + 1) ", false, " real ">", sums + weights)
          # Two pairs, meet and update, of which the first product is one.
          need("fused_row<" (2 * reach + 1) ", 1, false, " real ">", 2 * (sums + weights) + 20 + 21)
          # In 3-D a third pair, with the weights and the share of the second.
          need("fused_row<" (2 * reach + 1) ", 2, false, " real ">", 3 * sums + 2 * weights + 20 + 21 + 13)
          # Of anisotropic media: the same, with what couples stresses in place of a difference.
          need("fused_row<" (2 * reach + 1) ", 1, true, " real ">", 2 * (sums + weights) + 20 + 20)
          need("fused_row<" (2 * reach + 1) ", 2, true, " real ">", 3 * (sums + weights) + 20 + 20 + 13)
          # Of fluid alone one pair, and one stress.
          need("fused_row<" (2 * reach + 1) ", 0, false, " real ">", sums + weights + 9 + 9)
        }
        # By S pairs.
        need("solve_riemann<true, 0, false, " real ">", 6); need("solve_riemann<false, 0, false, " real ">", 9)
        need("solve_riemann<true, 1, false, " real ">", 12); need("solve_riemann<false, 1, false, " real ">", 20)
        need("solve_riemann<true, 2, false, " real ">", 18); need("solve_riemann<false, 2, false, " real ">", 26)
        # Of anisotropic media in 3-D each S pair has impedances and a share of its own.
        need("solve_riemann<true, 2, true, " real ">", 18); need("solve_riemann<false, 2, true, " real ">", 29)
        # Of fluid alone; by dimension.
        need("update<true, 2, false, false, " real ">", 6); need("update<false, 2, false, false, " real ">", 10)
        need("update<true, 2, true, false, " real ">", 14); need("update<false, 2, true, false, " real ">", 22)
        need("update<true, 2, true, true, " real ">", 14); need("update<false, 2, true, true, " real ">", 21)
        need("update<true, 3, true, false, " real ">", 21); need("update<false, 3, true, false, " real ">", 29)
        need("update<true, 3, true, true, " real ">", 21); need("update<false, 3, true, true, " real ">", 29)
        # Of bent rows, by dimension: both pairs or all components, of order 5.
        for (d = 2; d <= 3; ++d) {
          need("reconstruct_curvilinear_along<5, " d ", " real ">", 40 * d)
          need("solve_curvilinear_along<" d ", " real ">", 10 * d)
          need("update_curvilinear_along<" d ", " real ">", 8 * d)
          need("reconstruct_curvilinear_across<5, " d ", " real ">", 75 * d)
          need("update_curvilinear_across<" d ", " real ">", 12 * d)
          for (fluid = 0; fluid <= 1; ++fluid) {
            of = (fluid ? "true" : "false") ", " d ", " real ">"
            need("solve_curvilinear_across<" of, 14 * d)
            need("advance_curvilinear_across<" of, 26 * d)
          }
        }
        for (way = 0; way <= 1; ++way) {
          along = way ? "true" : "false"
          of = "<" along ", " real ">"
          need("damp<" along ", false, " real ">", 10); need("damp<" along ", true, " real ">", 14)
          need("prepare" of, 2)
        }
      }
      if (!bad) printf "%s: %d kernels on vectors of %d bits\n", level, kernels, width
      exit bad
    }' || status=1
}

# want_slip OBJECT LEVEL WIDTH: the same of the kernels of slip, by what the projections of stress and its change take.
want_slip() {
  loops "$1" | awk -F '\t' -v level="$2" -v width="$3" '
    $1 !~ /^(slip_one|slip_two|open)</ { next }
    { seen[$1] = 1 }
    $2 == width && $3 > most[$1] { most[$1] = $3 }
    END {
      for (kernel in seen) {
        ++kernels
        least = kernel ~ /^slip_one<3/ ? 60 : kernel ~ /^open<3/ ? 25 : kernel ~ /^open/ ? 14 : 20
        if (most[kernel] >= least) continue
        printf "%s: %s: %d operations on vectors of %d bits in a loop, expected %d\n", level, kernel, most[kernel], width, least
        bad = 1
      }
      # Two friction laws, four corrections by halves, with and without static stress and opening, in 2-D, 3-D and for
      # blocks; opening.
      if (kernels != 2 * (2 * 7 * 2 * 3 + 2)) {
        printf "%s: %d kernels of slip, expected 172\n", level, kernels
        bad = 1
      }
      if (!bad) printf "%s: %d kernels of slip on vectors of %d bits\n", level, kernels, width
      exit bad
    }' || status=1
}

# want_linear_slip OBJECT LEVEL WIDTH: the same of the kernels of planes that give way like springs, by what the projections
# of stress, their springs and the change of stress take.
want_linear_slip() {
  loops "$1" | awk -F '\t' -v level="$2" -v width="$3" '
    $1 !~ /^(family|crossing)_/ { next }
    { seen[$1] = 1 }
    $2 == width && $3 > most[$1] { most[$1] = $3 }
    END {
      for (kernel in seen) {
        ++kernels
        split(kernel, of, /[<,] ?/)
        # family_acts<ends, dimensions, damped, slides, number>, crossing_acts<ends, dimensions, slides, number>
        cube = of[3] == 3
        if (kernel ~ /^crossing/) least = of[2] == "true" ? (cube ? 90 : 27) : of[4] == "true" ? 20 : cube ? 12 : 6
        else if (of[2] == "false" && of[4] == "false") least = (cube ? 40 : 18) + (of[5] == "true" ? (cube ? 20 : 8) : 0)
        else least = cube ? 80 : 36
        if (most[kernel] >= least) continue
        printf "%s: %s: %d operations on vectors of %d bits in a loop, expected %d\n", level, kernel, most[kernel], width, least
        bad = 1
      }
      # Both halves: of one family in 2-D and 3-D with and without dashpots and friction; of several, whose beginning in 2-D
      # knows friction.
      if (kernels != 2 * (2 * 2 * 4 + 2 + 3)) {
        printf "%s: %d kernels of linear slip, expected 42\n", level, kernels
        bad = 1
      }
      if (!bad) printf "%s: %d kernels of linear slip on vectors of %d bits\n", level, kernels, width
      exit bad
    }' || status=1
}

# want_relaxation OBJECT LEVEL WIDTH: the same of the kernels of attenuation: five operations for each mechanism and part of
# the stress, of which two may be fused, and those that take the stress apart.
want_relaxation() {
  loops "$1" | awk -F '\t' -v level="$2" -v width="$3" '
    $1 !~ /^relax</ { next }
    { seen[$1] = 1 }
    $2 == width && $3 > most[$1] { most[$1] = $3 }
    END {
      for (kernel in seen) {
        ++kernels
        split(kernel, of, /[<,] ?/)
        parts = of[3] !~ /2$/ ? 1 : of[2] == 2 ? 3 : 6
        least = 5 * of[4] * parts
        if (most[kernel] >= least) continue
        printf "%s: %s: %d operations on vectors of %d bits in a loop, expected %d\n", level, kernel, most[kernel], width, least
        bad = 1
      }
      # Two dimensions; pressure, mean or all stresses (Relaxing); two to five mechanisms.
      if (kernels != 2 * 3 * 2 * 4) {
        printf "%s: %d kernels of attenuation, expected 48\n", level, kernels
        bad = 1
      }
      if (!bad) printf "%s: %d kernels of attenuation on vectors of %d bits\n", level, kernels, width
      exit bad
    }' || status=1
}

for level in $levels; do
  # A build may have kernels of the processor that compiles alone.
  if [ -z "$(objects "${level%=*}" '*')" ] && ! grep -q '^SLIPWAVE_KERNELS:STRING=all' "$build/CMakeCache.txt"; then continue; fi
  for of in kernels slip relaxation; do
    object=$(objects "${level%=*}" "$of")
    if [ -z "$object" ]; then
      echo "${level%=*}: no object of ${of}_level.cpp in $build"
      status=1
    elif [ "$of" = kernels ]; then
      want "$object" "${level%=*}" "${level#*=}"
    elif [ "$of" = relaxation ]; then
      want_relaxation "$object" "${level%=*}" "${level#*=}"
    else
      want_slip "$object" "${level%=*}" "${level#*=}"
      want_linear_slip "$object" "${level%=*}" "${level#*=}"
    fi
  done
done
exit "$status"
