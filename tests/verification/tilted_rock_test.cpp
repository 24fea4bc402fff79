// SPDX-License-Identifier: BSD-3-Clause
// Waves in rock whose axis of symmetry is tilted, against plane-wave (wave number) solutions and symmetry.
#include <gtest/gtest.h>

#include <cstdlib>

#include "anisotropic_scene.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

/// Shales whose beds dip, one with epsilon below delta, a hard one, and what lies upright.
constexpr Material dipping{3000, 1600, 2300, 0.2, 0.1, 30}, steep{3200, 1700, 2400, -0.05, 0.2, -60},
    hard{4200, 2300, 2600, 0.1, 0.15, 15}, flat{3100, 1650, 2350, 0.15, 0.05}, water{1500, 0, 1000};

/// A scene, turned.
struct Turned {
  double cosine, sine;
  explicit Turned(double degrees)
      : cosine(std::cos(degrees * std::numbers::pi / 180)),
        sine(std::sin(degrees * std::numbers::pi / 180)) {}
  std::array<double, 2> operator()(double x, double z) const {
    return {cosine * x - sine * z, sine * x + cosine * z};
  }
};

// Proves (T4).
TEST(TiltedStack, OfATurnedRockIsTheTurnedField) {
  // The same rock by both kinds of roots: in axes of its beds, and in those of the grid.
  const Turned turned(30);
  auto upright = dipping;
  upright.tilt = 0;
  AnisotropicStack beds{{layer_of(upright)}, {}}, grid{{layer_of(dipping)}, {}};
  beds.force = {0.6, 0.8};
  grid.force = turned(0.6, 0.8);
  std::vector<AnisotropicStack::Receiver> along_beds = {{0, 200}, {-160, 90}}, along_grid;
  for (const auto& at : along_beds) {
    const auto [x, z] = turned(at.x, at.z);
    along_grid.push_back({x, z});
  }
  const auto one = beds.ricker(peak_hz, 0.001, 250, along_beds),
             other = grid.ricker(peak_hz, 0.001, 250, along_grid);
  for (std::size_t r = 0; r < along_beds.size(); ++r) {
    std::vector<double> found, wanted;
    for (std::size_t n = 0; n < 250; ++n) {
      const auto [vx, vz] = turned(one[r][0][n], one[r][1][n]);
      wanted.insert(wanted.end(), {vx, vz});
      found.insert(found.end(), {other[r][0][n], other[r][1][n]});
    }
    EXPECT_LT(relative_error(found, wanted), 1e-4) << r;
  }
}

// Proves (T4).
TEST(TiltedRock, OfPointSourcesIsThatOfPlaneWavesInAllDirections) {
  for (const auto& rock : {dipping, steep})
    for (const std::string kind : {"force:0.6,0.8", "explosion", "moment:0,0,1"}) {
      if (!std::getenv("SLIPWAVE_LONG") && (rock == steep || kind == "explosion")) continue;
      Stack space;
      space.layers = {rock}, space.kind = kind;
      space.source_m = 500 + space.spacing() / 2, space.receivers = around(space.source_m, 350);
      EXPECT_LT(space.error(), 0.008) << rock.tilt << ' ' << kind;
    }
}

// Proves (T4).
TEST(TiltedRock, OfTwoRocksReflectsAndTransmitsAsPlaneWaves) {
  for (const auto& [over, under] : {std::pair{dipping, hard}, {steep, dipping}, {flat, steep}}) {
    if (!std::getenv("SLIPWAVE_LONG") && over != dipping) continue;
    EXPECT_LT(two_rocks(over, under).error(), 0.008) << over.tilt << ' ' << under.tilt;
  }
}

// Proves (V7).
TEST(TiltedRock, BelowAFreeSurfaceAndWaterIsThatOfPlaneWaves) {
  for (const auto& rock : {dipping, steep}) {
    if (!std::getenv("SLIPWAVE_LONG") && rock == steep) continue;
    EXPECT_LT(below_surface(rock).error(), 0.01) << rock.tilt;
    EXPECT_LT(below_water(rock).error(), 0.01) << rock.tilt;
  }
}

// Proves (V7).
TEST(TiltedRock, ConvergesAsIsotropicRockDoes) { EXPECT_GT(order_below_surface(dipping), 1.9); }

TEST(TiltedRock, LeavesStrainsAtAFreeSurfaceThatPutNoTractionOnIt) {
  Stack stack;
  stack.layers = {dipping}, stack.free_surface = true, stack.source_m = 100, stack.depth_m = 400;
  stack.receivers = {{150, 0}, {300, 0}}, stack.cells = 12, stack.duration_s = 0.25;
  auto scene = stack.scene();
  scene.recording.components = {Component::exx, Component::ezz};
  const auto gather = shoot(scene, 1);
  const auto c = elasticity_of<2>(dipping);
  // (V7)
  const double a = (c(1, 3) * c(5, 5) - c(1, 5) * c(3, 5)) / (c(3, 3) * c(5, 5) - c(3, 5) * c(3, 5));
  for (std::size_t n = 0; n < 2; ++n) {
    auto wanted = gather.traces[n].samples;
    for (auto& value : wanted) value *= -a;
    EXPECT_LT(relative_error(gather.traces[2 + n].samples, wanted), 1e-4);
  }
}

// Proves (V7).
TEST(TiltedRock, LeavesThroughAPml) {
  // Nothing grows in thousands of steps under a wave as long as the model, of rocks whose waves turn, too.
  for (const auto& rock : {dipping, steep}) {
    Stack space;
    space.layers = {rock}, space.depth_m = space.width_m = 500, space.source_m = 250;
    space.receivers = {{30, 280}}, space.cells = 6;
    EXPECT_LT(late_share(space.scene(), "ricker:2", 2000), 1e-3) << rock.tilt;
  }
}

/// Blocks of tilted rock, flat rock and water, in a box that absorbs.
Scene<2> blocks(std::int64_t nx, std::int64_t nz) {
  Scene<2> scene;
  const Grid<2> grid{{nx, nz}, 5, {0, 0}};
  Medium<2> medium(grid);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(grid);
  const Material kinds[] = {dipping, steep, flat, {3000, 1500, 2200}};
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto [i, k] = grid.index(n);
    put(medium, std::size_t(n), k < 12 ? water : kinds[std::size_t((i / 13 + k / 17) % 4)]);
  }
  scene.model.medium = medium;
  scene.survey.sources = {{{152, 160}, parse_mechanism<2>("force:1,1"), parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {{120, 130}, {200, 211.3}, {40, 182}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.06, 0.001};
  return scene;
}

// Proves (V7).
TEST(TiltedRock, DoesNotDependOnWhichWayItIsShot) {
  auto scene = blocks(110, 90);
  // In proportion to the cells of a wavelength: 1.5 % at 40 Hz, 0.3 % at 8 Hz.
  scene.survey.sources[0].wavelet = parse_wavelet("ricker:18");
  EXPECT_LT(error_of_exchange(scene, {202.5, 162.5}, {327.5, 352.5}), 0.01);
}

}  // namespace
}  // namespace slipwave::solver
