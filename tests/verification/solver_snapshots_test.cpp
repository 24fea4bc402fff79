// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lab.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_snapshots_test {
namespace {

/// All fields of all snapshots of a wave that comes to cracks.
std::vector<Field<2>> snapshots(const Tiling& tiling) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(230, 90, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t z = 40; z < 50; ++z)
    for (std::int64_t x = 100; x < 140; ++x) scene.model.fracture({x, z}) = 1;
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.5, 1000, 0}}}};
  scene.survey.sources = {{{252, 203}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{600, 100}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx}, 0.15, 0.001};
  scene.snapshot_every_s = 0.02;
  scene.numerics.tiling = tiling;
  std::vector<Field<2>> all;
  shoot<2>(scene, 1, {}, [&](double, const FieldReader<2>& field) {
    for (const auto component : {Component::vx, Component::szz}) all.push_back(field(component));
  });
  return all;
}

TEST(Snapshots, DoNotDependOnWhatIsLeftOutOrHowPassesAreCut) {
  const auto whole = snapshots({1, 1 << 20, true});
  ASSERT_EQ(whole.size(), 14u);
  for (const auto& tiling : {Tiling{}, Tiling{1, 16}, Tiling{2, 48, true}}) {
    const auto found = snapshots(tiling);
    ASSERT_EQ(found.size(), whole.size());
    for (std::size_t n = 0; n < whole.size(); ++n) {
      std::size_t other = 0;
      for (std::size_t cell = 0; cell < whole[n].size(); ++cell) other += found[n][cell] != whole[n][cell];
      EXPECT_EQ(other, 0u) << tiling.stripe_cells << " columns, field " << n;
    }
  }
}

TEST(Snapshots, HoldWhatReceiversAtMiddlesOfCellsRecordThen) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(60, 50, 5, {4500, 2250, 2500});
  scene.survey.sources = {{{152, 103}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  const std::vector<Index<2>> cells = {{40, 20}, {28, 35}, {10, 12}};
  for (const auto& [x, z] : cells)
    scene.survey.receivers_m.push_back({5 * double(x) + 2.5, 5 * double(z) + 2.5});
  scene.edges = edges_all(EdgeLaw::absorbing);
  const std::vector<Component> components = {Component::vx, Component::vz, Component::sxx, Component::szz,
                                             Component::sxz};
  const double dt_s = time_step_s(scene);
  scene.recording = {components, 120 * dt_s, dt_s};
  scene.snapshot_every_s = 30 * dt_s;
  std::vector<std::pair<std::size_t, std::vector<float>>> seen;
  const auto gather = shoot<2>(scene, 1, {}, [&](double time_s, const FieldReader<2>& field) {
    std::vector<float> values;
    for (const auto component : components)
      for (const auto& cell : cells) values.push_back(field(component)(cell));
    seen.emplace_back(std::size_t(std::lround(time_s / dt_s)), values);
  });
  ASSERT_GE(seen.size(), 4u);
  for (const auto& [instant, values] : seen) {
    ASSERT_EQ(values.size(), gather.traces.size());
    for (std::size_t n = 0; n < values.size() && instant < 120; ++n) {
      double largest = 0;
      for (const double sample : gather.traces[n].samples) largest = std::max(largest, std::abs(sample));
      ASSERT_GT(largest, 0) << n;
      // Of numbers in single precision.
      EXPECT_NEAR(values[n], gather.traces[n].samples[instant], 1e-6 * largest) << n << ' ' << instant;
    }
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_snapshots_test
