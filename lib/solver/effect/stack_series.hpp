// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "acquisition/survey.hpp"
#include "base/fft.hpp"
#include "solver/effect/time_series.hpp"

namespace slipwave::solver {

/// A wave in a layer of a stack, whose amplitude is 1 at depth reference_m; its slowness downwards.
struct StackWave {
  std::size_t layer = 0;
  double reference_m = 0;
  std::complex<double> slowness;
};

/// The times of a series, in s: when the incident wave comes to where its amplitude is counted, and the first
/// and last time that are required.
struct SeriesWindow {
  double arrival_s = 0, first_s = 0, last_s = 0;
};

/// What a plane wave makes of layers as functions of t - slowness (x - x_s), on bins of frequency: all waves
/// in them, times the wavelet.
class StackSeries {
 public:
  using Complex = std::complex<double>;
  /// `solve` gives the amplitudes of all waves for an angular frequency.
  StackSeries(std::vector<StackWave> waves, const std::function<std::vector<Complex>(Complex omega)>& solve,
              const Wavelet& wavelet, double amplitude, const SeriesWindow& window);
  /// Calls `see(bin, amplitude)` of a wave at a depth.
  template <class See>
  void each_bin(std::size_t wave, double z, const See& see) const;
  /// Spectra at a depth, which lies in that layer: each the sum of the waves there times their factors, as
  /// many as spectra.
  template <std::size_t N>
  std::array<std::vector<Complex>, N> sums_at(
      double z, std::size_t layer,
      const std::function<std::array<Complex, N>(std::size_t wave)>& factors) const;
  TimeSeries series_of(const std::vector<Complex>& spectrum);

 private:
  std::vector<float> samples_of(const std::vector<Complex>& spectrum, double& first_s);

  std::vector<StackWave> waves_;
  double interval_s_, first_s_, last_s_, decay_ = 0;
  std::size_t length_, bins_;
  std::vector<Complex> source_;                   // [bin]
  std::vector<std::vector<Complex>> amplitudes_;  // [bin][wave]
  RealTransform transform_;
  double largest_;
};

/// From bin to bin the phase grows by the same factor.
template <class See>
void StackSeries::each_bin(std::size_t wave, double z, const See& see) const {
  const double step = 2 * std::numbers::pi / (double(length_) * interval_s_);
  const auto& of = waves_[wave];
  const auto way = Complex(0, -1) * of.slowness * (z - of.reference_m);
  const auto factor = std::exp(way * step);
  auto phase = std::exp(way * Complex(0, -decay_));
  for (std::size_t bin = 0; bin < bins_; ++bin, phase *= factor)
    see(bin, phase * amplitudes_[bin][wave] * source_[bin]);
}

template <std::size_t N>
std::array<std::vector<StackSeries::Complex>, N> StackSeries::sums_at(
    double z, std::size_t layer,
    const std::function<std::array<Complex, N>(std::size_t wave)>& factors) const {
  std::array<std::vector<Complex>, N> spectra;
  for (auto& spectrum : spectra) spectrum.assign(bins_, 0);
  for (std::size_t n = 0; n < waves_.size(); ++n) {
    if (waves_[n].layer != layer) continue;
    const auto of = factors(n);
    each_bin(n, z, [&](std::size_t bin, const Complex& here) {
      for (std::size_t k = 0; k < N; ++k) spectra[k][bin] += here * of[k];
    });
  }
  return spectra;
}

}  // namespace slipwave::solver
