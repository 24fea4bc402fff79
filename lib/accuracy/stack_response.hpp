// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <functional>
#include <memory>
#include <vector>

#include "accuracy/full_space.hpp"
#include "acquisition/survey.hpp"
#include "base/fft.hpp"

namespace slipwave {

/// Parallel layers round a line source at a = b = 0: a runs along the layers, b across them, downwards.
struct LayeredPlaces {
  std::vector<UniformMedium> layers;  // by increasing b; fluid where vs = 0
  /// b of the interfaces, m: before layer n + 1, or with a free surface before layer n.
  std::vector<double> faces_m;
  /// At each interface, the thickness of fluid that resists motion of the solid along it, of a free surface
  /// that of the solid itself, m; empty: none.
  std::vector<double> drag_m;
  /// Interfaces for which d records / d drag is wanted; empty: none.
  std::vector<bool> drags;
  bool free_surface = false;
  Point<2> force{};                          // along a and b, N/m
  SymmetricTensor<2, double> moment_rate{};  // in a and b
  struct Receiver {
    double a_m, b_m;
    std::size_t layer;
  };
  std::vector<Receiver> receivers;
  double duration_s = 0;  // of the traces
  /// A point source in 3-D instead of a line: its waves along layers have a spectrum steeper by sqrt(f).
  bool point_source = false;
  /// Of P and S waves of each layer, the factor on their speed at a frequency, Hz; empty: 1.
  std::vector<std::array<std::function<std::complex<double>(double)>, 2>> losses = {};

  std::size_t source_layer() const;
};

/// What a receiver records, by bins of frequency: its velocity along a and b, and the pressure.
using RecordSpectrum = std::vector<std::array<std::complex<double>, 3>>;
/// What of it counts together.
enum class Recorded { velocity, pressure };

/// How the exact response of layers changes with what they are: with the place of each interface and with the
/// speed of each wave in each layer. All waves are in it: reflected, converted, multiple ones, those bound to
/// interfaces. By wave number: a sum over plane waves per frequency, each by continuity of motion and
/// traction at all interfaces.
class StackResponse {
 public:
  /// `band_hz` is the highest frequency that matters. Where records are longer than affordable, waves are
  /// taken as longer than they are, and their changes as larger by as much; and what is longer still is cut
  /// (seconds()).
  StackResponse(const LayeredPlaces& places, const Wavelet& wavelet, double band_hz);

  std::size_t bins() const { return omega_.size(); }
  /// True angular frequency of a bin, 1/s; below the real axis, so that what comes later than the window
  /// decays.
  std::complex<double> omega(std::size_t bin) const { return omega_[bin]; }
  const RecordSpectrum& records(std::size_t receiver) const { return records_[receiver]; }
  /// d records / d b of an interface, 1/m.
  const RecordSpectrum& by_face(std::size_t face, std::size_t receiver) const {
    return by_face_[face][receiver];
  }
  /// d records / d drag of an interface, 1/m; zero where it is not wanted.
  const RecordSpectrum& by_drag(std::size_t face, std::size_t receiver) const {
    return by_drag_[face][receiver];
  }
  /// d records / d ln c of P (0) or S (1) waves in a layer.
  const RecordSpectrum& by_speed(std::size_t layer, int wave, std::size_t receiver) const {
    return by_speed_[2 * layer + std::size_t(wave)][receiver];
  }
  double seconds() const { return seconds_; }
  /// The sum of squares over all times of the traces that belong to a spectrum.
  double energy(const RecordSpectrum& spectrum, Recorded what) const;

 private:
  class PlaneWaves;

  double seconds_ = 0, window_s_ = 0, slower_ = 1;
  std::vector<std::complex<double>> omega_;
  std::unique_ptr<RealTransform> transform_;
  std::vector<RecordSpectrum> records_;
  std::vector<std::vector<RecordSpectrum>> by_face_, by_drag_, by_speed_;
};

}  // namespace slipwave
