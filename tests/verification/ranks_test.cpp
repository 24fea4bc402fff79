// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "acquisition/interpolation.hpp"
#include "bit_scenes.hpp"
#include "cube_extruded.hpp"
#include "fitted_scenes.hpp"
#include "lab.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver::ranks_test {
namespace {

/// Water over rocks, with fractures and voids down to the bottom.
Scene<2> reef(std::int64_t nx = 90) {
  constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000}, air{0, 0, 0};
  const std::int64_t nz = 190;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 30 + i % 100 / 10) put(scene.model.medium, {i, k}, water);
      if (k > 120 + i % 100 / 9) put(scene.model.medium, {i, k}, soft);
      if (i > 60 && i < 66 && k > 60 && k < 100) put(scene.model.medium, {i, k}, air);
      if (i >= 30 && i < 50 && k > 55 && k < 185) scene.model.fracture({i, k}) = 1 + (i + k) % 2;
    }
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.5, 0.001, 0.01, true}}},
                               {"blocks", {{{1, 0}, 0.4, 0, 0.02}, {{0, 1}, 0.3, 0.001, 0.01}}}};
  scene.survey.sources = {{{203, 461}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 3}, {402.5, 201.3}, {220, 400}, {220.1, 470.2}, {227, 703.3}, {33, 941}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p, Component::sxz}, 0.16, 0.001};
  return scene;
}

class OnRanks : public testing::TestWithParam<BitScene> {};

// Proves (F10), (S18), (S43), (A13).
TEST_P(OnRanks, EveryOutcomeIsThatOfOneProcess) {
  with_scene(GetParam(), []<int D>(Scene<D> scene) {
    const auto alone = outcome_of(scene);
    ASSERT_GT(*std::max_element(alone.samples.begin(), alone.samples.end()), 0);
    const auto most = [&] {
      return scene.model.grid().shape[D - 1] / (spread_of_a_tile(scene) + widest_stencil);
    };
    // Tiles of many sweeps need ranks of more rows.
    if (most() < 2) scene.numerics.tiling.steps = 1;
    expect_same_on_ranks(scene, alone, 2, 3);
    if (D == 2 && most() >= 3) expect_same_on_ranks(scene, alone, 3, 1);
  });
}

/// Scenes of point sources: plane waves are computed by one process. Nor are those in space that take many
/// sweeps a step shared out, since they need too many rows for a test.
std::vector<BitScene> to_share_out() {
  auto all = bit_scenes();
  std::erase_if(all, [](const BitScene& of) {
    return of.name.find("PlaneWave") != std::string::npos ||
           (of.name.starts_with("Space") && of.name.ends_with("InTime4"));
  });
  return all;
}
INSTANTIATE_TEST_SUITE_P(Of, OnRanks, testing::ValuesIn(to_share_out()),
                         [](const auto& of) { return of.param.name; });

// Proves (F9).
TEST(FittedRanks, TakeTheTimeStepOfOneProcess) {
  const auto scene = fitted_sea(90, 190);
  const double alone = time_step_s(scene);
  RanksInThreads::run(3, [&](Ranks& ranks) { EXPECT_EQ(time_step_s(part_of(scene, ranks)), alone); });
}

TEST(Ranks, RecordAlongAWholeBoreholeWhatOneProcessDoes) {
  // Receivers near every row: some read beyond the rows of their rank.
  auto scene = reef();
  scene.survey.receivers_m.clear();
  for (double z = 3; z < 950; z += 7) scene.survey.receivers_m.push_back({223.4, z});
  const auto part = subdomain_for(scene, scene.model.grid(), 1, 4);
  EXPECT_GT(part.exchanged, spread_of_a_tile(scene));
  const auto alone = samples_of(shoot(scene, 1));
  EXPECT_TRUE(samples_of(shared_out(scene, 4, 3)) == alone);
  // Where few receivers lie, boundaries keep away from them, and less is exchanged.
  scene.survey.receivers_m.resize(1);
  EXPECT_EQ(subdomain_for(scene, scene.model.grid(), 1, 4).exchanged, spread_of_a_tile(scene));
}

