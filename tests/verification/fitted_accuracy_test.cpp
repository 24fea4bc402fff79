// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <ostream>

#include "fitted_scenes.hpp"
#include "layer_stack.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"

// Fitted grids against exact traces: of parallel layers at any depth and dip, by wave number (LayerStack).
namespace slipwave::solver::fitted_accuracy_test {
namespace {

constexpr Rock water{1500, 0, 1000}, rock{3000, 1600, 2200}, soft{2500, 1200, 2000}, hard{4500, 2250, 2500},
    mud{1800, 700, 1800};
constexpr double interval_s = 0.001;

/// Parallel layers that dip about (origin_x, the first interface there); places are given along and across
/// them, in m from that point.
struct DippingStack {
  const char* name;
  std::vector<Rock> layers;
  std::vector<double> faces_m;  // across, the first one 0; with a free surface the first is that
  double dip_deg;
  bool free_surface;  // that dips like the layers
  const char* mechanism;
  std::vector<LayerStack::Receiver> receivers;
  double source_m;       // across
  double bound;          // percent, at 24 cells of the shortest dominant wavelength
  double least_order;    // from 16 to 24 cells
  double farther_m = 0;  // off lie the sides
  double peak_hz = 15;
  double duration_s = 0.55;
  double courant = 0.9;
};
void PrintTo(const DippingStack& stack, std::ostream* out) { *out << stack.name; }

/// Where the model lies round the point about which layers dip: as high as keeps rows below 1.6 cells.
struct Room {
  double left_m, right_m, above_m, below_m;
  explicit Room(const DippingStack& stack) : left_m(400 + stack.farther_m), right_m(600 + stack.farther_m) {
    above_m = below_m =
        330 + (stack.farther_m > 0 ? 1.4 : 0.9) * right_m * std::tan(stack.dip_deg * std::numbers::pi / 180);
  }
};

struct Frame {
  double cosine, sine, x0, z0;
  explicit Frame(const DippingStack& stack, double depth_m)
      : cosine(std::cos(stack.dip_deg * std::numbers::pi / 180)),
        sine(std::sin(stack.dip_deg * std::numbers::pi / 180)),
        x0(Room(stack).left_m),
        z0(depth_m) {}
  Point<2> place(double a, double b) const {
    return {x0 + a * cosine - b * sine, z0 + a * sine + b * cosine};
  }
};

Scene<2> scene_in_cells(const DippingStack& stack, double cells) {
  double slowest = 1e30;
  for (const auto& layer : stack.layers) slowest = std::min(slowest, layer.vs > 0 ? layer.vs : layer.vp);
  const Room room(stack);
  const double wide_m = room.left_m + room.right_m;
  const auto nx = std::int64_t(std::ceil(wide_m * stack.peak_hz * cells / slowest));
  const double h = wide_m / double(nx);
  // The first interface lies 0.37 of a cell below a face of the regular grid.
  const auto rows = std::int64_t(room.above_m / h);
  const double depth = (double(rows) + 0.37) * h;
  const auto nz = rows + std::int64_t((room.below_m + stack.faces_m.back()) / h);
  const Frame frame(stack, depth);
  std::vector<Below> layers;
  for (std::size_t n = 0; n < stack.layers.size(); ++n) {
    const double face = stack.free_surface ? stack.faces_m[n] : n == 0 ? 0 : stack.faces_m[n - 1];
    layers.push_back(
        below(dipping(depth + face / frame.cosine, frame.sine / frame.cosine, frame.x0), stack.layers[n]));
  }
  Scene<2> scene;
  scene.model.medium = fitted_medium<2>(Grid<2>{{nx, nz}, h, {0, 0}}, layers, stack.free_surface);
  scene.survey.sources = {{frame.place(0, stack.source_m), parse_mechanism<2>(stack.mechanism),
                           parse_wavelet("ricker:" + std::to_string(stack.peak_hz)), 1e6}};
  for (const auto& at : stack.receivers) scene.survey.receivers_m.push_back(frame.place(at.a, at.b));
  scene.edges = edges_all(EdgeLaw::absorbing);
  if (stack.free_surface) scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz}, stack.duration_s, interval_s};
  scene.numerics.cfl = stack.courant;
  check(scene);
  return scene;
}

