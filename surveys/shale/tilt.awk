# SPDX-License-Identifier: BSD-3-Clause
# The dip of the beds of a model, from its vs: columns from left to right, a line each, 60 numbers of its trace header first.
# Prints it cell by cell as raw little-endian float32, depth fastest, in whole degrees, deepening towards +x; 0 in fluid.
# -v step=H -v reach=M
#
# Gradients point across beds. The mean of their products over a square of `reach` to all sides has an angle: that of the direction
# in which vs changes most (the structure tensor; Bigun and Granlund 1987). Gradients across faults, which are steeper than beds,
# are left out.
function first(i) { return i > 1 ? i - 1 : 1 }
function last(i, most) { return i < most ? i + 1 : most }
function smooth(    i, k) { # by 1/4, 1/2, 1/4 along both axes: differences of stairs are too steep
  for (i = 1; i <= columns; i++)
    for (k = 1; k <= rows; k++) mean[i, k] = (vs[i, first(k)] + 2 * vs[i, k] + vs[i, last(k, rows)]) / 4
  for (i = 1; i <= columns; i++)
    for (k = 1; k <= rows; k++) vs[i, k] = (mean[first(i), k] + 2 * mean[i, k] + mean[last(i, columns), k]) / 4
}
function over_square(sum, i, k,    left, right, top, bottom) { # by sums from the corner of the model
  left = i > cells + 1 ? i - cells - 1 : 0
  top = k > cells + 1 ? k - cells - 1 : 0
  right = i + cells < columns ? i + cells : columns
  bottom = k + cells < rows ? k + cells : rows
  return sum[right, bottom] - sum[left, bottom] - sum[right, top] + sum[left, top]
}
function put(value,    sign, exponent, mantissa) { # a whole number
  if (value == 0) {
    printf "%c%c%c%c", 0, 0, 0, 0
    return
  }
  sign = value < 0
  if (sign) value = -value
  for (exponent = 127; value >= 2; exponent++) value /= 2
  mantissa = (value - 1) * 8388608
  printf "%c%c%c%c", mantissa % 256, int(mantissa / 256) % 256, int(mantissa / 65536) + exponent % 2 * 128, sign * 128 + int(exponent / 2)
}
{
  rows = NF - 60
  # Fluid counts as the rock below it: its floor is no bed.
  for (k = rows; k >= 1; k--) {
    fluid[NR, k] = $(60 + k) == 0
    vs[NR, k] = fluid[NR, k] && k < rows ? vs[NR, k + 1] : $(60 + k)
  }
}
END {
  columns = NR
  cells = int(reach / step + 0.5)
  degree = atan2(0, -1) / 180
  smooth()
  smooth()
  for (i = 1; i <= columns; i++)
    for (k = 1; k <= rows; k++) {
      gx = vs[last(i, columns), k] - vs[first(i), k]
      gz = vs[i, last(k, rows)] - vs[i, first(k)]
      if (gx * gx > gz * gz) gx = gz = 0
      xx[i, k] = gx * gx + xx[i - 1, k] + xx[i, k - 1] - xx[i - 1, k - 1]
      xz[i, k] = gx * gz + xz[i - 1, k] + xz[i, k - 1] - xz[i - 1, k - 1]
      zz[i, k] = gz * gz + zz[i - 1, k] + zz[i, k - 1] - zz[i - 1, k - 1]
    }
  for (i = 1; i <= columns; i++)
    for (k = 1; k <= rows; k++) {
      tilt = 0
      if (!fluid[i, k]) tilt = -atan2(2 * over_square(xz, i, k), over_square(zz, i, k) - over_square(xx, i, k)) / 2 / degree
      put(tilt < 0 ? -int(0.5 - tilt) : int(tilt + 0.5))
    }
}
