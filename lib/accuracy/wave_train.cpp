// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/wave_train.hpp"

#include <cmath>

namespace slipwave {
namespace {

/// Frequencies a wavelet is resolved into.
constexpr int frequencies = 32;

/// The same number for speeds within some percent.
int class_of(double speed) { return speed > 0 ? int(std::lround(std::log(speed) / 0.04)) : -1; }

}  // namespace

WaveBand band_of(const Wavelet& wavelet, int power) {
  WaveBand band;
  // What lies above carries less than 1e-6 of the energy of smooth wavelets, 1e-4 of those with kinks.
  const double highest = wavelet.highest_frequency_hz(0.01) * 1.3;
  double sum = 0;
  for (int n = 0; n < frequencies; ++n) {
    const double hz = (n + 0.5) * highest / frequencies;
    const double amplitude = wavelet.amplitude_spectrum(hz);
    band.hz.push_back(hz);
    band.energy.push_back(amplitude * amplitude * std::pow(hz, power));
    sum += band.energy.back();
  }
  for (auto& share : band.energy) share /= sum;
  return band;
}

void WayOfWave::add(double vp, double vs, double time_s) {
  auto& medium = media_[{class_of(vp), class_of(vs)}];
  medium.vp += vp * time_s;
  medium.vs += vs * time_s;
  medium.time_s += time_s;
}

double WayOfWave::time_s() const {
  double sum = 0;
  for (const auto& [key, medium] : media_) sum += medium.time_s;
  return sum;
}

std::vector<WayOfWave::Medium> WayOfWave::media() const {
  std::vector<Medium> media;
  for (const auto& [key, sums] : media_)
    if (sums.time_s > 0) media.push_back({sums.vp / sums.time_s, sums.vs / sums.time_s, sums.time_s});
  return media;
}

double squared_error(const Discretisation& cells, const WaveTrain& train) {
  const double dt = cells.time_step_s, h = cells.spacing_m;
  const auto media = train.way.media();
  double error = 0;
  for (std::size_t n = 0; n < train.band.hz.size(); ++n) {
    std::complex<double> exponent = 0;
    for (const auto& medium : media) {
      const double speed = train.kind == WaveKind::p ? medium.vp : medium.vs;
      const double wavelength = speed / train.band.hz[n] / h;
      // Waves shorter than two cells are not on the grid at all.
      if (wavelength <= 2) {
        exponent = -1e3;
        break;
      }
      const UniformScheme scheme{cells.order, medium.vp * dt / h, medium.vs * dt / h, cells.time_order};
      exponent += medium.time_s / dt * step_error(scheme, train.kind, wavelength, train.angle);
    }
    error += train.band.energy[n] * std::norm(std::exp(exponent) - 1.0);
  }
  return error;
}

double squared_error(const Discretisation& cells, const std::vector<WaveTrain>& trains) {
  double energy = 0, wrong = 0;
  for (const auto& train : trains) {
    energy += train.energy;
    wrong += train.energy * squared_error(cells, train);
  }
  return energy > 0 ? wrong / energy : 0;
}

}  // namespace slipwave
