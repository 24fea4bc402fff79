// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>

#include "cube_shot.hpp"
#include "lab.hpp"
#include "solver/shot_simulation.hpp"

// Models that are all fluid, whose state holds one stress and whose sweeps are of P waves alone.
namespace slipwave::solver::fluid_test {
namespace {

constexpr Rock water{1500, 0, 1000}, brine{2000, 0, 1300};

/// Rock of one cell in a lower corner makes the state hold all stresses. No wave comes there.
enum class Corner { fluid, rock };

template <int D>
void set_corner(Scene<D>& scene, Corner corner) {
  Index<D> last = scene.model.grid().shape;
  for (auto& n : last) --n;
  put(scene.model.medium, last, Rock{2000, corner == Corner::rock ? 900. : 0, 1300});
}

/// A sea with a void, over brine.
Scene<2> sea(Corner corner = Corner::fluid) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(330, 150, 5, water);
  for (std::int64_t k = 0; k < 150; ++k)
    for (std::int64_t i = 0; i < 330; ++i) {
      if (k > 50 + i / 40) put(scene.model.medium, {i, k}, brine);
      if (i >= 60 && i < 64 && k >= 20 && k < 30) put(scene.model.medium, {i, k}, {0, 0, 0});
    }
  set_corner(scene, corner);
  scene.survey.sources = {{{303, 161}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e9}};
  scene.survey.receivers_m = {{212, 3}, {402.5, 201.3}, {403, 333}, {270, 162}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p, Component::sxx, Component::szz,
                      Component::sxz, Component::div},
                     0.2,
                     0.001};
  return scene;
}

Scene<3> pool(Corner corner = Corner::fluid) {
  auto scene =
      scene_of(uniform_cube({48, 40, 44}, 5, water), edges_all_3d(EdgeLaw::absorbing), {83, 81, 72},
               "explosion", "ricker:30", {{122, 43, 51}, {61.5, 112, 121}},
               {Component::vy, Component::p, Component::sxx, Component::syy, Component::szz}, 0.1, 0.001);
  scene.edges[2][0] = EdgeLaw::free;
  set_corner(scene, corner);
  return scene;
}

template <int D>
std::int64_t memory_of(const Scene<D>& scene) {
  return ShotSimulation<D, float>(scene, 1, {}).memory_bytes();
}

/// Expects the traces of both to differ by rounding, and those of shear stress to be zero.
template <int D>
void expect_alike(Scene<D> (*make)(Corner), const std::function<void(Scene<D>&)>& change) {
  auto fluid = make(Corner::fluid), rock = make(Corner::rock);
  change(fluid), change(rock);
  ASSERT_LT(memory_of(fluid), 0.8 * double(memory_of(rock)));
  const auto found = shoot(fluid, 1), all = shoot(rock, 1);
  ASSERT_EQ(found.traces.size(), all.traces.size());
  for (std::size_t n = 0; n < found.traces.size(); ++n) {
    double largest = 0;
    for (const double sample : found.traces[n].samples) largest = std::max(largest, std::abs(sample));
    const bool shear = D == 2 && n / fluid.survey.receivers_m.size() == 5;
    EXPECT_EQ(largest == 0, shear) << n;
    if (shear) continue;
    EXPECT_LT(relative_error(found.traces[n].samples, all.traces[n].samples), 2e-5) << n;
  }
}

TEST(Fluid, OfOneStressRecordsWhatAllStressesDo) {
  const auto in_2d = [](const char* name, const std::function<void(Scene<2>&)>& change) {
    SCOPED_TRACE(name);
    expect_alike<2>(sea, change);
  };
  in_2d("explosion", [](auto&) {});
  in_2d("force", [](auto& scene) { scene.survey.sources[0].mechanism = parse_mechanism<2>("force:1,2"); });
  in_2d("moment",
        [](auto& scene) { scene.survey.sources[0].mechanism = parse_mechanism<2>("moment:1,1,0"); });
  in_2d("order 7, 4 in time", [](auto& scene) { scene.numerics.order = 7, scene.numerics.time_order = 4; });
  in_2d("attenuation", [](auto& scene) {
    auto& medium = scene.model.medium;
    medium[Property::qp] = Field<2>(medium.grid(), 40.F);
    set_attenuation(scene);
  });
  expect_alike<3>(pool, [](auto&) {});
}

TEST(Fluid, NeedsLessMemoryThanRock) {
  auto scene = sea();
  const auto fluid = memory_of(scene);
  scene.model.medium = uniform_medium(330, 150, 5, {2000, 900, 1300});
  EXPECT_LE(double(fluid), 0.65 * double(memory_of(scene)));
  auto cube = pool();
  const auto in_3d = memory_of(cube);
  cube.model.medium = uniform_cube({48, 40, 44}, 5, {2000, 900, 1300});
  EXPECT_LE(double(in_3d), 0.6 * double(memory_of(cube)));
}

}  // namespace
}  // namespace slipwave::solver::fluid_test