/// vx and vz of all receivers, by the exact solution in the frame of the layers, turned back.
std::vector<double> exact_traces(const DippingStack& stack) {
  const Frame frame(stack, 0);
  LayerStack exact{stack.layers, stack.faces_m, stack.free_surface, stack.source_m, true, {}};
  const auto mechanism = parse_mechanism<2>(stack.mechanism);
  if (const auto* force = std::get_if<PointForce<2>>(&mechanism)) {
    exact.explosion = false;
    const auto& f = force->vector;
    exact.force = {f[0] * frame.cosine + f[1] * frame.sine, f[1] * frame.cosine - f[0] * frame.sine};
  }
  const auto count = std::size_t(std::lround(stack.duration_s / interval_s)) + 1;
  const auto found = exact.ricker(stack.peak_hz, interval_s, count, stack.receivers);
  std::vector<double> all;
  for (const bool vertical : {false, true})
    for (const auto& motion : found)
      for (std::size_t n = 0; n < count; ++n)
        all.push_back(vertical ? motion[0][n] * frame.sine + motion[1][n] * frame.cosine
                               : motion[0][n] * frame.cosine - motion[1][n] * frame.sine);
  return all;
}

double error_in_cells(const DippingStack& stack, double cells, const std::vector<double>& exact) {
  auto found = samples_of(shoot(scene_in_cells(stack, cells), 1));
  for (auto& sample : found) sample /= 1e6;
  return 100 * relative_error(found, exact);
}

/// Above and below an interface.
const std::vector<LayerStack::Receiver> both_sides = {{-150, -150}, {0, -100}, {150, -150}, {300, -120},
                                                      {-150, 150},  {0, 100},  {150, 150},  {300, 120}};
const std::vector<LayerStack::Receiver> under_surface = {{-150, 150}, {0, 60}, {150, 100}, {300, 150}};
const std::vector<LayerStack::Receiver> near_floor = {{-200, 9}, {100, 9}, {250, 9}, {400, 9}, {250, -30}};
const std::vector<LayerStack::Receiver> on_surface = {{-150, 0}, {0, 0}, {100, 0}, {300, 0}};

const std::vector<LayerStack::Receiver> far_on_surface = {{200, 0}, {400, 0}, {600, 0}, {800, 0}};

const DippingStack stacks[] = {
    // Waves along the surface: 2.3 % without (E11c).
    {"ShallowDip15", {rock}, {0}, 15, true, "explosion", far_on_surface, 15, 2.0, 3, 250, 20, 0.75},
    {"WaterOverRockDip5", {water, rock}, {0}, 5, false, "explosion", both_sides, -200, 2.0, 2},
    {"WaterOverRockDip15", {water, rock}, {0}, 15, false, "explosion", both_sides, -200, 2.2, 2},
    {"WaterOverRockDip30", {water, rock}, {0}, 30, false, "explosion", both_sides, -200, 3.3, 2},
    {"WaterOverRockDip30Force", {water, rock}, {0}, 30, false, "force:1,2", both_sides, 220, 3.3, 2, 500},
    // Where a surface that dips becomes level in the PML, waves along it come back.
    {"FreeSurfaceDip15", {rock}, {0}, 15, true, "explosion", under_surface, 200, 0.5, 2, 500},
    {"FreeSurfaceDip30", {rock}, {0}, 30, true, "explosion", under_surface, 200, 0.6, 2, 500},
    {"OnFreeSurfaceDip0", {rock}, {0}, 0, true, "explosion", on_surface, 200, 0.5, 1.0, 500},
    {"OnFreeSurfaceDip15", {rock}, {0}, 15, true, "explosion", on_surface, 200, 0.5, 1.0, 500},
    {"OnFreeSurfaceDip30", {rock}, {0}, 30, true, "explosion", on_surface, 200, 0.5, 1.0, 500},
    {"SolidSolid", {soft, hard}, {0}, 0, false, "explosion", both_sides, -200, 0.6, 2},
    {"SolidSolidDip15", {soft, hard}, {0}, 15, false, "explosion", both_sides, -200, 0.6, 2, 100},
    {"WaterSoftHard", {water, soft, hard}, {0, 113.7}, 0, false, "explosion", both_sides, -200, 1.0, 2},
    // Waves bound to the floor, in long and in short steps.
    {"NearFloor", {water, rock}, {0}, 0, false, "force:0,1", near_floor, 50, 1.1, 2, 500},
    {"NearFloorDip15", {water, rock}, {0}, 15, false, "force:0,1", near_floor, 50, 1.1, 2, 250},
    {"NearFloorShortSteps",
     {water, rock},
     {0},
     0,
     false,
     "force:0,1",
     near_floor,
     50,
     1.0,
     2,
     500,
     15,
     0.55,
     0.2},
    {"WaterSolidForce", {water, rock}, {0}, 0, false, "force:0,1", both_sides, 220, 2.7, 2},
    {"SolidFluidSolidSolid",
     {soft, water, rock, hard},
     {0, 61.3, 152.9},
     0,
     false,
     "explosion",
     {{-150, -150}, {0, -100}, {150, -150}, {0, 31}, {150, 112}, {0, 210}, {150, 230}},
     -200,
     2.9,
     2},
    // A tenth of its S wavelength: two rows on either grid.
    {"ThinBed", {hard, soft, hard}, {0, 8}, 0, false, "explosion", both_sides, -200, 0.45, -1.2},
};

