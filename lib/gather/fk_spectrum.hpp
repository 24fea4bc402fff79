// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/fft.hpp"
#include "gather/spectrum.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// Spectra of gathers over wavenumber and frequency. With traces x_mn of M receivers every dx along a line
/// and N samples every dt, weights v_m and w_n (the window along both axes),
///   F(k, f) = dt dx sum_m sum_n v_m w_n x_mn exp(-2 pi i (f n dt - k m dx))
/// at f = 0 .. 1/(2 dt) and k = -1/(2 dx) .. 1/(2 dx) (the upper end left out where the lower one is there),
/// k in 1/m: what travels towards growing positions is at k > 0.
///   amplitude  |F|; unit u s m
///   power      c |F|^2, c = 2 (1 at f = 0 and at the Nyquist frequency): energy density, unit u^2 s^2 m^2
/// Parseval: sum of the power over all k and f, times dk df, is sum (v w x)^2 dt dx exactly.
class FkTransform {
 public:
  /// Throws Error when there is no sample, interval, receiver or spacing, pad is below 1, or memory lacks.
  FkTransform(const SampleAxis& axis, std::size_t receivers, double spacing_m,
              const SpectrumSettings& settings);

  std::vector<double> frequencies_hz() const;
  /// Ascending.
  std::vector<double> wavenumbers_per_m() const;
  std::size_t receivers() const noexcept { return across_.size(); }
  double spacing_m() const noexcept { return spacing_m_; }
  /// Zeros appended to the traces and to the receivers.
  std::size_t zeros_in_time() const noexcept { return transform_.length() - along_.size(); }
  std::size_t zeros_in_3d() const noexcept { return transform_.rows() - across_.size(); }

  double bytes() const { return RealTransform2::bytes_for(transform_.rows(), transform_.length()); }

  /// Adds the spectrum of `traces`, one a receiver in order of position, to `sum`: a row of frequencies for
  /// each wavenumber.
  void add(std::span<const std::vector<double>> traces, std::span<double> sum);

 private:
  double interval_s_, spacing_m_;
  bool power_;
  std::vector<double> along_, across_;  // weights in time and over receivers
  RealTransform2 transform_;
};

class PhaseVelocityTransform;

/// Spectra over phase velocity instead of wavenumber.
struct PhaseVelocityChoice {
  std::vector<double> velocities;  // m/s, ascending; empty: where the energy of the first gather is
};

/// The mean f-k spectra of the gathers of a file, one gather a shot and component, in the memory of one shot
/// and of the spectra.
class FkSpectra {
 public:
  FkSpectra(const SampleAxis& axis, const SpectrumSettings& settings,
            const std::optional<PhaseVelocityChoice>& over_velocity = {});
  ~FkSpectra();

  /// The traces of a shot together, in any order within. Throws Error: a shot that comes again, a trace of
  /// another length, receivers that are not evenly spaced (to a thousandth), a gather of other receivers.
  void add(const TraceHeader& header, std::span<const double> samples);
  /// After the last trace. Throws Error when there was none.
  void finish();

  struct Mean {
    std::vector<double> values;  // a row of frequencies for each wavenumber or velocity
    std::int64_t gathers = 0;
  };
  const std::map<Component, Mean>& means() const { return means_; }
  const FkTransform& transform() const { return *transform_; }
  /// Empty where the spectra are over wavenumber.
  std::vector<double> velocities() const;
  /// What the largest shot, the transform and the spectra take.
  double bytes() const;
  /// 'x', 'y' or 'z': the receivers' positions along this axis.
  char direction() const { return "xyz"[direction_]; }

 private:
  struct Placed {
    std::array<double, 3> receiver_m;
    std::vector<double> samples;
  };
  void finish_shot();
  void finish_gather(Component component, std::vector<Placed>& placed);
  void begin_image(const std::vector<std::vector<double>>& traces);

  SampleAxis axis_;
  SpectrumSettings settings_;
  std::optional<PhaseVelocityChoice> over_velocity_;
  std::optional<FkTransform> transform_;
  std::unique_ptr<PhaseVelocityTransform> image_;
  std::size_t direction_ = 0;
  std::int64_t shot_ = 0;
  std::set<std::int64_t> shots_;
  std::map<Component, std::vector<Placed>> gathers_;  // of the current shot
  std::map<Component, Mean> means_;
  std::size_t held_ = 0, most_held_ = 0;  // samples of the current and of the largest shot
};

}  // namespace slipwave
