// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic rock in 3-D against sums over plane waves, the solver in 2-D, symmetry and itself.
#include <gtest/gtest.h>

#include "anisotropic_cube.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

/// The rock with two axes exchanged.
Material exchanged(const Material& rock, int one, int other) {
  const auto c = upright_elasticity<3>(rock);
  std::array<int, 3> axis = {0, 1, 2};
  std::swap(axis[std::size_t(one)], axis[std::size_t(other)]);
  const auto normal = [&](std::size_t i, std::size_t j) { return c(axis[i], axis[i], axis[j], axis[j]); };
  const auto shear = [&](std::size_t i, std::size_t j) { return c(axis[i], axis[j], axis[i], axis[j]); };
  return material_of(orthorhombic({normal(0, 0), normal(1, 1), normal(2, 2), shear(1, 2), shear(0, 2),
                                   shear(0, 1), normal(0, 1), normal(0, 2), normal(1, 2)}),
                     rock.rho);
}

// Proves (O3).
TEST(AnisotropicSpace, OfIsotropicRockIsStokesSolution) {
  constexpr RickerForm wavelet{30};
  const Material rock{4500, 2600, 2500};
  const Point<3> r = {71, -42, 55};
  const double distance = std::hypot(r[0], r[1], r[2]), tp = distance / rock.vp, ts = distance / rock.vs;
  const AnisotropicSpace space(rock);
  for (int axis = 0; axis < 3; ++axis) {
    const auto found = space.velocity(r, axis, wavelet, 0.001, 120);
    for (int component = 0; component < 3; ++component) {
      const double along = r[std::size_t(axis)] * r[std::size_t(component)] / (distance * distance);
      const double same = axis == component;
      std::vector<double> wanted;
      for (int n = 0; n < 120; ++n) {
        const double t = n * 0.001;
        const double near =
            tp * wavelet(t - tp) - ts * wavelet(t - ts) + wavelet.integral(t - tp) - wavelet.integral(t - ts);
        wanted.push_back(((3 * along - same) * near / std::pow(distance, 3) +
                          along * wavelet.slope(t - tp) / (rock.vp * rock.vp * distance) -
                          (along - same) * wavelet.slope(t - ts) / (rock.vs * rock.vs * distance)) /
                         (4 * std::numbers::pi * rock.rho));
      }
      EXPECT_LT(relative_error(found[std::size_t(component)], wanted), 1e-4) << axis << component;
    }
  }
}

// Proves (O1).
TEST(AnisotropyInSpace, OfAForceIsThatOfPlaneWavesInAllDirections) {
  const ThreadLimit one_thread(1);
  EXPECT_LT(error_of_a_force(cracked, 16), 0.006);
  if (!long_form()) return;
  for (const auto& rock : {shale, crossed, cracked})
    for (const int order : {5, 7}) {
      EXPECT_LT(error_of_a_force(rock, 16, order), 0.01) << order;
      EXPECT_LT(error_of_a_force(rock, 24, order), 0.005) << order;
    }
}

// Proves (O1), (O4).
TEST(AnisotropyInSpace, OfASliceIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  const auto flat = [](Material rock) {
    rock.gamma = 0, rock.orthorhombic = {};
    return rock;
  };
  // In 2-D the sweeps of a step are others where the plane is not that of x and z, of second order in it.
  const auto error_of = [](Extruded both) {
    if (both.axes != std::array<int, 2>{0, 2}) both.flat.numerics.cfl = both.deep.numerics.cfl = 0.4;
    both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
    return largest_error(both);
  };
  // Each upright plane has its own stiffnesses.
  EXPECT_LT(error_of(slice({0, 2}, cracked, shale, flat(cracked), flat(shale))), 1e-3);
  EXPECT_LT(error_of(slice({1, 2}, cracked, shale, flat(exchanged(cracked, 0, 1)), flat(shale))), 7e-3);
  // Level ones are isotropic, with the speeds along them.
  const auto level = [](const Material& rock) {
    const auto c = upright_elasticity<3>(rock);
    return Material{std::sqrt(c(1, 1) / rock.rho), std::sqrt(c(6, 6) / rock.rho), rock.rho};
  };
  EXPECT_LT(error_of(slice({0, 1}, shale, crossed, level(shale), level(crossed))), 7e-3);
}

/// Blocks of rocks and water under a free surface.
Scene<3> blocks(const std::vector<Material>& rocks, const Index<3>& shape = {40, 34, 36}) {
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[0] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  edges[2][0] = EdgeLaw::free;
  return scene_of(blocks_below_water(rocks, shape, {12, 15, 13}), edges, {92, 71, 92}, "force:1,1,1",
                  "ricker:25", {{140, 131, 120}, {42, 55, 143}},
                  {Component::vx, Component::vy, Component::vz, Component::p}, 0.06, 0.001);
}

