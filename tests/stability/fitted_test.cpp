// SPDX-License-Identifier: BSD-3-Clause
// On fitted grids, too, nothing may grow: slopes, curves, thin rows and strong contrasts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fitted_lab.hpp"

namespace slipwave::fitted_test {
namespace {

constexpr double h = 5;
const Below air{nullptr, 340, 0, 1.2}, water{nullptr, 1500, 0, 1000};

Below steel(std::function<double(double, double)> top) { return {std::move(top), 5900, 3200, 7800}; }
Below hard(std::function<double(double, double)> top) { return {std::move(top), 4500, 2250, 2500}; }
Below soft(std::function<double(double, double)> top) { return {std::move(top), 2500, 1200, 2000}; }
Below wet(std::function<double(double, double)> top) { return {std::move(top), 1500, 0, 1000}; }

std::function<double(double, double)> rolling(double mean, double amplitude, double wavelength) {
  return [=](double x, double y) {
    return mean + amplitude * std::sin(2 * std::numbers::pi * (x + 0.4 * y) / wavelength);
  };
}

double tan_of(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

/// Media on fitted grids that are hard on a scheme; all measures in cells.
Medium<2> fitted_named(const std::string& name, int nx, int nz) {
  const Grid<2> grid{{nx, nz}, h, {0, 0}};
  const double middle = nx * h / 2, depth = (nz / 2 + 0.37) * h;
  const auto plane = [&](double degrees) { return dipping(depth, tan_of(degrees), middle); };
  // A sine of this wavelength whose sharpest bend has a radius of 10 cells.
  const auto curve = [&](double cells) {
    return rolling(depth, cells * cells / (40 * std::numbers::pi * std::numbers::pi) * h, cells * h);
  };
  for (const int degrees : {0, 15, 30, 45}) {
    const auto dip = std::to_string(degrees);
    if (name == "WaterOverRockDip" + dip) return fitted_medium<2>(grid, {water, hard(plane(degrees))});
    if (name == "AirOverSteelDip" + dip) return fitted_medium<2>(grid, {air, steel(plane(degrees))});
    if (name == "SoftOverHardDip" + dip) return fitted_medium<2>(grid, {soft(nullptr), hard(plane(degrees))});
    if (name == "SurfaceDip" + dip)
      return fitted_medium<2>(grid, {hard(dipping(depth - nz / 4 * h, tan_of(degrees), middle))}, true);
  }
  if (name == "WaterOverCurvedRock") return fitted_medium<2>(grid, {water, hard(curve(20))});
  if (name == "AirOverCurvedSteel") return fitted_medium<2>(grid, {air, steel(curve(20))});
  if (name == "SteelUnderCurvedWideAir") return fitted_medium<2>(grid, {air, steel(curve(40))});
  if (name == "CurvedSurface") return fitted_medium<2>(grid, {soft(curve(20))}, true);
  if (name == "CurvedSurfaceOfWaterOverRock")
    return fitted_medium<2>(grid, {wet(rolling(6.3 * h, h, 15 * h)), hard(curve(40))}, true);
  if (name == "ThinRows")  // of a bed from 0.22 to 0.9 of a cell
    return fitted_medium<2>(grid, {water, hard(rolling(depth, h, 30 * h)), wet([=](double x, double) {
                                     return depth + h * std::sin(2 * std::numbers::pi * x / (30 * h)) +
                                            h * (0.56 + 0.34 * std::sin(x / (4 * h)));
                                   })});
  if (name == "ThinFluid")
    return fitted_medium<2>(
        grid, {soft(nullptr), wet(plane(15)), steel(dipping(depth + 0.23 * h, tan_of(15), middle))});
  if (name == "FlatThinRows")
    return fitted_medium<2>(grid, {water, steel(dipping(depth, 0)), wet(dipping(depth + 0.21 * h, 0)),
                                   soft(dipping(depth + 2.7 * h, 0))});
  throw std::logic_error("no medium " + name);
}

const std::vector<std::string>& fitted_names() {
  static const std::vector<std::string> all = {
      "WaterOverRockDip0", "WaterOverRockDip15",  "WaterOverRockDip30", "WaterOverRockDip45",
      "AirOverSteelDip15", "AirOverSteelDip30",   "AirOverSteelDip45",  "SoftOverHardDip30",
      "SoftOverHardDip45", "WaterOverCurvedRock", "AirOverCurvedSteel", "SteelUnderCurvedWideAir",
      "ThinRows",          "ThinFluid",           "FlatThinRows",       "SurfaceDip15",
      "SurfaceDip30",      "SurfaceDip45",        "CurvedSurface",      "CurvedSurfaceOfWaterOverRock"};
  return all;
}

class FittedEnergy : public ::testing::TestWithParam<std::string> {
 protected:
  Medium<2> medium() const { return fitted_named(GetParam(), 20, 44); }
  std::size_t turn() const { return turn_of(GetParam(), fitted_names()); }
  const ThreadLimit one_thread_{1};
  static constexpr int steps_ = 600, long_run_ = 20000;
};

// Proves (E11a), (F1).
TEST_P(FittedEnergy, NeverRisesInDouble) {
  for (const auto& [order, edge] :
       share_of_pairs<int, EdgeLaw>({std::begin(orders), std::end(orders)},
                                    {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::absorbing}, turn())) {
    const auto edges = edges_below(edge == EdgeLaw::absorbing ? EdgeLaw::free : edge, edge);
    expect_no_growth<double>(medium(), edges, {order}, steps_, long_run_);
  }
}

// Proves (F1).
TEST_P(FittedEnergy, NeverRisesInFloat) {
  for (const auto& [order, edge] : {std::pair(5, EdgeLaw::free), std::pair(7, EdgeLaw::absorbing)})
    expect_no_growth<float>(medium(), all_edges(edge), {order}, steps_, long_run_);
}

// Proves (F1).
TEST_P(FittedEnergy, NeverRisesAtFourthOrderInTimeOrInSmallSteps) {
  for (const int order : {5, 7}) {
    for (const double cfl : {1., 2.})
      expect_no_growth<double>(medium(), all_edges(EdgeLaw::free), {order, 4, cfl}, steps_ / 4,
                               long_run_ / 4);
    expect_no_growth<double>(medium(), all_edges(EdgeLaw::free), {order, 2, 0.3}, steps_ / 2, long_run_ / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedEnergy, ::testing::ValuesIn(share_of(fitted_names(), 0)),
                         [](const auto& info) { return info.param; });

// Proves (F1).
TEST(FittedCubeEnergy, NeverRises) {
  const ThreadLimit one_thread(1);
  const Grid<3> grid{{12, 10, 26}, h, {0, 0, 0}};
  const auto dip = [](double x, double y) { return 61.3 + 0.5 * (x - 30) - 0.3 * (y - 25); };
  const auto hills = [](double x, double y) { return 41 + 4 * std::sin(x / 12) * std::cos(y / 15); };
  for (const auto& medium :
       {fitted_medium<3>(grid, {water, hard(dip)}), fitted_medium<3>(grid, {air, steel(hills)}),
        fitted_medium<3>(grid, {soft(hills)}, true)})
    for (const auto edge : {EdgeLaw::free, EdgeLaw::rigid}) {
      EdgeLaws<3> edges;
      for (int axis = 0; axis < 3; ++axis) edges[axis] = {edge, edge};
      for (const int order : {3, 7}) expect_no_growth<double>(medium, edges, {order}, 120, 4000);
      expect_no_growth<float>(medium, edges, {5}, 120, 4000);
    }
}

class FittedPml : public ::testing::TestWithParam<std::string> {};

// Beyond curved sides and tops the layer damps rows that bend.
// Proves (F10a).
TEST_P(FittedPml, StaysBoundedForThousandsOfSteps) {
  const ThreadLimit one_thread(1);
  const auto medium = fitted_named(GetParam(), 14, 36);
  const std::vector<std::tuple<int, EdgeLaw, int>> runs = {{3, EdgeLaw::absorbing, 8},
                                                           {5, EdgeLaw::free, 8},
                                                           {5, EdgeLaw::absorbing, 20},
                                                           {7, EdgeLaw::rigid, 8},
                                                           {7, EdgeLaw::free, 20}};
  for (const auto& [order, top, zone_cells] : share_of(runs, turn_of(GetParam(), fitted_names()))) {
    const Numbers numbers{order, 2, matched_cfl, zone_cells, 30};
    SCOPED_TRACE("order " + std::to_string(order) + ", top " + std::to_string(int(top)) + ", " +
                 std::to_string(zone_cells) + " cells");
    FittedLab<2, double> lab(medium, edges_below(top, EdgeLaw::absorbing), numbers);
    const double begin = lab.energy();
    for (int n = 0; n < 500; ++n) lab.step();
    const double early = lab.energy();
    EXPECT_LT(early, begin);
    for (int piece = 0; piece < (long_form() ? 39 : 3); ++piece) {
      for (int n = 0; n < 500; ++n) lab.step();
      // Written so that NaN fails.
      ASSERT_TRUE(lab.energy() < 1.001 * early)
          << "after " << 1000 + piece * 500 << " steps: " << lab.energy() << ", it was " << early;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedPml, ::testing::ValuesIn(share_of(fitted_names(), 1)),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace slipwave::fitted_test
