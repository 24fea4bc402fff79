// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "cube.hpp"

namespace slipwave::solver {

/// Ricker wavelet as theory.md (W1) has it, in double, with its derivative and its integral.
struct RickerForm {
  double peak_hz;
  double phase(double t) const { return std::numbers::pi * peak_hz * (t - 1.5 / peak_hz); }
  double operator()(double t) const {
    const double a = phase(t);
    return t < 0 ? 0 : (1 - 2 * a * a) * std::exp(-a * a);
  }
  double slope(double t) const {
    const double a = phase(t);
    return t < 0 ? 0 : std::numbers::pi * peak_hz * (4 * a * a * a - 6 * a) * std::exp(-a * a);
  }
  double bend(double t) const {
    const double a = phase(t), f = std::numbers::pi * peak_hz;
    return t < 0 ? 0 : f * f * (-8 * a * a * a * a + 24 * a * a - 6) * std::exp(-a * a);
  }
  double integral(double t) const {
    const double a = phase(t);
    return t < 0 ? 0 : a * std::exp(-a * a) / (std::numbers::pi * peak_hz);
  }
};

/// A shot with one source into a uniform or given medium; numbers as the tests need them.
inline Scene<3> scene_of(Medium<3> medium, const EdgeLaws<3>& edges, const Point<3>& source_m,
                         const char* mechanism, const char* wavelet, std::vector<Point<3>> receivers_m,
                         std::vector<Component> components, double duration_s, double interval_s) {
  Scene<3> scene;
  scene.model.medium = std::move(medium);
  scene.survey.sources = {{source_m, parse_mechanism<3>(mechanism), parse_wavelet(wavelet), 1e9}};
  scene.survey.receivers_m = std::move(receivers_m);
  scene.edges = edges;
  scene.recording = {std::move(components), duration_s, interval_s};
  return scene;
}

}  // namespace slipwave::solver
