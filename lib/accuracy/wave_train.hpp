// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "accuracy/dispersion.hpp"
#include "acquisition/wavelet.hpp"

namespace slipwave {

/// A wavelet's frequencies and the share of a wave's energy at each (their sum is 1).
struct WaveBand {
  std::vector<double> hz, energy;
};

/// Of a wave whose amplitude spectrum is that of the wavelet times sqrt(f)^power.
WaveBand band_of(const Wavelet& wavelet, int power);

/// How long a wave travels in which medium. Media whose speeds differ by less than some percent count as one.
class WayOfWave {
 public:
  void add(double vp, double vs, double time_s);
  bool empty() const { return media_.empty(); }
  double time_s() const;

  struct Medium {
    double vp = 0, vs = 0;  // weighted by time
    double time_s = 0;
  };
  std::vector<Medium> media() const;

 private:
  std::map<std::pair<int, int>, Medium> media_;  // by the logarithms of their speeds
};

/// Waves of one kind that go one way, in one direction (radians from the vertical).
struct WaveTrain {
  double energy = 1;  // against that of the other trains
  WaveKind kind = WaveKind::p;
  double angle = 0;
  WayOfWave way;
  WaveBand band;
};

/// Cells and steps; the medium apart, all that dispersion depends on.
struct Discretisation {
  int order = 5;
  double time_step_s = 0;
  double spacing_m = 0;
  int time_order = 2;
};

/// error^2 of (E16) for one train.
double squared_error(const Discretisation& cells, const WaveTrain& train);
/// The same for many, each by its energy.
double squared_error(const Discretisation& cells, const std::vector<WaveTrain>& trains);

}  // namespace slipwave
