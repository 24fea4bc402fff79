// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "accuracy/full_space.hpp"
#include "acquisition/wavelet.hpp"
#include "grid/tensor.hpp"
#include "model/model.hpp"

namespace slipwave {

/// What a source sends out as a function of time, and the frequencies at which spectra are wanted.
struct WaveHistory {
  double interval_s = 0;
  std::vector<double> values;
  std::vector<double> hz;
  /// exp(-2 pi i f t) interval_s, by frequency and time.
  std::vector<std::vector<std::complex<double>>> phases;
  double largest() const;
};
/// Of a wavelet, a plane wave's; of line sources its half derivative, of which waves in 2-D have the shape
/// (in 1/s^(1/2)).
WaveHistory history_of(const Wavelet& wavelet, bool of_line_source, std::vector<double> hz);

/// The rate of the moment of the planes of a cell, by frequency, per unit volume.
using MomentSpectrum = std::vector<SymmetricTensor<2, std::complex<double>>>;

/// Of a wave that brings `stress` times the history, over the prestress: springs give as far as their
/// compliance says, planes that slide do so by (S3) under what their slip leaves of that stress.
MomentSpectrum moment_rate_of(const FractureSet<2>& set, const UniformMedium& rock,
                              const SymmetricTensor<2, double>& stress,
                              const SymmetricTensor<2, double>& prestress, const WaveHistory& history);

/// Speeds of rock over those of waves along n in it with the springs of a cluster, P and S: what waves much
/// longer than the spacing feel (Schoenberg & Sayers 1995; theory.md (S26)). Dashpots give less at `hz`.
struct Slower {
  double p = 1, s = 1;
};
Slower slower_in_springs(const FractureSet<2>& set, const UniformMedium& rock, const Point<2>& n, double hz);

/// Part of a single fracture.
struct FracturePiece {
  Point<2> normal{};
  double length_m = 0;
  double whole_m = 0;  // of the fracture, from tip to tip
};

/// What a metre of a single fracture sends out, and what of that is taken off for each metre that its jump is
/// smeared over (S33a).
struct SmearedMoment {
  MomentSpectrum rate, off;
};
SmearedMoment moment_rate_of_single(const LinearCompliance& compliance, const FracturePiece& piece,
                                    const UniformMedium& rock, const SymmetricTensor<2, double>& stress,
                                    const WaveHistory& history);

}  // namespace slipwave
