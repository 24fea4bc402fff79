// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lab.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {
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

}  // namespace
}  // namespace slipwave::solver