/// Whether a rank holds rows of others up to an edge of the model.
template <int D>
bool holds_all_of_a_neighbour(const Scene<D>& scene, int count) {
  bool any = false;
  for (int number = 0; number < count; ++number) {
    const auto part = subdomain_for(scene, scene.model.grid(), number, count);
    const auto [first, last] = rows_held(part);
    any |= (part.first > 0 && first == 0) || (part.last < part.rows && last == part.rows);
  }
  return any;
}

/// Whether every rank computes its own rows alone, and those of the zones beyond them.
template <int D>
bool each_owns_its_part(const Scene<D>& scene, int count) {
  bool all = true;
  for (int number = 0; number < count; ++number) {
    const auto part = cut_to(scene, subdomain_for(scene, scene.model.grid(), number, count));
    const auto zone = zone_cells(scene, scene.survey.sources[0]);
    const auto domain = make_domain(part.model.medium, part.edges, zone, part.subdomain);
    std::int64_t rows = part.subdomain.last - part.subdomain.first;
    if (number == 0 && part.edges[D - 1][0] == EdgeLaw::absorbing) rows += zone;
    if (number + 1 == count && part.edges[D - 1][1] == EdgeLaw::absorbing) rows += zone;
    all &= domain.own.count() == rows;
  }
  return all;
}

TEST(Ranks, ThatHoldAllRowsOfANeighbourRecordWhatOneProcessDoes) {
  // Receivers near every row and no more rows than ranks must have: those they are sent reach the edges.
  const auto surface = edges_all(EdgeLaw::free);
  for (const auto& [count, rows] : {std::pair{2, 28}, {3, 42}, {4, 57}})
    for (const int absorbing : {0, 1, 2, 3}) {
      SCOPED_TRACE(std::to_string(count) + " ranks, " + std::to_string(rows) + " rows, edges " +
                   std::to_string(absorbing));
      auto scene = reef();
      scene.model.medium = uniform_medium(60, rows, 5, {4500, 2250, 2500});
      scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
      for (std::int64_t k = 5; k < rows; ++k)
        for (std::int64_t i = 30; i < 50; ++i) scene.model.fracture({i, k}) = 1 + (i + k) % 2;
      scene.edges[1] = surface[1];
      for (const int side : {0, 1})
        if (absorbing & (1 << side)) scene.edges[1][std::size_t(side)] = EdgeLaw::absorbing;
      scene.survey.sources[0].position_m = {203, 81};
      scene.survey.sources[0].wavelet = parse_wavelet("ricker:80");
      scene.recording.duration_s = 0.06;
      scene.survey.receivers_m.clear();
      for (double z = 3; z < 5. * double(rows); z += 7) scene.survey.receivers_m.push_back({123.4, z});
      EXPECT_TRUE(holds_all_of_a_neighbour(scene, count));
      ASSERT_TRUE(each_owns_its_part(scene, count));
      const auto alone = samples_of(shoot(scene, 1));
      ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
      EXPECT_TRUE(samples_of(shared_out(scene, count, count == 3 ? 1 : 3)) == alone);
    }
}

TEST(Ranks, ThatHoldAllRowsOfANeighbourDoSoInThreeDimensions) {
  const Index<3> shape = {24, 16, 30};
  auto medium = uniform_cube(shape, 10, {1500, 0, 1000});
  for (std::int64_t n = 0; n < medium.grid().size(); ++n)
    if (medium.grid().index(n)[2] >= 10) put(medium, medium.grid().index(n), {2500, 1250, 2000});
  auto edges = edges_all_3d(EdgeLaw::absorbing);
  edges[2][0] = EdgeLaw::free;
  auto scene =
      scene_of(medium, edges, {105, 65, 95}, "explosion", "ricker:8",
               {{55, 65, 95}, {55, 65, 155}, {75, 42, 171}}, {Component::vz, Component::p}, 0.05, 0.001);
  scene.numerics.zone_cells = 8;
  EXPECT_TRUE(holds_all_of_a_neighbour(scene, 2));
  ASSERT_TRUE(each_owns_its_part(scene, 2));
  const auto alone = samples_of(shoot(scene, 1));
  ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
  EXPECT_TRUE(samples_of(shared_out(scene, 2)) == alone);
}

