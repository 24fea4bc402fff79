// SPDX-License-Identifier: BSD-3-Clause
// Attenuation adds up, begins with its source and does nothing where it is none.
#include <gtest/gtest.h>

#include "cube.hpp"

namespace slipwave::solver {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000};

/// Water over rocks with a cluster of fractures and a free surface.
Scene<2> sea(std::int64_t nx = 180, std::int64_t nz = 100) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 20 + i / 40) put(scene.model.medium, {i, k}, water);
      if (k > 90) put(scene.model.medium, {i, k}, soft);
      if (k >= 50 && k < 60 && i % 150 >= 20 && i % 150 < 50) scene.model.fracture({i, k}) = 1;
    }
  scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 1000, 0}}}};
  scene.survey.sources = {
      {{0.42 * double(nx) * 5, 160}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {{0.3 * double(nx) * 5, 130}, {0.4 * double(nx) * 5, 261.3}, {40, 362}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.06, 0.001};
  return scene;
}

/// Rock that attenuates strongly, in double precision, with steps that fit the samples.
Scene<2> lossy(const std::vector<Source<2>>& sources) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(60, 50, 5, rock);
  for (const auto property : {Property::qp, Property::qs})
    scene.model.medium[property] = Field<2>(scene.model.grid(), 15.F);
  scene.survey.sources = {sources.front()};
  scene.survey.blended = {{sources.begin() + 1, sources.end()}};
  scene.survey.receivers_m = {{145, 120}, {220, 95}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.double_precision = true;
  scene.numerics.time_step_s = 0.0005;
  scene.recording = {{Component::vx, Component::vz}, 0.1, 0.001};
  set_attenuation(scene);
  check(scene);
  return scene;
}

Source<2> source_at(const Point<2>& at, double delay_s) {
  return {at, parse_mechanism<2>("explosion"), parse_wavelet("ricker:40"), 1e9, delay_s};
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0, scale = 0;
  for (std::size_t n = 0; n < one.size(); ++n) {
    largest = std::max(largest, std::abs(one[n] - other[n]));
    scale = std::max(scale, std::abs(other[n]));
  }
  return largest / scale;
}

// What sources put into the stress does not relax, however many they are and whenever they begin.
TEST(Attenuation, OfSourcesFiredTogetherAddsUp) {
  // In one row of cells: rows near sources are swept in two halves.
  const auto one = source_at({150, 125}, 0), other = source_at({164, 126}, 0);
  auto sum = samples_of(shoot(lossy({one}), 1));
  const auto added = samples_of(shoot(lossy({other}), 1));
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += added[n];
  EXPECT_LT(largest_difference(samples_of(shoot(lossy({one, other}), 1)), sum), 1e-9);
}

TEST(Attenuation, BeginsWithADelayedSource) {
  constexpr std::size_t late = 24;  // samples
  const auto delayed = shoot(lossy({source_at({150, 125}, late * 0.001)}), 1),
             at_once = shoot(lossy({source_at({150, 125}, 0)}), 1);
  for (std::size_t n = 0; n < at_once.traces.size(); ++n) {
    const auto& all = at_once.traces[n].samples;
    const auto& moved = delayed.traces[n].samples;
    // At t = 0 the wavelet is not quite zero.
    EXPECT_LT(largest_difference({moved.begin() + late, moved.end()}, {all.begin(), all.end() - late}), 2e-4);
  }
}

// Proves (Q7).
TEST(Attenuation, OfInfiniteQIsNone) {
  auto scene = sea();
  scene.recording.duration_s = 0.05;
  const auto elastic = samples_of(shoot(scene, 1));
  for (const auto property : {Property::qp, Property::qs})
    scene.model.medium[property] = Field<2>(scene.model.grid(), float(PropertyRow::infinite));
  set_attenuation(scene);
  EXPECT_FALSE(scene.attenuates());
  EXPECT_TRUE(samples_of(shoot(scene, 1)) == elastic);
  // A finite Q whose effect was not asked for does nothing either.
  scene.model.medium[Property::qp] = Field<2>(scene.model.grid(), 30.F);
  EXPECT_TRUE(samples_of(shoot(scene, 1)) == elastic);
}

}  // namespace
}  // namespace slipwave::solver