class Stack : public testing::TestWithParam<DippingStack> {};

/// In the short form few of those that need wide models, and of one dip of the others.
std::vector<DippingStack> chosen_stacks() {
  std::vector<DippingStack> chosen;
  for (const auto& stack : stacks) {
    const double dip = stack.dip_deg;
    if (long_form() || (stack.farther_m == 0 ? dip == 0 || dip == 30 : dip == 15)) chosen.push_back(stack);
  }
  return chosen;
}

// Proves (E11c), (E11a), (F2), (F3), (F4), (F5), (F7), (F6), (F8), (F10), (F10a).
TEST_P(Stack, HasTheErrorsPromisedAndItsOrder) {
  const auto& stack = GetParam();
  const auto exact = exact_traces(stack);
  const double coarse = error_in_cells(stack, 16, exact), fine = error_in_cells(stack, 24, exact);
  const double order = std::log(coarse / fine) / std::log(1.5);
  if (std::getenv("SLIPWAVE_SHOW"))
    std::printf("%-22s %6.2f %6.2f order %.2f\n", stack.name, coarse, fine, order);
  EXPECT_LT(fine, stack.bound);
  EXPECT_GT(order, stack.least_order);
}

INSTANTIATE_TEST_SUITE_P(FittedGrid, Stack, testing::ValuesIn(chosen_stacks()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FittedSweep, OfDipsKeepsItsErrorsLong) {
  for (const double dip_deg : {0., 10., 20., 35.})
    for (const auto& [over, under, bound] :
         {std::tuple(water, rock, 4.), {mud, hard, 2.}, {soft, hard, 1.}}) {
      // Solid tops are fitted up to smaller dips; steep ones meet the sides of the model, off which S waves
      // then come back.
      if (dip_deg > (over.vp == soft.vp ? 10 : over.vs > 0 ? 20 : 35)) continue;
      const DippingStack stack{"",          {over, under}, {0},  dip_deg, false,
                               "explosion", both_sides,    -200, bound,   2};
      const auto exact = exact_traces(stack);
      double error[3];
      for (int n = 0; n < 3; ++n)
        error[n] = error_in_cells(stack, std::array{12, 16, 24}[std::size_t(n)], exact);
      if (std::getenv("SLIPWAVE_SHOW"))
        std::printf("dip %g over vp %g: %.2f %.2f %.2f\n", dip_deg, over.vp, error[0], error[1], error[2]);
      EXPECT_LT(error[2], bound) << dip_deg << ' ' << over.vp;
      EXPECT_GT(observed_order(error[0], error[2]), 2) << dip_deg << ' ' << over.vp;
    }
}

}  // namespace
}  // namespace slipwave::solver::fitted_accuracy_test
