// SPDX-License-Identifier: BSD-3-Clause
// Plane waves in anisotropic rock of 3-D: against the Christoffel equation, the solver in 2-D, the same
// experiment turned, and themselves in wider models.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "anisotropic_cube.hpp"
#include "model/space_motion.hpp"
#include "plain_and_tiled.hpp"

namespace slipwave::solver {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Proves (A18).
TEST(SpaceLayerWaves, SolveTheChristoffelEquationAndGoTheWayTheyShould) {
  using Complex = std::complex<double>;
  const std::array<double, 2> along = {1.2e-4, -0.9e-4};
  for (const auto& rock : {Material{3000, 1600, 2300}, shale, turned_by(shale, 30, 40),
                           turned_by(cracked, 0, 35), turned_by(cracked, 40, 25, -50)}) {
    const auto stiffness = elasticity_of<3>(rock);
    const double modulus = stiffness.voigt[2][2];
    for (const bool down : {true, false}) {
      const auto waves = layer_waves(rock, along, down);
      ASSERT_EQ(waves.size(), 3U);
      for (const auto& wave : waves) {
        const std::array<Complex, 3> slowness = {along[0], along[1], wave.down};
        const auto stress = stress_of_motion<3, Complex>(stiffness, slowness, wave.motion);
        // rho v' = div s of f(t - p.x): rho v = -s p.
        Complex power = 0;
        double size = 0;
        for (int i = 0; i < 3; ++i) {
          Complex force = 0;
          for (int j = 0; j < 3; ++j) force += stress[Elasticity<3>::pair(i, j)] * slowness[std::size_t(j)];
          EXPECT_LT(std::abs(rock.rho * wave.motion[std::size_t(i)] + force), 1e-6 * rock.rho) << rock.tilt;
          power -= std::conj(wave.motion[std::size_t(i)]) * stress[Elasticity<3>::pair(i, 2)];
          size += std::norm(wave.motion[std::size_t(i)]);
        }
        EXPECT_NEAR(size, 1, 1e-9);
        const double sign = down ? 1 : -1;
        if (std::abs(wave.down.imag()) > 0)
          EXPECT_LT(sign * wave.down.imag(), 0);
        else
          EXPECT_GT(sign * power.real(), -1e-9 * std::sqrt(modulus * rock.rho));
      }
    }
  }
}

// Proves (A18).
TEST(SpaceLayerWaves, OfLevelBedsAreThoseOfAnyStiffnessThatIsNextToThem) {
  const std::array<double, 2> along = {1.2e-4, -0.9e-4};
  const auto level = layer_waves(shale, along, true),
             any = layer_waves(turned_by(shale, 1e-5, 20), along, true);
  for (const auto& wave : level) {
    double nearest = 1;
    for (const auto& other : any) nearest = std::min(nearest, std::abs(other.down - wave.down));
    EXPECT_LT(nearest, 1e-9);
  }
}

/// A plane wave down through a box that absorbs on all sides, of one rock or two.
Scene<3> box(const Material& upper, const Material& lower, std::int64_t across, const std::string& kind,
             double duration_s) {
  constexpr std::int64_t deep = 32;
  constexpr double h = 5;
  Medium<3> medium(
      Grid<3>{{across, across, deep}, h, {-0.5 * h * double(across), -0.5 * h * double(across), 0}});
  medium[Property::epsilon1] = Field<3>(medium.grid());
  add_angles(medium, {upper, lower});
  complete_anisotropy(medium);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n)
    put(medium, std::size_t(n), medium.grid().index(n)[2] < deep / 2 ? upper : lower);
  auto scene = scene_of(std::move(medium), edges_all_3d(EdgeLaw::absorbing), {0, 0, -60}, kind.c_str(),
                        "ricker:25", {{-21, 14, 33}, {24, -13, 71}, {6, 22, 118}, {-12, -8, 142}},
                        {Component::vx, Component::vy, Component::vz}, duration_s, 0.001);
  scene.survey.sources[0].amplitude = 1;
  scene.numerics.order = 7;
  scene.numerics.zone_cells = 10;
  return scene;
}

// Proves (A19).
TEST(AnisotropicPlaneWaveInSpace, GoesThroughARockUndisturbed) {
  const ThreadLimit one_thread(1);
  for (const auto& rock : {shale, turned_by(cracked, 40, 25, -50)})
    for (const bool shear : {false, true}) {
      if (!long_form() && shear != (rock == shale)) continue;
      constexpr double angle = 25, azimuth = 40;
      auto scene =
          box(rock, rock, 12, (shear ? "plane-s:25," : "plane:25,") + std::string("40"), shear ? 0.24 : 0.15);
      check(scene);
      const Point<3> direction = {std::sin(angle * degree) * std::cos(azimuth * degree),
                                  std::sin(angle * degree) * std::sin(azimuth * degree),
                                  std::cos(angle * degree)};
      // Moduli and motions by the Christoffel equation of the nine or more stiffnesses.
      const auto waves = slipwave::waves_along<3>(elasticity_of<3>(rock), direction);
      const Point<3> usual = {std::cos(angle * degree) * std::cos(azimuth * degree),
                              std::cos(angle * degree) * std::sin(azimuth * degree),
                              -std::sin(angle * degree)};
      const auto share = [&](std::size_t wave, const Point<3>& of) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) sum += waves.vectors[wave][axis] * of[axis];
        return sum;
      };
      const std::size_t wave = !shear ? 0 : std::abs(share(1, usual)) > std::abs(share(2, usual)) ? 1 : 2;
      const double sign = share(wave, shear ? usual : direction) < 0 ? -1 : 1,
                   c = std::sqrt(waves.values[wave] / rock.rho);
      const auto gather = shoot(scene, 1);
      const auto& at = scene.survey.receivers_m;
      std::vector<double> found = samples_of(gather), wanted;
      for (std::size_t n = 0; n < gather.traces.size(); ++n)
        for (std::size_t k = 0; k < std::size_t(gather.axis.count); ++k) {
          const auto& place = at[n % at.size()];
          const double later =
              (direction[0] * place[0] + direction[1] * place[1] + direction[2] * (place[2] + 60)) / c;
          wanted.push_back(sign * waves.vectors[wave][n / at.size()] *
                           scene.survey.sources[0].wavelet(double(k) * 0.001 - later));
        }
      EXPECT_LT(relative_error(found, wanted), shear ? 0.05 : 0.01) << rock.tilt << shear;
    }
}

