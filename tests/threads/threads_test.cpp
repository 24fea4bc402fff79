// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "geology/marmousi.hpp"
#include "lab.hpp"
#include "parallel/threads.hpp"
#include "ranks_in_threads.hpp"
#include "samples.hpp"
#include "scene/subdomains.hpp"
#include "solver/simulation.hpp"

// Small, but cut into many pieces: a band of the pipeline has some 50 rows.
namespace slipwave::solver::threads_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000};
constexpr std::int64_t nx = 48, nz = 400;

/// Water over two rocks, cracks from top to bottom across all bands.
Scene<2> scene_of(EdgeLaw sides, bool fractured) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 20 + i / 4) put(scene.model.medium, {i, k}, water);
      if (k > 180 + i) put(scene.model.medium, {i, k}, soft);
    }
  if (fractured) {
    scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
    for (std::int64_t k = 60; k < nz - 20; ++k)
      for (std::int64_t i = 15; i < 30; ++i) scene.model.fracture({i, k}) = 1;
    scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.1, 0.01, 0}}}};
  }
  scene.survey.sources = {{{122.5, 502.5}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:80"), 1e6},
                          {{60, 1502.5}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:60"), 1e6}};
  for (double z = 5; z < 2000; z += 190) scene.survey.receivers_m.push_back({100 + z / 100, z});
  scene.edges = edges_all(sides);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.025, 0.001};
  return scene;
}

/// All shots, so many at a time, with whole fields looked at now and then.
std::vector<std::vector<double>> shots(Scene<2> scene, int threads, int at_once) {
  const ThreadLimit limit(threads);
  scene.snapshot_every_s = 0.005;
  std::vector<std::vector<double>> found(scene.survey.sources.size());
  parallel_jobs(std::int64_t(found.size()), at_once, [&](std::int64_t job) {
    auto& samples = found[std::size_t(job)];
    std::vector<double> looks;
    samples = samples_of(shoot<2>(scene, std::size_t(job) + 1, {}, [&](double, const FieldReader<2>& field) {
      const auto vz = field(Component::vz);
      looks.push_back(std::accumulate(vz.begin(), vz.end(), 0.));
    }));
    samples.insert(samples.end(), looks.begin(), looks.end());
  });
  return found;
}

void expect_the_same_on_threads(const Scene<2>& scene) {
  const auto alone = shots(scene, 1, 1);
  for (const auto& samples : alone) EXPECT_GT(*std::max_element(samples.begin(), samples.end()), 0);
  EXPECT_EQ(shots(scene, 2, 1), alone);
  EXPECT_EQ(shots(scene, 4, 2), alone);
}

}  // namespace

TEST(Threads, ShareAShotInThePml) { expect_the_same_on_threads(scene_of(EdgeLaw::absorbing, false)); }

TEST(Threads, ShareAShotWithSlip) {
  auto scene = scene_of(EdgeLaw::absorbing, true);
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential}) {
    scene.numerics.correction = correction;
    scene.slip_diary = correction == SlipCorrection::second;
    expect_the_same_on_threads(scene);
  }
}

TEST(Threads, ShareAShotBetweenFreeSides) {
  auto scene = scene_of(EdgeLaw::free, false);
  scene.numerics.order = 7;
  expect_the_same_on_threads(scene);
}

TEST(Threads, ShareAShotOfFourthOrderInDoublePrecision) {
  auto scene = scene_of(EdgeLaw::rigid, true);
  scene.numerics.order = 3;
  scene.numerics.time_order = 4;
  scene.numerics.double_precision = true;
  scene.numerics.cfl = 0.7;
  scene.numerics.tiling = {1, 16, true};
  scene.recording.duration_s = 0.012;
  expect_the_same_on_threads(scene);
}

/// Faces between bands in one rock and at an interface, at the order that reads most rows beyond them.
Scene<2> scene_in_bands() {
  auto scene = scene_of(EdgeLaw::absorbing, false);
  auto& medium = scene.model.medium;
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(medium, {i, k}, k < 200 ? soft : rock);
  scene.numerics.order = 11;
  scene.numerics.cfl = 0.45;
  scene.numerics.bands = {{0, 5}, {600, 10}, {1000, 20}};
  return scene;
}

TEST(Threads, ShareAShotInBands) { expect_the_same_on_threads(scene_in_bands()); }

TEST(Threads, OfSeveralRanksShareAShotInBands) {
  const auto scene = scene_in_bands();
  const auto alone = samples_of(shoot(scene, 1));
  for (const int count : {2, 3}) {
    const ThreadLimit limit(4);
    std::vector<double> together;
    RanksInThreads::run(count, [&](Ranks& ranks) {
      const auto gather = shoot(scene, 1, {}, {}, nullptr, nullptr, &ranks);
      if (ranks.number() == 0) together = samples_of(gather);
    });
    EXPECT_TRUE(together == alone) << count << " ranks";
  }
}

TEST(Threads, OfSeveralRanksRecordWhatOneDoes) {
  for (const auto sides : {EdgeLaw::absorbing, EdgeLaw::free}) {
    const auto scene = scene_of(sides, true);
    const auto alone = samples_of(shoot(scene, 2));
    for (const int count : {2, 3}) {
      const ThreadLimit limit(4);
      std::vector<double> together;
      RanksInThreads::run(count, [&](Ranks& ranks) {
        auto part = cut_to(scene, subdomain_for(scene, scene.model.grid(), ranks.number(), count));
        join(part, ranks);
        const auto gather = shoot(part, 2, {}, {}, nullptr, nullptr, &ranks);
        if (ranks.number() == 0) together = samples_of(gather);
      });
      EXPECT_TRUE(together == alone) << count << " ranks";
    }
  }
}

TEST(Threads, ShareThePlaneWave) {
  auto scene = scene_of(EdgeLaw::absorbing, true);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(scene.model.medium, {i, k}, rock);
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.survey.sources.pop_back();
  scene.survey.sources[0].mechanism = parse_mechanism<2>("plane:0");
  expect_the_same_on_threads(scene);
}

TEST(Threads, ShareTheWorkOnAModel) {
  const Grid<2> grid{{96, 64}, 20, {0, 0}};
  const auto model_on = [&](int threads) {
    const ThreadLimit limit(threads);
    return marmousi_medium(grid, {});
  };
  const auto alone = model_on(1), shared = model_on(2);
  EXPECT_TRUE(std::equal(alone.vp.begin(), alone.vp.end(), shared.vp.begin()));
  EXPECT_TRUE(std::equal(alone.rho.begin(), alone.rho.end(), shared.rho.begin()));
}

TEST(Threads, TakeEveryPieceOnceAndInOrder) {
  const ThreadLimit limit(3);
  constexpr std::int64_t tiles = 20, bands = 7, in_progress = 3;
  // What a band holds is the number of tiles that have been there; no atomics, as in the fields.
  std::vector<std::int64_t> been(bands, 0);
  parallel_tiles(tiles, bands, in_progress, [&](std::int64_t tile, std::int64_t band, int) {
    EXPECT_EQ(been[std::size_t(band)], tile);
    if (band > 0) {
      EXPECT_EQ(been[std::size_t(band - 1)], tile + 1);
    }
    been[std::size_t(band)] = tile + 1;
  });
  EXPECT_EQ(been, std::vector<std::int64_t>(bands, tiles));
  std::vector<int> taken(1000, 0);
  parallel_for(std::int64_t(taken.size()), 7, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto n = begin; n < end; ++n) ++taken[std::size_t(n)];
  });
  EXPECT_EQ(taken, std::vector<int>(1000, 1));
}

}  // namespace slipwave::solver::threads_test
