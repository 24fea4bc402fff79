// SPDX-License-Identifier: BSD-3-Clause
// Rock in 3-D whose axes are tilted against sums over plane waves, the solver in 2-D, symmetry and itself.
#include <gtest/gtest.h>

#include "anisotropic_cube.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

/// Whose waves do not turn, either: layers damp less in 2-D, where fewer directions count.
const Material stiff{3600, 1900, 2450, 0.15, 0.1, 0, 0.1};

// Proves (O6).
TEST(TiltedSpace, HasTheStiffnessOfTurnedAxes) {
  // All indices of C_ijkl turned one after another about the axes of the grid.
  for (const auto& rock :
       {turned_by(shale, 30, 0), turned_by(shale, -20, 70), turned_by(cracked, 40, 25, -50)}) {
    const auto c = elasticity_of<3>(rock);
    const AnisotropicSpace other(rock);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        EXPECT_NEAR(c.voigt[i][j], other.stiffness(i, j), 1e-9 * c.voigt[2][2]);
  }
  // Towards +x it is that of the plane.
  const auto rock = turned_by(shale, 30, 0);
  const auto c = elasticity_of<3>(rock).voigt;
  const auto plane = elasticity_of<2>(rock);
  EXPECT_NEAR(c[0][0], plane(1, 1), 1);
  EXPECT_NEAR(c[0][2], plane(1, 3), 1);
  EXPECT_NEAR(c[0][4], plane(1, 5), 1);
  EXPECT_NEAR(c[2][2], plane(3, 3), 1);
  EXPECT_NEAR(c[2][4], plane(3, 5), 1);
  EXPECT_NEAR(c[4][4], plane(5, 5), 1);
  // Waves of directions out of it turn more.
  const auto turning = turned_by(crossed, 30, 0);
  EXPECT_GT(backward_group_velocity(elasticity_of<3>(turning), 2),
            backward_group_velocity(elasticity_of<2>(turning), 1));
}

// Proves (O7).
TEST(TiltedSpace, HasTheWavesOfUprightRockAboutItsAxes) {
  const auto rock = turned_by(cracked, 40, 25, -50);
  const auto axes = axes_of<3>(rock);
  const auto c = elasticity_of<3>(rock);
  const Point<3> own = {0.48, 0.6, 0.64};
  Point<3> n{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 3; ++a) n[i] += own[a] * axes[a][i];
  const auto found = phase_speeds<3>(c, rock.rho, n),
             wanted = phase_speeds<3>(upright_elasticity<3>(cracked), rock.rho, own);
  for (std::size_t wave = 0; wave < 3; ++wave) EXPECT_NEAR(found[wave], wanted[wave], 1e-6);
  // Motions solve the Christoffel equation, and stresses of strains have their energy.
  const auto waves = slipwave::waves_along<3>(c, n);
  for (std::size_t wave = 0; wave < 3; ++wave)
    for (int i = 0; i < 3; ++i) {
      double sum = 0;
      for (int m = 0; m < 81; ++m) {
        const int j = m / 27, k = m / 9 % 3, l = m / 3 % 3;
        if (m % 3 == 0)
          sum += c(i, j, k, l) * n[std::size_t(j)] * n[std::size_t(l)] * waves.vectors[wave][std::size_t(k)];
      }
      EXPECT_NEAR(sum, waves.values[wave] * waves.vectors[wave][std::size_t(i)], 1e-6 * waves.values[0]);
    }
  const std::array<double, 6> strain = {1e-3, -2e-3, 3e-3, 4e-3, -1e-3, 2e-3};
  std::array<double, 6> stress{};
  double energy = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) stress[i] += c.voigt[i][j] * strain[j];
    energy += stress[i] * strain[i];
  }
  std::swap(stress[3], stress[5]);  // as SymmetricTensor has them
  EXPECT_NEAR(complementary<3>(c, stress), energy, 1e-9 * energy);
}

// Proves (O8).
TEST(TiltedSpace, OfAForceIsThatOfPlaneWavesInAllDirections) {
  const ThreadLimit one_thread(1);
  EXPECT_LT(error_of_a_force(turned_by(shale, 30, 90), 12), 0.02);
  if (!long_form()) return;
  EXPECT_LT(error_of_a_force(turned_by(shale, 30, 90), 24), 0.004);
  for (const auto& rock :
       {turned_by(shale, 30, 90), turned_by(crossed, -50, 35), turned_by(cracked, 40, 25, -50)})
    EXPECT_LT(error_of_a_force(rock, 16), 0.01) << rock.tilt;
}

