// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "gather/fk_spectrum.hpp"

namespace slipwave {

/// Phase velocities at which spectra are wanted, m/s: from one to another, both of one sign.
struct VelocityRange {
  double first = 0, last = 0;
  std::size_t count = 0;
  std::vector<double> values() const;
};

/// "V1:V2" or "V1:V2:DV", m/s; negative ones of waves that travel towards falling positions. Throws a usage
/// Error unless |V1| < |V2| and both have one sign.
VelocityRange parse_velocity_range(std::string_view text);

/// The range that holds 98 % of the energy of a gather, by its f-k spectrum: of the way on which more of it
/// travels, between the velocities below and above which lies 1 %.
VelocityRange velocities_of_energy(const FkTransform& transform, std::span<const double> energy);

/// The spectra of FkTransform over phase velocity c and frequency (a dispersion image): F(k, f) at k = f/c
/// exactly, by its sum over receivers. At f = 0 no velocity is told from others: those values are 0.
class PhaseVelocityTransform {
 public:
  /// Throws as FkTransform.
  PhaseVelocityTransform(const SampleAxis& axis, std::size_t receivers, double spacing_m,
                         const SpectrumSettings& settings, std::vector<double> velocities);

  const std::vector<double>& velocities() const noexcept { return velocities_; }
  /// Adds the spectrum of `traces`, one a receiver in order of position, to `sum`: a row of frequencies for
  /// each velocity.
  void add(std::span<const std::vector<double>> traces, std::span<double> sum);

 private:
  double interval_s_, spacing_m_;
  bool power_;
  std::vector<double> velocities_;
  std::vector<double> along_, across_;  // weights in time and over receivers
  RealTransform transform_;
};

}  // namespace slipwave
