#pragma once

#include <complex>

namespace slipwave::solver {

/// What one step does to a plane wave of `cells` cells a wavelength along an axis in a uniform medium: the
/// factor on its complex amplitude (theory.md (E12)); exp(-2 pi i courant/cells) would be exact.
std::complex<double> amplification(int order, double courant, double cells);

/// Share of the amplitude such a wave loses over one wavelength.
double loss_per_wavelength(int order, double courant, double cells);

}  // namespace slipwave::solver
