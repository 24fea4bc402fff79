// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/fft.hpp"
#include "gather/receiver_line.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// A fan of apparent velocities along a line of receivers, m/s: full from v[1] to v[2], falling linearly with
/// the velocity to none at v[0] and v[3]; none below the first or above the last. Each is not below the one
/// before it; the last ones may be infinite.
struct VelocityFan {
  std::array<double, 4> v{};
  int way = 0;  // of the waves: 1 towards growing positions, -1 towards falling ones, 0 both
};

/// "V1,V2" or "V1,V2,V3,V4" in m/s, inf for infinite; all with a sign, "+V1,+V2" or "-V1,-V2": waves that
/// travel that way only. Throws a usage Error.
VelocityFan parse_velocity_fan(std::string_view text);

/// What is kept over wavenumber and frequency.
struct FkFilterSettings {
  std::optional<VelocityFan> fan;
  std::optional<std::array<double, 4>> wavenumbers_per_m;  // of |k|, with linear slopes (as Ormsby)
  bool reject = false;                                     // keep the others

  bool any() const { return fan || wavenumbers_per_m; }
  /// Returns the weight of the waves of one wavenumber (1/m, above 0 towards growing positions) and
  /// frequency, 0 to 1.
  double weight(double wavenumber_per_m, double frequency_hz) const;
};

/// Four numbers from 0 on, none below the one before it, 1/m; else a usage Error.
std::array<double, 4> parse_wavenumber_band(std::string_view text);

/// Multiplies spectra over wavenumber and frequency of gathers along a line (FkTransform's F) by weights:
/// zero phase. Traces and line are filled with as many zeros, so that nothing comes round the ends.
class FkFilter {
 public:
  FkFilter(const SampleAxis& axis, std::size_t receivers, double spacing_m, const FkFilterSettings& settings);
  std::size_t receivers() const noexcept { return receivers_; }
  double spacing_m() const noexcept { return spacing_m_; }
  /// Traces in order of position.
  void apply(std::span<std::vector<double>* const> traces);

 private:
  std::size_t receivers_;
  double spacing_m_;
  RealTransform2 transform_;
  std::vector<double> weights_;  // [row][bin], of a wavenumber's bin the mean over its width
};

}  // namespace slipwave
