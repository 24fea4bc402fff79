// Fractures on faces between cells: who computes them makes no difference (docs/theory.md 2.8).
#include <gtest/gtest.h>

#include <limits>

#include "continued.hpp"
#include "model/single_fracture.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void add(Model<2>& model, double normal, double tangential, std::vector<FractureTrace<2>> traces) {
  SlipSystem<2> system{normal_between_tips(traces.front()), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {normal, tangential, 0, 0, 0};
  add_single_fractures(model, {"faces", {system}, std::move(traces), true});
}

/// Two rocks, with cracks that cross, end between faces and lie on the interface, beside a cluster of
/// springs.
Scene<2> cracked() {
  constexpr Rock rock{4500, 2250, 2500}, soft{2500, 1200, 2000};
  constexpr std::int64_t nx = 96, nz = 160;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  for (std::int64_t k = 100; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(scene.model.medium, {i, k}, soft);
  add(scene.model, infinite, infinite, {{{152, 300}, {301, 300}}, {{220, 141}, {220, 420}}});
  add(scene.model, 0, infinite, {{{80, 500}, {390, 500}}});
  add(scene.model, 2e-9, 1e-9, {{{330, 90}, {330, 700}}, {{100, 200}, {200, 200}}});
  scene.survey.sources = {{{203, 261}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 33}, {402.5, 201.3}, {220, 400}, {227, 703.3}, {33, 641}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.order = 7;
  scene.recording = {{Component::vx, Component::vz, Component::sxz}, 0.12, 0.001};
  return scene;
}

TEST(FractureOnFaces, GivesTheBitsOfThePlainExecutorInTiles) {
  auto scene = cracked();
  scene.slip_diary = true;
  expect_same(scene);
  scene.numerics.order = 1;
  scene.numerics.double_precision = true;
  scene.recording.duration_s = 0.06;
  expect_same(scene);
}

TEST(FractureOnFaces, IsTheSameOnSeveralRanks) {
  const auto scene = cracked();
  const auto alone = all_samples(shoot(scene, 1));
  for (const int count : {2, 3})
    EXPECT_TRUE(all_samples(shared_out(scene, count, 2)) == alone) << count << " ranks";
  auto whole = scene;
  whole.with_slip = false;
  EXPECT_FALSE(all_samples(shoot(whole, 1)) == alone);
}

TEST(FractureOnFaces, ContinuesFromACheckpoint) { expect_to_continue(cracked()); }

TEST(FractureOnFaces, IsTheSameInSingleAndDoublePrecision) {
  auto scene = cracked();
  scene.recording.duration_s = 0.3;
  const auto single = all_samples(shoot(scene, 1));
  scene.numerics.double_precision = true;
  const auto precise = all_samples(shoot(scene, 1));
  // Stresses and velocities have scales of their own: each by the largest of its trace.
  const std::size_t a_trace = precise.size() / 15;
  for (std::size_t n = 0; n < precise.size(); n += a_trace) {
    double off = 0, largest = 0;
    for (auto k = n; k < n + a_trace; ++k) {
      off = std::max(off, std::abs(single[k] - precise[k]));
      largest = std::max(largest, std::abs(precise[k]));
    }
    EXPECT_LT(off, 1e-4 * largest) << n / a_trace;
  }
}

}  // namespace
}  // namespace slipwave::solver
