// SPDX-License-Identifier: BSD-3-Clause
// Waves in anisotropic rock against plane-wave (wave number) solutions, symmetry and each other.
#include <gtest/gtest.h>

#include "anisotropic_scene.hpp"
#include "anisotropic_stack.hpp"
#include "layer_stack.hpp"
#include "model/anisotropy.hpp"
#include "model/layers.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {
namespace {

/// A shale, a sandstone (Thomsen 1986, as Mesaverde and Taylor) and rocks that show more: epsilon below
/// delta, and an elliptical one.
constexpr Material shale{3000, 1600, 2300, 0.2, 0.1}, sandstone{3370, 1830, 2500, 0.11, -0.035},
    crossed{3200, 1700, 2400, -0.05, 0.2}, elliptical{2800, 1500, 2200, 0.18, 0.18},
    hard{4200, 2300, 2600, 0.1, 0.15}, water{1500, 0, 1000};

// Proves (V1).
TEST(AnisotropicStack, OfIsotropicLayersIsThatOfPotentials) {
  // Two methods that share nothing: roots of the Christoffel equation, and potentials with closed direct
  // waves.
  constexpr Rock over{3000, 1600, 2200}, under{4500, 2250, 2500}, sea{1500, 0, 1000};
  const auto isotropic = [](const Rock& rock) { return layer_of(Material{rock.vp, rock.vs, rock.rho}); };
  const std::vector<LayerStack::Receiver> places = {{150, 30}, {-80, 170}, {200, 250}};
  for (const bool explosion : {true, false}) {
    const auto closed =
        LayerStack{{over, under}, {0, 200}, true, 100, explosion, {0.6, 0.8}}.ricker(15, 0.001, 300, places);
    AnisotropicStack stack{{isotropic(over), isotropic(under)}, {200}, true, 100};
    if (explosion) stack.explosion = 1;
    if (!explosion) stack.force = {0.6, 0.8};
    const auto found = stack.ricker(15, 0.001, 300, {{150, 30}, {-80, 170}, {200, 250}});
    for (std::size_t n = 0; n < places.size(); ++n)
      for (std::size_t row = 0; row < 2; ++row)
        EXPECT_LT(relative_error(found[n][row], closed[n][row]), 2e-5) << n;
  }
  const auto closed = LayerStack{{sea, over}, {0, 200}, true, 100}.ricker(15, 0.001, 300, places);
  AnisotropicStack stack{{isotropic(sea), isotropic(over)}, {200}, true, 100};
  stack.explosion = 1;
  const auto found = stack.ricker(15, 0.001, 300, {{150, 30}, {-80, 170}, {200, 250}});
  for (std::size_t n = 0; n < places.size(); ++n)
    for (std::size_t row = 0; row < 2; ++row)
      EXPECT_LT(relative_error(found[n][row], closed[n][row]), 2e-5) << n;
}

// Proves (V1).
TEST(Anisotropy, OfPointSourcesIsThatOfPlaneWavesInAllDirections) {
  for (const auto& rock : {shale, sandstone, crossed, elliptical})
    for (const std::string kind : {"force:0.6,0.8", "explosion", "moment:0,0,1"}) {
      if ((rock == sandstone || rock == elliptical) && kind != "explosion") continue;
      Stack space;
      space.layers = {rock}, space.kind = kind;
      space.source_m = 500 + space.spacing() / 2, space.receivers = around(space.source_m, 350);
      EXPECT_LT(space.error(), 0.007) << rock.epsilon << ' ' << rock.delta << ' ' << kind;
    }
}

// Proves (V1).
TEST(Anisotropy, OfTwoRocksReflectsAndTransmitsAsPlaneWaves) {
  for (const auto& [over, under] : {std::pair{shale, hard}, {crossed, sandstone}, {elliptical, crossed}}) {
    EXPECT_LT(two_rocks(over, under).error(), 0.008);
  }
}

// Proves (V4).
TEST(Anisotropy, BelowAFreeSurfaceAndWaterIsThatOfPlaneWaves) {
  for (const auto& rock : {shale, crossed}) {
    EXPECT_LT(below_surface(rock).error(), 0.01);
    EXPECT_LT(below_water(rock).error(), 0.01);
  }
}

// Proves (V4).
TEST(Anisotropy, ConvergesAsIsotropicRockDoes) { EXPECT_GT(order_below_surface(crossed), 1.9); }

// Proves (V6).
TEST(Anisotropy, LeavesThroughAPmlWhereWavesTurn) {
  // Medium III of Becache, Fauqueux & Joly (2003), whose S waves carry energy back while their fronts move
  // on. A wave as long as the model is what layers feed: without damping (V6) it blows up within this time.
  const auto rock = material_of(vertical_symmetry(4e9, 7.5e9, 20e9, 2e9), 2500);
  Stack space;
  space.layers = {rock}, space.kind = "force:0.6,0.8";
  space.depth_m = space.width_m = 750, space.source_m = 375, space.receivers = {{30, 405}};
  space.cells = 5 * slowest_speeds<2>(rock).s / (peak_hz * 25);
  EXPECT_LT(late_share(space.scene(), "ricker:1", 6000), 1e-3);
}

// Proves (V1).
TEST(Anisotropy, OfNoneIsIsotropicRock) {
  // The same rock by the loops of anisotropic media, since one cell far away is anisotropic.
  Stack stack;
  stack.layers = {{3000, 1600, 2300}, {2500, 1200, 2100}}, stack.tops_m = {300}, stack.free_surface = true;
  stack.cells = 10, stack.source_m = 100, stack.receivers = {{250, 60}, {-150, 340}}, stack.depth_m = 500;
  auto scene = stack.scene();
  const auto isotropic = shoot(scene, 1);
  scene.model.medium[Property::epsilon][0] = 1e-6F;
  const auto found = shoot(scene, 1);
  for (std::size_t n = 0; n < found.traces.size(); ++n)
    EXPECT_LT(relative_error(found.traces[n].samples, isotropic.traces[n].samples), 1e-5);
}

// Proves (V4).
TEST(Anisotropy, LeavesStrainsAtAFreeSurfaceThatPutNoTractionOnIt) {
  Stack stack;
  stack.layers = {shale}, stack.free_surface = true, stack.source_m = 100, stack.depth_m = 500;
  stack.receivers = {{150, 0}, {300, 0}};
  auto scene = stack.scene();
  scene.recording.components = {Component::exx, Component::ezz};
  const auto gather = shoot(scene, 1);
  const auto c = upright_elasticity<2>(shale);
  for (std::size_t n = 0; n < 2; ++n) {
    auto wanted = gather.traces[n].samples;
    for (auto& value : wanted) value *= -c(1, 3) / c(3, 3);
    EXPECT_LT(relative_error(gather.traces[2 + n].samples, wanted), 1e-4);
  }
}

TEST(Anisotropy, StandsBelowAFloorThatRowsFollow) {
  // Bent rows above, level ones of another height below, among which a rock that is next to isotropic.
  const std::vector<Layer> layers = {parse_layer("0:1500:0:1000"),
                                     parse_layer("sine,100,10,200:2500:1200:2200"),
                                     parse_layer("300:3000:1600:2300 epsilon=1e-6")};
  const auto fit = fit_layers<2>(Grid<2>{{60, 90}, 5, {0, 0}}, layers, {});
  ASSERT_TRUE(fit.grid.rows);
  Scene<2> scene;
  scene.model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
  scene.survey.sources = {{{150, 50}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:25"), 1e6}};
  scene.survey.receivers_m = {{60, 40}, {220, 350}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.2, 0.002};
  check(scene);
  expect_same(scene);
  const auto found = all_samples(shoot(scene, 1));
  for (const auto property : {Property::epsilon, Property::delta}) scene.model.medium[property] = {};
  const auto isotropic = all_samples(shoot(scene, 1));
  EXPECT_LT(relative_error(found, isotropic), 1e-4);
}

/// Blocks of any anisotropic rock, void and water, sources and slip among them.
Scene<2> blocks(std::int64_t nx = 150, std::int64_t nz = 90) {
  const Grid<2> grid{{nx, nz}, 5, {0, 0}};
  Scene<2> scene;
  Medium<2> medium(grid);
  medium[Property::epsilon] = medium[Property::delta] = Field<2>(grid);
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  const Material kinds[] = {shale, crossed, sandstone, {3000, 1500, 2200}};
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto [i, k] = grid.index(n);
    const bool sea = k < 12;
    put(medium, std::size_t(n), sea ? water : kinds[i < 20 ? 3 : (i / 11 * (k / 40) + k / 30) % 3]);
    scene.model.fracture[std::size_t(n)] = k >= 40 && k < 50 && i >= 30 && i < 90;
  }
  scene.model.medium = medium;
  scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 1000, 0}}}};
  scene.survey.sources = {{{302, 160}, parse_mechanism<2>("force:1,1"), parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {{250, 130}, {400, 261.3}, {40, 362}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.08, 0.001};
  return scene;
}

// Proves (V1).
TEST(Anisotropy, DoesNotDependOnWhichWayItIsShot) {
  // Reciprocity of forces, through water and blocks of rock.
  auto scene = blocks();
  scene.with_slip = false;
  EXPECT_LT(error_of_exchange(scene, {302.5, 162.5}, {427.5, 352.5}), 0.01);
}

}  // namespace
}  // namespace slipwave::solver