// Proves (A19).
TEST(AnisotropicPlaneWaveInSpace, OfASliceIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  auto upper = turned_by(shale, 30, 0), lower = turned_by({3600, 1900, 2450, 0.15, 0.1}, -50, 0);
  upper.gamma = 0;
  for (const auto& kind : {"plane:20", "plane-s:-25"}) {
    Scene<2> flat;
    const Grid<2> grid{{50, 40}, 5, {0, 0}};
    flat.model.medium = Medium<2>(grid);
    for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
      flat.model.medium[property] = Field<2>(grid);
    Medium<3> medium(Grid<3>{{50, 1, 40}, 5, {0, 0, 0}});
    medium[Property::epsilon] = Field<3>(medium.grid());
    medium[Property::tilt] = Field<3>(medium.grid());
    complete_anisotropy(medium);
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const auto& rock = n / 50 < 20 ? upper : lower;
      put(flat.model.medium, std::size_t(n), rock), put(medium, std::size_t(n), rock);
    }
    flat.survey.sources = {{{125, -60}, parse_mechanism<2>(kind), parse_wavelet("ricker:25"), 1}};
    flat.survey.receivers_m = {{101, 33}, {152, 122}, {131, 181}};
    flat.edges = edges_all(EdgeLaw::absorbing);
    flat.recording = {{Component::vx, Component::vz}, 0.2, 0.001};
    auto edges = edges_all_3d(EdgeLaw::absorbing);
    edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
    auto deep = scene_of(std::move(medium), edges, {125, 2.5, -60}, kind, "ricker:25",
                         {{101, 2.5, 33}, {152, 2.5, 122}, {131, 2.5, 181}}, {Component::vx, Component::vz},
                         0.2, 0.001);
    deep.survey.sources[0].amplitude = 1;
    flat.numerics.double_precision = deep.numerics.double_precision = true;
    flat.numerics.cfl = deep.numerics.cfl = 0.6;
    check(flat), check(deep);
    EXPECT_LT(relative_error(samples_of(shoot(deep, 1)), samples_of(shoot(flat, 1))), 2e-4) << kind;
  }
}

// Proves (A19).
TEST(AnisotropicPlaneWaveInSpace, InLayersIsTheSameHoweverWideTheModelIs) {
  const ThreadLimit one_thread(1);
  // Whatever the interface makes of it must enter by the sides as the grid has it inside.
  for (const std::string kind : {"plane:25,40", "plane-s:-20,110"}) {
    if (!long_form() && kind[5] == '-') continue;
    const auto shot = [&](std::int64_t across) {
      auto scene = box(turned_by(cracked, 40, 25, -50), shale, across, kind, long_form() ? 0.2 : 0.16);
      check(scene);
      return samples_of(shoot(scene, 1));
    };
    const auto narrow = shot(long_form() ? 12 : 10), wide = shot(long_form() ? 40 : 16);
    EXPECT_LT(relative_error(narrow, wide), 0.015) << kind;
  }
}

// Proves (A19).
TEST(AnisotropicPlaneWaveInSpace, IsTurnedWithItsRock) {
  const ThreadLimit one_thread(1);
  // About the vertical by a right angle: x becomes y, and y becomes -x.
  const auto shot = [&](double turn_deg) {
    auto scene = box(turned_by(cracked, 40, 25 + turn_deg, -50), turned_by(shale, 20, 70 + turn_deg), 10,
                     "plane:25," + std::to_string(40 + turn_deg), long_form() ? 0.12 : 0.07);
    scene.survey.receivers_m =
        turn_deg == 0 ? std::vector<Point<3>>{{-12, 14, 71}} : std::vector<Point<3>>{{-14, -12, 71}};
    scene.numerics.cfl = 0.4;
    check(scene);
    return samples_of(shoot(scene, 1));
  };
  const auto one = shot(0), turned = shot(90);
  const auto count = one.size() / 3;
  auto back = turned;
  for (std::size_t n = 0; n < count; ++n) back[n] = turned[count + n], back[count + n] = -turned[n];
  EXPECT_LT(relative_error(back, one), 0.01);
}

}  // namespace
}  // namespace slipwave::solver