TEST(Ranks, ThatHoldFluidAloneRecordWhatOneProcessDoes) {
  // Solid, or an interface, in the rows of another rank or at the end of those it holds.
  for (const std::int64_t floor : {41, 44, 47, 50, 53, 56, 80}) {
    auto scene = reef();
    scene.model.medium = uniform_medium(60, 100, 10, {1500, 0, 1000});
    for (std::int64_t k = floor; k < 100; ++k)
      for (std::int64_t i = 0; i < 60; ++i) put(scene.model.medium, {i, k}, {2500, 1250, 2000});
    scene.model.fracture = {};
    scene.model.fracture_sets.clear();
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.survey.sources[0].position_m = {203, 381};
    scene.survey.receivers_m = {{34.3, 5}, {444, 405}, {301, 777}};
    scene.recording.duration_s = 0.25;
    const auto alone = samples_of(shoot(scene, 1));
    for (const int count : {2, 3})
      EXPECT_TRUE(samples_of(shared_out(scene, count)) == alone) << count << " ranks, row " << floor;
  }
}

TEST(Ranks, AllSayWhereAShotBecameUnstable) {
  auto scene = reef();
  scene.numerics.time_step_s = 2.5 * stable_time_step_s(scene);
  std::vector<std::string> said(3);
  std::vector<double> until(3);
  Gather kept;
  RanksInThreads::run(3, [&](Ranks& ranks) {
    const auto number = std::size_t(ranks.number());
    try {
      shoot(part_of(scene, ranks), 1, {}, {}, nullptr, nullptr, &ranks);
    } catch (const Unstable& error) {
      said[number] = error.what();
      until[number] = error.sound_until_s();
      if (number == 0) kept = error.gather();
    }
  });
  EXPECT_NE(said[0].find("became unstable at x="), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("fracture set"), std::string::npos) << said[0];
  EXPECT_EQ(said[0], said[1]);
  EXPECT_EQ(said[0], said[2]);
  EXPECT_EQ(until[0], until[2]);
  ASSERT_EQ(kept.traces.size(), 4 * scene.survey.receivers_m.size());
  for (const auto& trace : kept.traces) EXPECT_EQ(std::int64_t(trace.samples.size()), kept.axis.count);
}

TEST(Parts, TileTheModelEvenly) {
  auto scene = reef();
  scene.model.medium = uniform_medium(4, 1000, 5, rock);
  scene.model.fracture = {};
  for (const int count : {2, 3, 7}) {
    std::int64_t before = 0;
    for (int number = 0; number < count; ++number) {
      const auto part = subdomain_for(scene, scene.model.grid(), number, count);
      EXPECT_EQ(part.first, before);
      // A zone of 20 rows lies below the last.
      const auto computed = part.last - part.first + (number + 1 == count ? 20 : 0);
      EXPECT_NEAR(double(computed), 1020. / count, 2 * widest_stencil) << number << " of " << count;
      before = part.last;
    }
    EXPECT_EQ(before, 1000);
  }
}

TEST(Parts, AreRefusedWhereRowsAreTooFew) {
  auto scene = reef();
  try {
    subdomain_for(scene, scene.model.grid(), 0, 50);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "found 50 processes a shot for a model of 190 rows, expected at most 7: each takes 24 or more");
  }
  scene.survey.sources[0].mechanism = PlaneWave<2>{};
  EXPECT_THROW(subdomain_for(scene, scene.model.grid(), 0, 2), Error);
}

TEST(Ranks, ThrowWhatOneOfThemThrows) {
  std::vector<std::string> said(3);
  RanksInThreads::run(3, [&](Ranks& ranks) {
    try {
      collective_try(&ranks, [&] {
        if (ranks.number() > 0) throw Error("found " + std::to_string(ranks.number()), ErrorKind::usage);
      });
    } catch (const CollectiveError& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      said[std::size_t(ranks.number())] = error.what();
    }
  });
  EXPECT_EQ(said, std::vector<std::string>(3, "found 1"));
}

}  // namespace
}  // namespace slipwave::solver::ranks_test
