// SPDX-License-Identifier: BSD-3-Clause
#include "drawn_scene.hpp"
#include "long_form.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave::solver {

Rock Draw::rock(double cells) {
  const double vs = 100 * cells;
  return {vs * between(1.6, 2.5), vs, between(1600, 2800)};
}

std::vector<unsigned> seeds(unsigned in_short_form, unsigned in_long_form) {
  std::vector<unsigned> all;
  for (unsigned n = 1; n <= (long_form() ? in_long_form : in_short_form); ++n) all.push_back(n);
  return all;
}

Scene<2> scene_of(std::int64_t nx, std::int64_t nz, const Filling& filling, double duration_s,
                  double spacing_m) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, spacing_m, nothing);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(scene.model.medium, {i, k}, filling(i, k));
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.double_precision = true;
  scene.recording = {{Component::vz, Component::vx}, duration_s * spacing_m, 0.0005 * spacing_m};
  return scene;
}

void shoot_from(Scene<2>& scene, const Point<2>& source, const std::string& mechanism,
                std::vector<Point<2>> receivers) {
  const double spacing_m = scene.model.grid().spacing_m;
  const auto in_metres = [=](const Point<2>& at) { return Point<2>{at[0] * spacing_m, at[1] * spacing_m}; };
  const auto wavelet = parse_wavelet("ricker:" + shown(100 / spacing_m, 17));
  scene.survey.sources = {{in_metres(source), parse_mechanism<2>(mechanism), wavelet, 1e6}};
  std::transform(receivers.begin(), receivers.end(), receivers.begin(), in_metres);
  scene.survey.receivers_m = std::move(receivers);
}

std::vector<double> traces_of(const Scene<2>& scene) {
  std::vector<double> all;
  for (const auto& trace : shoot(scene, 1).traces)
    all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

double difference(const std::vector<double>& found, const std::vector<double>& wanted) {
  double square = 0, of = 0;
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    square += (found.at(n) - wanted[n]) * (found[n] - wanted[n]);
    of += wanted[n] * wanted[n];
  }
  return std::sqrt(square / of);
}

}  // namespace slipwave::solver
