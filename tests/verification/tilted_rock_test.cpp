// Waves in rock whose axis of symmetry is tilted, against plane-wave (wave number) solutions and symmetry.
#include <gtest/gtest.h>

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

TEST(TiltedStack, OfATurnedRockIsTheTurnedField) {
  // The same rock by both kinds of roots: in axes of its beds, and in those of the grid.
  const Turned turned(30);
  auto upright = dipping;
  upright.tilt = 0;
  AnisotropicStack beds{{layer_of(upright)}, {}}, grid{{layer_of(dipping)}, {}};
  beds.force = {0.6, 0.8};
  grid.force = turned(0.6, 0.8);
  std::vector<AnisotropicStack::Receiver> along_beds = {{0, 200}, {150, 120}, {-160, 90}, {60, -180}},
                                          along_grid;
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

TEST(TiltedRock, OfPointSourcesIsThatOfPlaneWavesInAllDirections) {
  for (const auto& rock : {dipping, steep})
    for (const std::string kind : {"force:0.6,0.8", "explosion", "moment:0,0,1"}) {
      Stack space;
      space.layers = {rock}, space.kind = kind;
      space.source_m = 500 + space.spacing() / 2, space.receivers = around(space.source_m, 350);
      EXPECT_LT(space.error(), 0.007) << rock.tilt << ' ' << kind;
    }
}

TEST(TiltedRock, OfTwoRocksReflectsAndTransmitsAsPlaneWaves) {
  for (const auto& [over, under] : {std::pair{dipping, hard}, {steep, dipping}, {flat, steep}}) {
    Stack stack;
    stack.layers = {over, under}, stack.tops_m = {560}, stack.source_m = 400 + stack.spacing() / 2;
    stack.receivers = {{250, 300}, {0, 480}, {300, 500}, {200, 640}, {-250, 800}};
    EXPECT_LT(stack.error(), 0.008) << over.tilt << ' ' << under.tilt;
  }
}

TEST(TiltedRock, BelowAFreeSurfaceAndWaterIsThatOfPlaneWaves) {
  for (const auto& rock : {dipping, steep}) {
    Stack surface;
    surface.layers = {rock}, surface.free_surface = true, surface.source_m = 100, surface.depth_m = 600;
    surface.receivers = {{250, 20}, {-150, 40}, {100, 300}, {300, 60}};
    EXPECT_LT(surface.error(), 0.01) << rock.tilt;
    Stack sea;
    sea.layers = {water, rock}, sea.tops_m = {200}, sea.free_surface = true, sea.source_m = 100,
    sea.depth_m = 700;
    sea.kind = "explosion";
    sea.receivers = {{250, 150}, {-150, 260}, {100, 400}, {300, 240}};
    EXPECT_LT(sea.error(), 0.01) << rock.tilt;
  }
}

TEST(TiltedRock, ConvergesAsIsotropicRockDoes) {
  Stack coarse;
  coarse.layers = {dipping}, coarse.cells = 12, coarse.order = 7, coarse.cfl = 0.9;
  coarse.free_surface = true, coarse.source_m = 100, coarse.depth_m = 600;
  coarse.receivers = {{250, 20}, {-150, 40}, {100, 300}};
  auto fine = coarse;
  fine.cells = 24;
  const double h = coarse.spacing() / fine.spacing();
  EXPECT_GT(std::log(coarse.error() / fine.error()) / std::log(h), 1.9);
}

}  // namespace
}  // namespace slipwave::solver
