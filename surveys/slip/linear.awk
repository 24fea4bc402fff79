# SPDX-License-Identifier: BSD-3-Clause
# linear.awk -v angle=DEG -v ratio=R -v strip=K SPECTRA: p of the wave that comes in and of what the slipping row adds, at
# the receivers 1 (above) and 2 (below), against the closed form of an interface. Files in this order:
# intact-1 slip-1 intact-2 slip-2, columns of sw-spectrum --text.
FNR == 1 { file++; lines = 0 }
/^#/ || NF < 2 { next }
{ amplitude[file, ++lines] = $2; frequency[lines] = $1 }
END {
  vp = 4500; vs = 2250
  pi = atan2(0, -1)
  sin_p = sin(angle * pi / 180); cos_p = sqrt(1 - sin_p^2)
  sin_s = sin_p * vs / vp; cos_s = sqrt(1 - sin_s^2)
  # Impedance that the interface feels, over rho vs, and what comes of P waves at it, by docs/slip.md.
  z = (1 - 2 * sin_s^2)^2 / cos_s + 4 * vs / vp * sin_s^2 * cos_p
  of = function_of(ratio, z); of_cell = function_of(1 / (1 / ratio + strip), z)
  printf "angle %g: closed form %.4f, with the row of cells counted in %.4f\n", angle, of, of_cell
  printf "%10s %10s %10s\n", "Hz", "back", "through"
  for (n = 1; n <= lines; n++) {
    f = int(frequency[n] / 10 + 0.5) * 10
    if (f < 10 || f > 60 || (frequency[n] - f)^2 > 0.01) continue
    printf "%10g %10.4f %10.4f\n", f, amplitude[2, n] / amplitude[1, n], amplitude[4, n] / amplitude[3, n]
  }
}
# |P wave that goes off| over the one that comes in.
function function_of(r, z) { return 4 * (vs / vp)^3 * sin_p^2 * cos_p * r / (1 + z * r) }
