// SPDX-License-Identifier: BSD-3-Clause
// Attenuation adds up, begins with its source and does nothing where it is none.
#include <gtest/gtest.h>

#include "cube.hpp"
#include "sea_over_fractures.hpp"

namespace slipwave::solver::attenuating_sources_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};

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
  auto scene = sea_over_fractures();
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
}  // namespace slipwave::solver::attenuating_sources_test