// Proves (O1).
TEST(AnisotropyInSpace, IsTurnedWithItsAxes) {
  const ThreadLimit one_thread(1);
  // The experiment with its axes exchanged; sweeps come in another order, of second order in the step.
  const Index<3> shape = {30, 30, 30};
  const auto shot = [&](const Material& rock, const Point<3>& source, const Point<3>& receiver,
                        const char* force) {
    auto scene =
        scene_of(uniform_rock(shape, 5, rock), edges_all_3d(EdgeLaw::rigid), source, force, "ricker:18",
                 {receiver}, {Component::vx, Component::vy, Component::vz}, 0.12, 0.001);
    scene.numerics.cfl = 0.5;
    check(scene);
    return shoot(scene, 1);
  };
  const auto one = shot(cracked, {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  const auto turned = shot(exchanged(cracked, 0, 2), {73, 62, 41}, {128, 102, 111}, "force:0,0,1");
  const auto about_z = shot(exchanged(cracked, 0, 1), {62, 41, 73}, {102, 111, 128}, "force:0,1,0");
  for (const std::size_t n : {0, 1, 2}) {
    EXPECT_LT(relative_error(turned.traces[2 - n].samples, one.traces[n].samples), 0.004) << n;
    EXPECT_LT(relative_error(about_z.traces[n < 2 ? 1 - n : 2].samples, one.traces[n].samples), 0.004) << n;
  }
}

// Proves (O1).
TEST(AnisotropyInSpace, OfNoneIsIsotropicRock) {
  const ThreadLimit one_thread(1);
  const Material hard{3000, 1600, 2300}, soft{2500, 1200, 2100};
  auto scene = blocks({hard, soft, hard});
  const auto found = samples_of(shoot(scene, 1));
  for (const auto property : {Property::epsilon, Property::delta, Property::gamma, Property::epsilon1,
                              Property::delta1, Property::delta3, Property::gamma2})
    scene.model.medium[property] = {};
  const auto isotropic = samples_of(shoot(scene, 1));
  EXPECT_EQ(found, isotropic);  // no cell is anisotropic
  for (const bool orthorhombic : {false, true}) {
    // One cell far away makes the loops those of anisotropic media.
    scene.model.medium[Property::gamma] = Field<3>(scene.model.medium.grid());
    scene.model.medium[orthorhombic ? Property::gamma2 : Property::gamma] =
        Field<3>(scene.model.medium.grid());
    scene.model.medium[orthorhombic ? Property::gamma2 : Property::gamma][scene.model.medium.vp.size() - 1] =
        1e-6F;
    complete_anisotropy(scene.model.medium);
    EXPECT_LT(relative_error(samples_of(shoot(scene, 1)), isotropic), 2e-5);
  }
}

// Proves (O1).
TEST(AnisotropyInSpace, DoesNotDependOnWhichWayItIsShot) {
  const ThreadLimit one_thread(1);
  auto scene = blocks({shale, crossed, cracked}, {44, 40, 42});
  scene.recording.duration_s = 0.12;
  const Point<3> a = {63, 71, 92}, b = {151, 128, 163};
  const auto there = shot_between(scene, a, b, "force:0,1,0"),
             back = shot_between(scene, b, a, "force:0,0,1");
  EXPECT_LT(relative_error(there.traces[2].samples, back.traces[1].samples), 0.03);
}

// Proves (O4).
TEST(AnisotropyInSpace, LeavesStrainsAtAFreeSurfaceThatPutNoTractionOnIt) {
  const ThreadLimit one_thread(1);
  auto scene = scene_of(uniform_rock({30, 30, 20}, 5, cracked), edges_all_3d(EdgeLaw::mirror), {72, 75, 60},
                        "force:0,0,1", "ricker:20", {{95, 105, 0}},
                        {Component::exx, Component::eyy, Component::ezz}, 0.1, 0.001);
  scene.edges[2][0] = EdgeLaw::free;
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto c = upright_elasticity<3>(cracked);
  auto wanted = gather.traces[0].samples;
  for (std::size_t n = 0; n < wanted.size(); ++n)
    wanted[n] = -(c(1, 3) * wanted[n] + c(2, 3) * gather.traces[1].samples[n]) / c(3, 3);
  EXPECT_LT(relative_error(gather.traces[2].samples, wanted), 1e-4);
}

// Proves (O3).
TEST(AnisotropyInSpace, LeavesThroughAPmlWhereWavesTurn) {
  const ThreadLimit one_thread(1);
  // Medium III of Becache, Fauqueux and Joly (2003) in the plane of x and y; those of z are isotropic or
  // nearly.
  const auto rock = material_of(orthorhombic({4e9, 20e9, 20e9, 2e9, 2e9, 2e9, 7.5e9, 6e9, 16e9}), 2500);
  for (const int axis : {0, 1})
    EXPECT_GT(backward_group_velocity(upright_elasticity<3>(rock), axis), 0.1) << axis;
  auto edges = edges_all_3d(EdgeLaw::absorbing);
  edges[2] = {EdgeLaw::mirror, EdgeLaw::mirror};
  auto scene = scene_of(uniform_rock({30, 30, 1}, 25, rock), edges, {375, 375, 12.5}, "force:0.6,0.8,0",
                        "ricker:1", {{405, 405, 12.5}}, {Component::vy}, 1, 0.01);
  scene.recording.duration_s = 6000 * time_step_s(scene);
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto& vy = gather.traces[0].samples;
  double largest = 0, late = 0;
  for (std::size_t n = 0; n < vy.size(); ++n) {
    largest = std::max(largest, std::abs(vy[n]));
    if (n > vy.size() / 2) late = std::max(late, std::abs(vy[n]));
  }
  EXPECT_LT(late, 1e-3 * largest);
}

// Proves (O1).
TEST(EnergyOfAnisotropicSpace, NeverRises) {
  const ThreadLimit one_thread(1);
  // Any stiffness from cell to cell, as different as they can be, and water.
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random_rock = [&]() -> Material {
    for (;;) {
      const auto between = [&](double low, double high) { return low + (high - low) * uniform(engine); };
      const double vp = between(2000, 5000);
      Material rock{vp, vp * between(0.2, 0.7), between(1800, 2800), between(-0.3, 0.6), between(-0.3, 0.6),
                    0,  between(-0.3, 0.6)};
      rock.orthorhombic = {between(-0.3, 0.6), between(-0.3, 0.6), between(-0.3, 0.3), between(-0.3, 0.6)};
      if (!fault_of_anisotropy(rock, true)) return rock;
    }
  };
  for (const int block : {1, 4})
    for (const int order : {block == 1 ? 7 : 3}) {
      const Index<3> shape = {18, 16, 20};
      Medium<3> medium(Grid<3>{shape, 5, {0, 0, 0}});
      medium[Property::epsilon1] = Field<3>(medium.grid());
      complete_anisotropy(medium);
      std::vector<Material> rocks;
      for (int n = 0; n < 8000; ++n)
        rocks.push_back(uniform(engine) < 0.15 ? Material{1500, 0, 1000} : random_rock());
      for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
        const auto at = medium.grid().index(n);
        put(medium, std::size_t(n),
            rocks[std::size_t((at[2] / block * 20 + at[1] / block) * 20 + at[0] / block)]);
      }
      for (const auto law : {EdgeLaw::rigid, EdgeLaw::mirror}) {
        Cube<double> cube(medium, edges_all_3d(law), order, 0.99 * 5 / fastest_speed(medium));
        cube.shake(8);
        double least = cube.energy();
        for (int n = 0; n < 60; ++n) {
          cube.steps(n < 40 ? 1 : 5);
          const double now = cube.energy();
          ASSERT_LT(now, least * (1 + 1e-11)) << "order " << order << ", block " << block << ", step " << n;
          least = now;
        }
        EXPECT_GT(least, 0);
      }
    }
}

// Proves (O1).
TEST(EnergyOfAnisotropicSpace, BetweenFreeEdgesFallsInTheLongRun) {
  const ThreadLimit one_thread(1);
  const Index<3> shape = {24, 22, 26};
  for (const auto& rock : {cracked, crossed})
    for (const bool sea : {false, true}) {
      auto medium = uniform_rock(shape, 5, rock);
      for (std::int64_t n = 0; sea && n < medium.grid().size(); ++n)
        if (medium.grid().index(n)[2] < 13) put(medium, std::size_t(n), Material{1500, 0, 1000});
      Cube<double> cube(medium, edges_all_3d(EdgeLaw::free), 5, 0.99 * 5 / fastest_speed(medium));
      cube.shake(8);
      double least = cube.energy();
      const double first = least;
      for (int n = 0; n < 20; ++n) {
        cube.steps(20);
        const double now = cube.energy();
        EXPECT_LT(now, least * 1.002) << n;
        least = std::min(least, now);
      }
      EXPECT_LT(least, 0.5 * first);
    }
}

}  // namespace
}  // namespace slipwave::solver
