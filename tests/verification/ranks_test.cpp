// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "acquisition/interpolation.hpp"
#include "cube_extruded.hpp"
#include "lab.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
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

TEST(Ranks, RecordTogetherWhatOneProcessDoes) {
  struct Kind {
    const char* name;
    EdgeLaw sides, bottom;
    int order, time_order;
    SlipCorrection correction;
  };
  for (const auto& [name, sides, bottom, order, time_order, correction] :
       {Kind{"PML", EdgeLaw::absorbing, EdgeLaw::absorbing, 5, 2, SlipCorrection::second},
        Kind{"free sides", EdgeLaw::free, EdgeLaw::rigid, 7, 2, SlipCorrection::exponential},
        Kind{"mirror", EdgeLaw::mirror, EdgeLaw::absorbing, 3, 2, SlipCorrection::first},
        Kind{"order 1", EdgeLaw::absorbing, EdgeLaw::free, 1, 2, SlipCorrection::second},
        Kind{"order 4 in time", EdgeLaw::free, EdgeLaw::absorbing, 5, 4, SlipCorrection::second}}) {
    SCOPED_TRACE(name);
    auto scene = reef();
    scene.edges[0] = {sides, sides};
    scene.edges[1][1] = bottom;
    scene.numerics.order = order;
    scene.numerics.time_order = time_order;
    scene.numerics.correction = correction;
    const auto alone = all_samples(shoot(scene, 1));
    double largest = 0;
    for (const double sample : alone) largest = std::max(largest, std::abs(sample));
    EXPECT_GT(largest, 0);
    for (const int count : {2, time_order == 4 ? 2 : 4})
      for (const int threads : {1, 3})
        EXPECT_TRUE(all_samples(shared_out(scene, count, threads)) == alone)
            << count << " ranks, " << threads << " threads";
  }
}

TEST(Ranks, RecordAlongAWholeBoreholeWhatOneProcessDoes) {
  // Receivers near every row: some read beyond the rows of their rank.
  auto scene = reef();
  scene.survey.receivers_m.clear();
  for (double z = 3; z < 950; z += 7) scene.survey.receivers_m.push_back({223.4, z});
  const auto part = subdomain_for(scene, scene.model.grid(), 1, 4);
  EXPECT_GT(part.exchanged, spread_of_a_tile(scene));
  const auto alone = all_samples(shoot(scene, 1));
  EXPECT_TRUE(all_samples(shared_out(scene, 4, 3)) == alone);
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
      scene.survey.receivers_m.clear();
      for (double z = 3; z < 5. * double(rows); z += 7) scene.survey.receivers_m.push_back({123.4, z});
      EXPECT_TRUE(holds_all_of_a_neighbour(scene, count));
      ASSERT_TRUE(each_owns_its_part(scene, count));
      const auto alone = all_samples(shoot(scene, 1));
      ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
      for (const int threads : {1, 3})
        EXPECT_TRUE(all_samples(shared_out(scene, count, threads)) == alone) << threads << " threads";
    }
}

TEST(Ranks, RecordOnLinesOfSeveralStripesWhatOneProcessDoes) {
  // Fractures are a small part of each line: they take half sweeps alone.
  auto scene = reef(600);
  scene.numerics.time_order = 4;
  scene.recording.duration_s = 0.1;
  EXPECT_TRUE(all_samples(shared_out(scene, 2, 3)) == all_samples(shoot(scene, 1)));
  scene.numerics.time_order = 2;
  EXPECT_TRUE(all_samples(shared_out(scene, 3)) == all_samples(shoot(scene, 1)));
}

TEST(Ranks, InDoublePrecisionAndUnderStaticStressToo) {
  auto scene = reef();
  scene.numerics.double_precision = true;
  scene.model.prestress_pa.assign(3, Field<2>(scene.model.grid(), -0.02F));
  scene.model.prestress_pa[2] = Field<2>(scene.model.grid(), 0.005F);
  EXPECT_TRUE(all_samples(shared_out(scene, 3)) == all_samples(shoot(scene, 1)));
}

TEST(Ranks, WhereWavesStayMonotoneToo) {
  auto scene = reef();
  scene.numerics.monotone = true;
  EXPECT_TRUE(all_samples(shared_out(scene, 3)) == all_samples(shoot(scene, 1)));
}

