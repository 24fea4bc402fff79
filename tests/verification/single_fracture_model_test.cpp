// SPDX-License-Identifier: BSD-3-Clause
// Single fractures of a model: what cells get of them, files, and networks drawn from a seed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.hpp"
#include "build/resample.hpp"
#include "lab.hpp"
#include "model/fracture_network.hpp"
#include "model/model_netcdf.hpp"
#include "model/single_fracture.hpp"

namespace slipwave::single_fracture_model_test {
namespace {

constexpr solver::Rock rock{4500, 2250, 2500};

FractureSet<2> set_of(std::vector<FractureTrace<2>> traces) {
  SlipSystem<2> system{normal_between_tips(traces.front()), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {2e-10, 5e-10, 0, 0, 0};
  return {"lines", {system}, std::move(traces)};
}
Model<2> model_with(const FractureSet<2>& set, double h = 5) {
  Model<2> model;
  model.medium = solver::uniform_medium(std::llround(200 / h), std::llround(150 / h), h, rock);
  add_single_fractures(model, set);
  return model;
}
const FractureTrace<2> bent = {{40, 30}, {111, 52}, {140, 120}};

// Proves (S30).
TEST(CellsCrossed, HaveTheComplianceAndThePlaceOfTheFracture) {
  // However it lies among the cells: strain of all cells times their area, and its first moment.
  const Grid<2> grid{{40, 30}, 5, {0, 0}};
  for (const double shift : {0., 1.2, 2.5, 4.1}) {
    const FractureTrace<2> level = {{50 + shift, 70 + shift}, {120 + shift, 70 + shift}};
    double normal = 0, tangential = 0, other = 0, x = 0, z = 0;
    for (const auto& cell : cells_crossed(grid, set_of({level}))) {
      const auto at = grid.index(std::int64_t(cell.cell));
      // Components xx, zz, xz of strain and stress; a shear of 1 Pa slides the plane by Z_T, half of it
      // strain.
      normal += 25 * cell.strain[4], tangential += 25 * 2 * cell.strain[8];
      other += std::abs(cell.strain[0]) + std::abs(cell.strain[1]) + std::abs(cell.strain[5]);
      x += 25 * cell.strain[4] * grid.centre(0, at[0]), z += 25 * cell.strain[4] * grid.centre(1, at[1]);
    }
    EXPECT_NEAR(normal / (70 * 2e-10), 1, 1e-12);
    EXPECT_NEAR(tangential / (70 * 5e-10), 1, 1e-12);
    EXPECT_LT(other, 1e-22);
    EXPECT_NEAR(x / normal, 85 + shift, 1e-9);
    EXPECT_NEAR(z / normal, 70 + shift, 1e-9);
  }
}

TEST(CellsCrossed, AreThoseOfTheWholeInPartsOfTheGridAndOfLinesThatComeFromAfar) {
  const Grid<2> whole{{40, 30}, 5, {0, 0}};
  Grid<2> part = whole;
  part.first[1] = 12, part.shape[1] = 10;
  for (const auto& set : {set_of({bent}), set_of({{{-1e8, 70}, {1e8, 71}}})}) {
    std::size_t n = 0;
    const auto in_part = cells_crossed(part, set);
    for (const auto& cell : cells_crossed(whole, set)) {
      const auto at = whole.index(std::int64_t(cell.cell));
      if (at[1] < 12 || at[1] >= 22) continue;
      ASSERT_LT(n, in_part.size());
      EXPECT_EQ(in_part[n].cell, std::size_t(part.flat({at[0], at[1] - 12})));
      EXPECT_EQ(in_part[n++].strain, cell.strain);
    }
    EXPECT_EQ(n, in_part.size());
    EXPECT_GT(n, 10U);
  }
}

TEST(SingleFractures, AreTheSameFromAFileAndInOtherCells) {
  const auto path = std::filesystem::temp_directory_path() / ("single-" + std::to_string(getpid()) + ".nc");
  auto set = set_of({bent, {{20, 140}, {60, 100}}});
  const auto model = model_with(set);
  write_model(model, path.string());
  const auto read = read_model<2>(path.string());
  std::filesystem::remove(path);
  ASSERT_EQ(read.fracture_sets.size(), 1U);
  EXPECT_EQ(read.fracture_sets[0].traces, set.traces);
  check(read);
  const auto finer = regridded(model, 2.5), built = model_with(set, 2.5);
  EXPECT_TRUE(std::equal(finer.fracture.begin(), finer.fracture.end(), built.fracture.begin()));
  // The top of what is left of a model is depth 0.
  EXPECT_NEAR(cropped(model, {{0, 10}, {200, 150}}).fracture_sets[0].traces[0][0][1], 20, 1e-9);
}

TEST(SingleFractures, TakeCellsOfClustersAndLeaveThoseOfOthers) {
  auto model = model_with(set_of({bent}));
  const auto before = model.fracture;
  const auto count = add_single_fractures(model, set_of({{{40, 30}, {111, 52}}}));
  EXPECT_EQ(count.taken, 0);
  EXPECT_GT(count.marked, 0);
  SlipSystem<2> planes{{0, 1}, 0.3, 0, 0};
  add_fractures<2>(model, {"cluster", {planes}}, [](const Point<2>& at) { return at[0] < 60; });
  EXPECT_GT(add_single_fractures(model, set_of({{{10, 70}, {100, 70}}})).taken, 0);
}

TEST(SingleFractures, AreRefusedWhereTheyCanNotBe) {
  Model<2> model;
  model.medium = solver::uniform_medium(40, 30, 5, rock);
  const auto refuses = [&](const FractureTrace<2>& trace) {
    EXPECT_THROW(add_single_fractures(model, set_of({trace})), Error);
    EXPECT_TRUE(model.fracture_sets.empty());
  };
  refuses({{10, 10}, {210, 10}});
  refuses({{10, 10}, {20, 20}, {20, 20}});
  EXPECT_THROW(parse_segment("10,10"), Error);
  auto damped = model_with(set_of({bent}));
  damped.fracture_sets[0].systems[0].compliance.normal_dashpot_pa_s_m = 1;
  EXPECT_THROW(check(damped), Error);
}

TEST(FractureTraces, AreReadFromTextWithEmptyLinesBetweenThem) {
  const auto path = std::filesystem::temp_directory_path() / ("traces-" + std::to_string(getpid()) + ".txt");
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_fracture_traces<2>(path.string());
  };
  const std::vector<FractureTrace<2>> two = {{{1, 2}, {3, 4}}, {{5, 6}, {7, 8}, {9, 1}}};
  EXPECT_EQ(read("1 2\n3,4 # end\n\n\n> second\n5 6\n# between\n7 8\n9 1\n"), two);
  const auto message = [&](const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("1 2\n3 4\n\n5 6\n").find("line 4: found a fracture of one point"), std::string::npos);
  EXPECT_NE(message("1 2\n3 4\n\n5 6\n7\n").find("line 5: found 1 value"), std::string::npos);
  EXPECT_NE(message("# none\n").find("holds no fracture"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(FractureTraces, ThatLieOnEachOtherAreFound) {
  const FractureTrace<2> dipping = {{10, 20}, {110, 70}}, back = {{0, 0}, {0, 80}, {0, 50}},
                         half = {{60, 45}, {160, 95}};
  EXPECT_EQ(doubled_size({dipping}), 0);
  EXPECT_NEAR(doubled_size({dipping, dipping}), std::hypot(100, 50), 1e-9);
  EXPECT_NEAR(doubled_size({back, dipping}), 30, 1e-9);
  EXPECT_NEAR(doubled_size({half, dipping}), std::hypot(50, 25), 1e-9);
  // Those that cross, touch or lie beside each other do not.
  EXPECT_EQ(doubled_size({dipping, {{10, 70}, {110, 20}}, {{110, 70}, {210, 120}}, {{10, 21}, {110, 71}}}),
            0);
  const FractureTrace<3> flat = {{0, 0, 1}, {5, 0, 1}, {5, 5, 1}}, other = {{0, 0, 2}, {5, 0, 2}, {5, 5, 2}};
  EXPECT_EQ(doubled_size({flat, other, flat}), 12.5);
}

// Proves (S31).
TEST(FractureNetwork, HasTheLengthsAndDipsItIsDrawnFrom) {
  const Grid<2> grid{{400, 400}, 10, {0, 0}};
  FractureNetwork of{4000, 0, 10, 200, 2.5, 30, 8, 7};
  const auto region = region_of_box<2>({{500, 500}, {3500, 3500}});
  const auto all = drawn_fractures(grid, region, of);
  ASSERT_EQ(all.size(), 4000U);
  // Share of the longer ones (S31), and the mean of cos 2 (dip - middle), I_1/I_0 of the concentration.
  const auto power = [](double length) { return std::pow(length, 1 - 2.5); };
  for (const double length : {15., 30., 80.}) {
    double longer = 0;
    for (const auto& trace : all) longer += length_of(trace) > length;
    EXPECT_NEAR(longer / 4000, (power(length) - power(200)) / (power(10) - power(200)), 0.025) << length;
  }
  double cosine = 0, sine = 0;
  for (const auto& trace : all) {
    const double dip = std::atan2(trace[1][1] - trace[0][1], trace[1][0] - trace[0][0]);
    cosine += std::cos(2 * (dip - std::numbers::pi / 6)) / 4000;
    sine += std::sin(2 * (dip - std::numbers::pi / 6)) / 4000;
  }
  EXPECT_NEAR(cosine, std::cyl_bessel_i(1., 8.) / std::cyl_bessel_i(0., 8.), 0.01);
  EXPECT_NEAR(sine, 0, 0.02);
  // A smaller number is the beginning of a larger one.
  of.count = 10;
  const auto few = drawn_fractures(grid, region, of);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
  of.seed = 8;
  EXPECT_NE(drawn_fractures(grid, region, of), few);
}

TEST(FractureNetwork, HasNoMoreFracturesByIntensityThanByCount) {
  const Grid<2> grid{{100, 100}, 10, {0, 0}};
  const auto error = [&](double intensity, double least_m, double most_m, double exponent) -> std::string {
    try {
      drawn_fractures(grid, region_of_box<2>({{0, 0}, {1000, 1000}}),
                      {0, intensity, least_m, most_m, exponent, 30, {}, 1});
    } catch (const Error& found) {
      return found.what();
    }
    return "";
  };
  // Mean lengths: (MAX - MIN)/ln(MAX/MIN) of an exponent of 1, ln(MAX/MIN)/(1/MIN - 1/MAX) of one of 2.
  EXPECT_NE(error(1000, 10, 50, 1).find("about 4e+07 fractures"), std::string::npos)
      << error(1000, 10, 50, 1);
  EXPECT_NE(error(1000, 10, 50, 2).find("about 5e+07 fractures"), std::string::npos)
      << error(1000, 10, 50, 2);
  EXPECT_NE(error(1000, 20, 20, 2).find("about 5e+07 fractures"), std::string::npos);
  EXPECT_NE(error(1e-9, 10, 50, 2).find("about 5e-05 fractures"), std::string::npos);
  // The model cuts off what is longer than it.
  EXPECT_EQ(error(0.01, 1e5, 1e6, 1.5), "");
}

// Proves (S31).
TEST(FractureNetwork, HasTheIntensityAskedForAndEndsWithTheModel) {
  const Grid<2> grid{{100, 100}, 10, {0, 0}};
  const FractureNetwork of{0, 0.02, 50, 300, 2, -40, {}, 3};
  double length_m = 0;
  for (const auto& trace : drawn_fractures(grid, region_of_box<2>({{0, 0}, {1000, 600}}), of)) {
    length_m += length_of(trace);
    for (const auto& vertex : trace)
      for (const double part : vertex) EXPECT_TRUE(part >= 0 && part <= 1000);
    EXPECT_NEAR((trace[1][1] - trace[0][1]) / (trace[1][0] - trace[0][0]),
                std::tan(-40 * std::numbers::pi / 180), 1e-9);
  }
  EXPECT_NEAR(length_m / (0.02 * 6e5), 1, 150 / 12000.);
}

}  // namespace
}  // namespace slipwave::single_fracture_model_test
