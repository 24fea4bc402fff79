// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>

#include "lab.hpp"
#include "one_pause.hpp"
#include "parallel/threads.hpp"
#include "solver/simulation.hpp"

// A shot that is left off and taken up again by another one is the shot that was never interrupted, to the
// last bit.
namespace slipwave::solver {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000};

/// Samples of all traces and values of all snapshots, in order.
struct Recorded {
  std::vector<double> samples;
  std::vector<double> snapshots;
};

SnapshotSink<2> into(std::vector<double>& snapshots) {
  return [&snapshots](double time_s, const FieldReader<2>& field) {
    snapshots.push_back(time_s);
    for (const auto component : {Component::vz, Component::sxz})
      for (const float value : field(component)) snapshots.push_back(value);
  };
}

std::vector<double> samples_of(const Gather& gather) {
  std::vector<double> all;
  for (const auto& trace : gather.traces) all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

Recorded undisturbed(const Scene<2>& scene) {
  Recorded recorded;
  recorded.samples = samples_of(shoot<2>(scene, 1, {}, into(recorded.snapshots)));
  return recorded;
}

/// A shot in as many runs as it takes, each stopped after some time tiles, by `threads` in turn.
Recorded in_pieces(const Scene<2>& scene, const std::vector<int>& threads, int passes, int& runs) {
  Recorded recorded;
  std::vector<char> kept;
  for (runs = 0;; ++runs) {
    const ThreadLimit limit(threads[std::size_t(runs) % threads.size()]);
    OnePause pauses(kept, passes + runs % 3);
    try {
      recorded.samples = samples_of(shoot<2>(scene, 1, {}, into(recorded.snapshots), &pauses));
      return recorded;
    } catch (const LeftOff&) {
    }
  }
}

/// Bits, so that zeros of both signs differ.
bool same_bits(const std::vector<double>& one, const std::vector<double>& other) {
  return one.size() == other.size() && !one.empty() &&
         std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0;
}

/// Water over two rocks with cracks.
Scene<2> reef() {
  Scene<2> scene;
  constexpr std::int64_t nx = 130, nz = 120;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 20 + i / 20)
        put(scene.model.medium, {i, k}, water);
      else if (k > 80)
        put(scene.model.medium, {i, k}, soft);
      if (k >= 50 && k < 60 && i >= 50 && i < 80) scene.model.fracture({i, k}) = 1;
    }
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.5, 1000, 0}}}};
  scene.survey.sources = {{{250, 60}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 30}, {402.5, 201.3}, {620, 333}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.12, 0.001};
  scene.snapshot_every_s = 0.017;
  return scene;
}

void expect_same(const Scene<2>& scene, const std::string& what) {
  SCOPED_TRACE(what);
  const auto whole = undisturbed(scene);
  int runs = 0;
  const auto pieces = in_pieces(scene, {1, 2, 3}, 4, runs);
  EXPECT_GT(runs, 5);
  EXPECT_TRUE(same_bits(pieces.samples, whole.samples));
  EXPECT_TRUE(same_bits(pieces.snapshots, whole.snapshots));
}

TEST(Pauses, ChangeNoBitUnderAnyEdgeLaw) {
  for (const auto law : {EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::rigid, EdgeLaw::mirror}) {
    auto scene = reef();
    scene.edges = edges_all(law);
    expect_same(scene, "law " + std::to_string(int(law)));
  }
}

TEST(Pauses, ChangeNoBitAtAnyOrderAndPrecision) {
  for (const int order : orders)
    for (const bool twice : {false, true}) {
      auto scene = reef();
      scene.numerics.order = order;
      scene.numerics.double_precision = twice;
      expect_same(scene, "order " + std::to_string(order) + (twice ? ", double" : ", float"));
    }
}

TEST(Pauses, ChangeNoBitWithAnyCorrectionAndTimeOrder) {
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::centred})
    for (const int time_order : {2, 4}) {
      auto scene = reef();
      scene.numerics.correction = correction;
      scene.numerics.time_order = time_order;
      expect_same(scene, "correction " + std::to_string(int(correction)) + ", time order " +
                             std::to_string(time_order));
    }
}

TEST(Pauses, ChangeNoBitWhereAllIsFluid) {
  auto scene = reef();
  scene.model.medium = uniform_medium(130, 120, 5, water);
  scene.model.fracture = {};
  scene.model.fracture_sets.clear();
  scene.recording.duration_s = 0.3;
  expect_same(scene, "water");
}

// Proves (S18).
TEST(Pauses, ChangeNoBitWhereSlipWeakensFriction) {
  auto scene = reef();
  // Blocks, one of which weakens, and crossing planes.
  scene.model.fracture_sets = {{"blocks", {{{0.6, 0.8}, 0.5, 10, 0}, {{-0.8, 0.6}, 0.4, 0, 0}}},
                               {"crossing", {{{0.6, 0.8}, 0.5, 10, 0}, {{1, 0}, 0.4, 0, 0}}},
                               {"one", {{{0.6, 0.8}, 0.5, 10, 0}}}};
  for (std::int64_t k = 50; k < 60; ++k)
    for (std::int64_t i = 50; i < 80; ++i) scene.model.fracture({i, k}) = std::uint8_t(1 + i / 10 % 3);
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential,
                                SlipCorrection::centred}) {
    scene.numerics.correction = correction;
    auto weak = scene;
    for (auto& set : weak.model.fracture_sets) {
      set.systems[0].law = FrictionLaw::slip_weakening;
      set.systems[0].slip_distance_m = 1e-9;
    }
    expect_same(weak, name_of(correction));
    EXPECT_FALSE(same_bits(undisturbed(weak).samples, undisturbed(scene).samples));
  }
}

TEST(Pauses, ChangeNoBitWhereCellsAreLeftOut) {
  // Without snapshots and cracks cells before the waves and beyond what can be seen are left out.
  auto scene = reef();
  scene.model.fracture_sets.clear();
  scene.model.fracture = {};
  scene.snapshot_every_s = {};
  const auto whole = undisturbed(scene);
  int runs = 0;
  const auto pieces = in_pieces(scene, {2, 1}, 3, runs);
  EXPECT_GT(runs, 5);
  EXPECT_TRUE(same_bits(pieces.samples, whole.samples));
}

TEST(Pauses, ChangeNoBitOfPlaneWaves) {
  for (const char* mechanism : {"plane:0", "plane:20"}) {
    auto scene = reef();
    scene.model.medium = uniform_medium(130, 120, 5, rock);
    const bool vertical = std::string(mechanism) == "plane:0";
    for (std::int64_t k = 80; k < 120 && vertical; ++k)
      for (std::int64_t i = 0; i < 130; ++i) put(scene.model.medium, {i, k}, soft);
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.survey.sources[0].mechanism = parse_mechanism<2>(mechanism);
    scene.survey.sources[0].position_m = {0, 0};
    expect_same(scene, mechanism);
  }
}

TEST(Pauses, ComeBetweenAnyTwoPasses) {
  auto scene = reef();
  scene.snapshot_every_s = {};
  const auto whole = undisturbed(scene);
  for (const int passes : {2, 3, 30}) {
    int runs = 0;
    EXPECT_TRUE(same_bits(in_pieces(scene, {1}, passes, runs).samples, whole.samples));
    EXPECT_GT(runs, passes < 5 ? 10 : 1);
  }
}

}  // namespace
}  // namespace slipwave::solver