// Proves (S18).
TEST(Ranks, WhereSlipWeakensFrictionToo) {
  auto scene = reef();
  for (auto& set : scene.model.fracture_sets) {
    set.systems[0].law = FrictionLaw::slip_weakening;
    set.systems[0].slip_distance_m = 1e-11;
  }
  for (const auto correction :
       {SlipCorrection::second, SlipCorrection::exponential, SlipCorrection::centred}) {
    scene.numerics.correction = correction;
    const auto alone = all_samples(shoot(scene, 1));
    EXPECT_TRUE(all_samples(shared_out(scene, 3, 2)) == alone);
    auto coulomb = scene;
    for (auto& set : coulomb.model.fracture_sets) set.systems[0].law = FrictionLaw::coulomb;
    EXPECT_FALSE(all_samples(shoot(coulomb, 1)) == alone);
  }
}

TEST(Ranks, RecordInThreeDimensionsWhatOneProcessDoes) {
  const Index<3> shape = {34, 22, 120};
  auto medium = uniform_cube(shape, 5, rock);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    put(medium, at, reef_at(at[0] + at[1] / 3, shape[0], at[2] / 2));
  }
  for (const auto sides : {EdgeLaw::absorbing, EdgeLaw::free}) {
    auto edges = edges_all_3d(sides);
    edges[2][0] = EdgeLaw::free;
    auto scene = scene_of(medium, edges, {91, 57, 303}, "force:1,2,3", "ricker:40",
                          {{21, 30, 13}, {133, 71.3, 302.2}, {71, 60, 587}},
                          {Component::vx, Component::vy, Component::syz, Component::p}, 0.06, 0.001);
    scene.numerics.zone_cells = 6;
    scene.model.fracture = Field<3, std::uint8_t>(medium.grid());
    for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
      const auto at = medium.grid().index(n);
      if (at[2] > 40 && at[0] > 8 && at[0] < 25 && at[1] > 5) scene.model.fracture[std::size_t(n)] = 1;
    }
    scene.model.fracture_sets = {{"cracks", {{{0.6, 0, 0.8}, 0.4, 0.001, 1}}}};
    const auto alone = all_samples(shoot(scene, 1));
    EXPECT_GT(*std::max_element(alone.begin(), alone.end()), 0);
    for (const int count : {2, 3})
      EXPECT_TRUE(all_samples(shared_out(scene, count, count)) == alone) << count << " ranks";
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
               {{55, 65, 95}, {55, 65, 155}, {75, 42, 171}}, {Component::vz, Component::p}, 0.1, 0.001);
  EXPECT_TRUE(holds_all_of_a_neighbour(scene, 2));
  ASSERT_TRUE(each_owns_its_part(scene, 2));
  const auto alone = all_samples(shoot(scene, 1));
  ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
  EXPECT_TRUE(all_samples(shared_out(scene, 2)) == alone);
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
    scene.recording.duration_s = 0.5;
    const auto alone = all_samples(shoot(scene, 1));
    for (const int count : {2, 3})
      EXPECT_TRUE(all_samples(shared_out(scene, count)) == alone) << count << " ranks, row " << floor;
  }
}

TEST(Ranks, TakeTheSameSnapshotsAndSayWhereTheEnergyWent) {
  auto scene = reef();
  scene.snapshot_every_s = 0.05;
  scene.slip_diary = true;
  using Keys = std::vector<FieldKey>;
  const Keys keys = {Component::vx, Component::p, SlipField::slip, SlipField::opening};
  std::vector<Field<2>> alone, together;
  const auto into = [&](std::vector<Field<2>>& all) {
    return [&](double, const FieldReader<2>& field) {
      for (const auto& key : keys) all.push_back(field(key));
    };
  };
  ShotReport report;
  const auto traces = all_samples(shoot<2>(scene, 1, {}, into(alone), nullptr, &report));
  RanksInThreads::run(3, [&](Ranks& ranks) {
    const auto part = part_of(scene, ranks);
    std::vector<Field<2>> of_helper;
    ShotReport of_all;
    const auto gather =
        shoot<2>(part, 1, {}, into(ranks.number() == 0 ? together : of_helper), nullptr, &of_all, &ranks);
    ASSERT_TRUE(of_all.slip && of_all.source_work);
    EXPECT_EQ(of_all.slip->cells, report.slip->cells);
    EXPECT_EQ(of_all.slip->slipped, report.slip->slipped);
    EXPECT_NEAR(of_all.slip->dissipated / report.slip->dissipated, 1, 1e-9);
    EXPECT_NEAR(*of_all.source_work / *report.source_work, 1, 1e-9);
    EXPECT_NEAR(of_all.energy_left / report.energy_left, 1, 1e-9);
    EXPECT_TRUE(ranks.number() > 0 || all_samples(gather) == traces);
  });
  ASSERT_EQ(alone.size(), 3 * keys.size());
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_TRUE(std::equal(alone[n].begin(), alone[n].end(), together[n].begin(), together[n].end())) << n;
    EXPECT_GT(*std::max_element(alone[n].begin(), alone[n].end()), 0) << n;
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
}  // namespace slipwave::solver