// Proves (O8), (O9).
TEST(TiltedSpace, OfASliceIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  const auto error_of = [](Extruded both) {
    if (both.axes != std::array<int, 2>{0, 2}) both.flat.numerics.cfl = both.deep.numerics.cfl = 0.4;
    both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
    return largest_error(both);
  };
  const auto flat = [](Material rock) {
    rock.gamma = 0, rock.azimuth = 0;
    return rock;
  };
  // Below water and a free surface; the plane of y and z is that of x and z.
  for (const double azimuth : long_form() ? std::vector{0., 90.} : std::vector{0.}) {
    const auto upper = turned_by(shale, 30, azimuth), lower = turned_by(stiff, -55, azimuth);
    EXPECT_LT(error_of(slice({azimuth > 0 ? 1 : 0, 2}, upper, lower, flat(upper), flat(lower))),
              azimuth > 0 ? 7e-3 : 1e-3)
        << azimuth;
  }
}

// Proves (O8).
TEST(TiltedSpace, IsTurnedWithItsAxes) {
  const ThreadLimit one_thread(1);
  // About the vertical by a right angle, below a free surface: x becomes y, and y becomes -x.
  const auto shot = [&](const Material& rock, const Point<3>& source, const Point<3>& receiver,
                        const char* force) {
    auto edges = edges_all_3d(EdgeLaw::rigid);
    edges[2][0] = EdgeLaw::free;
    auto scene = scene_of(uniform_rock({30, 30, 30}, 5, rock), edges, source, force, "ricker:18", {receiver},
                          {Component::vx, Component::vy, Component::vz}, 0.09, 0.001);
    scene.numerics.cfl = 0.5;
    check(scene);
    return shoot(scene, 1);
  };
  const auto one = shot(turned_by(cracked, 25, 35, 50), {41, 62, 33}, {111, 102, 12}, "force:1,0,0");
  const auto turned = shot(turned_by(cracked, 25, 125, 50), {88, 41, 33}, {48, 111, 12}, "force:0,1,0");
  auto minus = turned.traces[0].samples;
  for (auto& value : minus) value = -value;
  EXPECT_LT(relative_error(turned.traces[1].samples, one.traces[0].samples), 0.005);
  EXPECT_LT(relative_error(minus, one.traces[1].samples), 0.005);
  EXPECT_LT(relative_error(turned.traces[2].samples, one.traces[2].samples), 0.005);
  // A right angle of the tilt lays axes along the grid: no cell is tilted.
  const auto lying = shot(turned_by(shale, 90, 0), {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  const auto c = elasticity_of<3>(turned_by(shale, 90, 0)).along_grid();
  const auto upright = shot(material_of(c, shale.rho), {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  for (const std::size_t n : {0, 1, 2})
    EXPECT_LT(relative_error(lying.traces[n].samples, upright.traces[n].samples), 1e-4) << n;
}

/// Blocks of rocks, water above, under a free surface.
Scene<3> blocks(const std::vector<Material>& rocks, const Index<3>& shape) {
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[0] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  edges[2][0] = EdgeLaw::free;
  return scene_of(blocks_below_water(rocks, shape, {12, 15, 13}), edges, {92, 71, 92}, "force:1,1,1",
                  "ricker:25", {{140, 101, 110}, {42, 55, 123}},
                  {Component::vx, Component::vy, Component::vz, Component::p}, 0.06, 0.001);
}
const std::vector<Material> tilted_rocks = {turned_by(shale, 30, 20),
                                            {2900, 1500, 2200},
                                            turned_by(cracked, -40, 60, 15),
                                            turned_by(crossed, 70, -30)};

// Proves (O8).
TEST(TiltedSpace, OfNextToNoneIsIsotropicRock) {
  const ThreadLimit one_thread(1);
  // Swept as tilted rock all the same.
  Material rock{3000, 1600, 2300};
  auto scene = blocks({rock}, {40, 30, 32});
  const auto isotropic = samples_of(shoot(scene, 1));
  rock.epsilon = 1e-8, rock = turned_by(rock, 30, 20);
  scene.model.medium = blocks({rock}, {40, 30, 32}).model.medium;
  EXPECT_LT(relative_error(samples_of(shoot(scene, 1)), isotropic), 3e-5);
}

// Proves (O8).
TEST(TiltedSpace, DoesNotDependOnWhichWayItIsShot) {
  const ThreadLimit one_thread(1);
  auto scene = blocks(tilted_rocks, {34, 30, 32});
  scene.recording.duration_s = 0.08;
  const Point<3> a = {63, 71, 92}, b = {141, 118, 143};
  const auto there = shot_between(scene, a, b, "force:0,1,0"),
             back = shot_between(scene, b, a, "force:0,0,1");
  EXPECT_LT(relative_error(there.traces[2].samples, back.traces[1].samples), 0.04);
}

// Proves (O9).
TEST(TiltedSpace, LeavesStrainsAtAFreeSurfaceThatPutNoTractionOnIt) {
  const ThreadLimit one_thread(1);
  const auto rock = turned_by(cracked, 30, 40, 20);
  auto scene = scene_of(
      uniform_rock({28, 28, 20}, 5, rock), edges_all_3d(EdgeLaw::rigid), {62, 65, 50}, "force:0,0,1",
      "ricker:20", {{85, 80, 0}},
      {Component::exx, Component::eyy, Component::ezz, Component::eyz, Component::exz, Component::exy}, 0.08,
      0.001);
  scene.edges[2][0] = EdgeLaw::free;
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto c = elasticity_of<3>(rock).voigt;
  for (const std::size_t traction : {2, 3, 4}) {
    double sum = 0, size = 0;
    for (std::size_t n = 0; n < gather.traces[0].samples.size(); ++n) {
      double of_sample = 0;
      for (std::size_t k = 0; k < 6; ++k)
        of_sample += c[traction][k] * (k < 3 ? 1 : 2) * gather.traces[k].samples[n];
      sum += of_sample * of_sample, size += std::pow(c[2][2] * gather.traces[2].samples[n], 2);
    }
    EXPECT_LT(std::sqrt(sum / size), 1e-4) << traction;
  }
}

// Proves (O9).
TEST(TiltedSpace, LeavesThroughAPmlWhereWavesTurn) {
  const ThreadLimit one_thread(1);
  // Medium III of Becache, Fauqueux and Joly (2003), tilted in a slice of the plane of x and z.
  auto rock = material_of(vertical_symmetry(4e9, 7.5e9, 20e9, 2e9), 2500);
  rock.gamma = -0.25;
  rock = turned_by(rock, 35, 0);
  for (const int axis : {0, 2}) EXPECT_GT(backward_group_velocity(elasticity_of<3>(rock), axis), 0.1) << axis;
  auto edges = edges_all_3d(EdgeLaw::absorbing);
  edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
  auto scene = scene_of(uniform_rock({8, 1, 8}, 25, rock), edges, {100, 12.5, 100}, "force:0.6,0,0.8",
                        long_form() ? "ricker:1" : "ricker:2", {{130, 12.5, 130}}, {Component::vx}, 1, 0.01);
  scene.recording.duration_s = (long_form() ? 12000 : 450) * time_step_s(scene);
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto& vx = gather.traces[0].samples;
  double largest = 0, late = 0;
  for (std::size_t n = 0; n < vx.size(); ++n) {
    largest = std::max(largest, std::abs(vx[n]));
    if (n > vx.size() * 3 / 4) late = std::max(late, std::abs(vx[n]));
  }
  EXPECT_LT(late, (long_form() ? 1e-3 : 0.03) * largest);
}

/// Energy of rocks that lie in cubes of so many cells, after steps in turn, never above what it was.
void expect_no_growth(const std::function<Material()>& draw, int block, int order, EdgeLaw law, int steps) {
  const Index<3> shape = {16, 14, 15};
  Medium<3> medium(Grid<3>{shape, 5, {0, 0, 0}});
  for (const auto property : {Property::epsilon1, Property::tilt, Property::azimuth, Property::rotation})
    medium[property] = Field<3>(medium.grid());
  complete_anisotropy(medium);
  std::vector<Material> rocks;
  for (int n = 0; n < 4096; ++n) rocks.push_back(draw());
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    put(medium, std::size_t(n),
        rocks[std::size_t((at[2] / block * 16 + at[1] / block) * 16 + at[0] / block)]);
  }
  Cube<double> cube(medium, edges_all_3d(law), order, 0.99 * 5 / fastest_speed(medium));
  cube.shake(8);
  double least = cube.energy();
  const int groups = 20;
  for (int n = 0; n < groups; ++n) {
    cube.steps(steps / groups);
    const double now = cube.energy();
    ASSERT_LT(now, least * (1 + (law == EdgeLaw::free ? 2e-3 : 1e-11)))
        << "order " << order << ", block " << block << ", part " << n;
    least = std::min(least, now);
  }
  EXPECT_GT(least, 0);
}

// Proves (O8).
TEST(EnergyOfTiltedSpace, NeverRises) {
  const ThreadLimit one_thread(1);
  // Any stiffness about any axes from cell to cell, or from block to block, and water.
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(engine); };
  const auto any = [&]() -> Material {
    if (uniform(engine) < 0.15) return {1500, 0, 1000};
    for (;;) {
      const double vp = between(2500, 4500);
      Material rock{vp, vp * between(0.4, 0.6), between(2000, 2600), between(-0.2, 0.4), between(-0.2, 0.4),
                    0,  between(-0.2, 0.4)};
      rock.orthorhombic = {between(-0.2, 0.4), between(-0.2, 0.4), between(-0.2, 0.2), between(-0.2, 0.4)};
      if (!fault_of_anisotropy(rock, true))
        return turned_by(rock, between(-90, 90), between(-180, 180), between(-180, 180));
    }
  };
  for (const int block : {1, 4})
    for (const int order : long_form() ? std::vector{3, 5, 7, 11} : std::vector{block == 1 ? 7 : 5})
      for (const auto law : {EdgeLaw::rigid, EdgeLaw::mirror, EdgeLaw::free}) {
        if (!long_form() && law == EdgeLaw::mirror && block == 4) continue;
        expect_no_growth(any, block, order, law, long_form() ? 4000 : 60);
      }
}

}  // namespace
}  // namespace slipwave::solver
