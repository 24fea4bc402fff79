// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

namespace slipwave {

/// The effect of one step on a plane wave of `cells` cells per wavelength along an axis in a uniform medium:
/// the factor on its complex amplitude (theory.md (E12)); exp(-2 pi i courant/cells) would be exact.
std::complex<double> amplification(int order, double courant, double cells);

/// The scheme in a uniform medium: Courant numbers vp dt/h and vs dt/h, the latter 0 in fluids.
struct UniformScheme {
  int order = 5;
  double courant_p = 0;
  double courant_s = 0;
  int time_order = 2;  // of the splitting
};

enum class WaveKind { p, s };

/// The error of a whole step in 2-D for a plane P or S wave of `cells` cells per wavelength that travels at
/// `angle` (radians from the z axis): the logarithm of the factor on its amplitude over the exact factor.
/// Real part: below zero for loss; imaginary part: phase in radians, above zero when the wave is late. After
/// n steps the wave is exp(n step_error) times what it should be (theory.md (E15)).
std::complex<double> step_error(const UniformScheme& scheme, WaveKind kind, double cells, double angle);

/// Share of its amplitude that a P wave along an axis loses over one wavelength.
double loss_per_wavelength(const UniformScheme& scheme, double cells);

}  // namespace slipwave
