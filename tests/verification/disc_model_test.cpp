// SPDX-License-Identifier: BSD-3-Clause
// Single fractures of models in 3-D: what cells get of discs and polygons, files, pictures and networks.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.hpp"
#include "build/resample.hpp"
#include "cube.hpp"
#include "model/fracture_network.hpp"
#include "model/model_netcdf.hpp"
#include "model/planar_fracture.hpp"
#include "model/single_fracture.hpp"
#include "model/spline_shares.hpp"

namespace slipwave::disc_model_test {
namespace {

constexpr solver::Rock rock{4500, 2250, 2500};
constexpr double pi = std::numbers::pi, z_n = 2e-10, z_t = 5e-10;
using Polygon = FractureTrace<3>;

FractureSet<3> set_of(std::vector<Polygon> polygons) {
  SlipSystem<3> system{normal_of_polygon(polygons.front()), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {z_n, z_t, 0, 0, 0};
  return {"discs", {system}, std::move(polygons)};
}
Model<3> model_with(const FractureSet<3>& set, double h = 5) {
  Model<3> model;
  model.medium =
      solver::uniform_cube({std::llround(120 / h), std::llround(100 / h), std::llround(80 / h)}, h, rock);
  add_single_fractures(model, set);
  return model;
}
double distance(const Point<3>& a, const Point<3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(Discs, HaveTheAreaAndTheNormalTheyAreGiven) {
  const auto disc = parse_disc("50,60,70:20:30:40");
  EXPECT_NEAR(area_of(disc), pi * 400, 1e-9);
  const auto wanted = normal_of_dip(30, 40), normal = normal_of_polygon(disc);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::abs(normal[axis]), std::abs(wanted[axis]), 1e-12);
  for (const auto& vertex : disc) EXPECT_NEAR(distance(vertex, {50, 60, 70}), 20, 0.005 * 20);
  // A rectangle has its length along the dip and its width level.
  const auto plate = parse_rectangle("50,60,70:40,10:30:90");
  EXPECT_NEAR(area_of(plate), 400, 1e-9);
  double deepest = 0, widest = 0;
  for (const auto& vertex : plate)
    deepest = std::max(deepest, vertex[2]), widest = std::max(widest, vertex[0]);
  EXPECT_NEAR(deepest, 70 + 20 * std::sin(pi / 6), 1e-9);
  EXPECT_NEAR(widest, 55, 1e-9);
}

// Proves (S30).
TEST(Discs, GiveCellsTheirComplianceAndTheirPlace) {
  // However they lie among the cells: strain of all cells times their volume is that of the area, all 36
  // entries, and its middle is the centre.
  const Grid<3> grid{{30, 28, 26}, 5, {0, 0, 0}};
  for (const auto& text :
       {"70,65,60:20", "71.3,66.1,62.4:20:90", "72.5,67.5,62.5:31:35:25", "70,65,60:4:80:-120"}) {
    const auto disc = parse_disc(text);
    const auto wanted = strain_of_plane<3>(normal_of_polygon(disc), z_n, z_t);
    std::array<double, 36> sum{};
    Point<3> middle{};
    for (const auto& cell : cells_crossed(grid, set_of({disc}))) {
      const auto at = grid.index(std::int64_t(cell.cell));
      const double trace = cell.strain[0] + cell.strain[7] + cell.strain[14];
      for (std::size_t n = 0; n < 36; ++n) sum[n] += 125 * cell.strain[n];
      for (std::size_t axis = 0; axis < 3; ++axis)
        middle[axis] += 125 * trace * grid.centre(int(axis), at[axis]);
    }
    const double area = area_of(disc);
    for (std::size_t n = 0; n < 36; ++n) EXPECT_NEAR(sum[n] / area, wanted[n], 1e-12 * z_t) << text << n;
    const double whole = area * (wanted[0] + wanted[7] + wanted[14]);
    const auto centre = parse_point<3>(split(text, ':')[0]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(middle[axis] / whole, centre[axis], 1e-9) << text;
  }
}

TEST(Discs, SumUpToTheStrainOfAnOpenedAndAShearedPlane) {
  // A level plane under 1 Pa: tension opens it by Z_N, a shear slides it by Z_T, half of it strain.
  const auto strain = strain_of_plane<3>({0, 0, 1}, z_n, z_t);
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t of = 0; of < 6; ++of)
      EXPECT_NEAR(strain[c * 6 + of], c != of ? 0 : c == 2 ? z_n : c >= 4 ? z_t / 2 : 0, 1e-22);
}

TEST(Discs, AreTheSameInCellsWhoseAxesAreTurned) {
  const Grid<3> grid{{24, 24, 24}, 5, {0, 0, 0}};
  const auto turned = [](const Point<3>& at) { return Point<3>{at[2], at[0], at[1]}; };
  const auto disc = disc_of({61, 57, 62}, 24, unit_normal<3>({1, 2, -3}));
  Polygon other;
  for (const auto& vertex : disc) other.push_back(turned(vertex));
  const auto found = densities_of(grid, other);
  const auto all = densities_of(grid, disc);
  ASSERT_EQ(found.size(), all.size());
  for (const auto& [number, density] : all) {
    const auto at = grid.index(std::int64_t(number));
    EXPECT_NEAR(found.at(std::size_t(grid.flat({at[2], at[0], at[1]}))), density, 1e-9);
  }
}

TEST(Discs, AreThoseOfTheWholeInPartsOfTheGridAndOfPolygonsThatComeFromAfar) {
  const Grid<3> whole{{24, 20, 16}, 5, {0, 0, 0}};
  Grid<3> part = whole;
  part.first[2] = 5, part.shape[2] = 7;
  for (const auto& set : {set_of({parse_disc("60,50,40:33:35:20"), parse_disc("50,40,35:20:90")}),
                          set_of({{{-9e6, -8e6, 30}, {9e6, -8e6, 40}, {50, 9e6, 45}}})}) {
    std::size_t n = 0;
    const auto in_part = cells_crossed(part, set);
    for (const auto& cell : cells_crossed(whole, set)) {
      const auto at = whole.index(std::int64_t(cell.cell));
      if (at[2] < 5 || at[2] >= 12) continue;
      ASSERT_LT(n, in_part.size());
      EXPECT_EQ(in_part[n].cell, std::size_t(part.flat({at[0], at[1], at[2] - 5})));
      EXPECT_EQ(in_part[n++].strain, cell.strain);
    }
    EXPECT_EQ(n, in_part.size());
    EXPECT_GT(n, 100U);
  }
}

TEST(Discs, AreTheSameFromAFileAndInOtherCells) {
  const auto path = std::filesystem::temp_directory_path() / ("discs-" + std::to_string(getpid()) + ".nc");
  const auto set = set_of({parse_disc("60,50,40:20:35:20"), parse_rectangle("40,40,30:20,10:70")});
  const auto model = model_with(set);
  write_model(model, path.string());
  const auto read = read_model<3>(path.string());
  std::filesystem::remove(path);
  ASSERT_EQ(read.fracture_sets.size(), 1U);
  EXPECT_EQ(read.fracture_sets[0].traces, set.traces);
  check(read);
  const auto finer = regridded(model, 2.5), built = model_with(set, 2.5);
  EXPECT_TRUE(std::equal(finer.fracture.begin(), finer.fracture.end(), built.fracture.begin()));
  EXPECT_NEAR(cropped(model, {{0, 0, 10}, {120, 100, 80}}).fracture_sets[0].traces[0][0][2],
              set.traces[0][0][2] - 10, 1e-9);
}

TEST(Discs, KeepTheirAreaAndTheirPlaceWhereRowsBend) {
  Grid<3> grid{{24, 20, 16}, 5, {0, 0, 0}};
  std::vector<double> corners;
  for (int k = 0; k <= 16; ++k)
    for (int j = 0; j <= 20; ++j)
      for (int i = 0; i <= 24; ++i) corners.push_back(5 * k + 4 * std::sin(0.3 * i + 0.2 * j));
  grid.rows = std::make_shared<RowDepths<3>>(grid.shape, corners);
  const auto disc = parse_disc("60,50,40:20:35:20");
  double area = 0;
  Point<3> middle{};
  for (const auto& [number, density] : densities_of(grid, disc)) {
    const auto at = grid.index(std::int64_t(number));
    const double part = density * 25 * grid.height(at);
    area += part;
    const Point<3> centre = {grid.centre(0, at[0]), grid.centre(1, at[1]), grid.depth(at)};
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += part * centre[axis];
  }
  EXPECT_NEAR(area / area_of(disc), 1, 1e-12);
  // Corners are joined by straight lines, splines reach over some of them.
  EXPECT_NEAR(middle[0] / area, 60, 1e-9);
  EXPECT_NEAR(middle[1] / area, 50, 1e-9);
  EXPECT_NEAR(middle[2] / area, 40, 0.2);
}

TEST(Discs, EndWithTheModel) {
  // A segment of a circle is left; cells get of it what lies in them.
  const Grid<3> grid{{24, 20, 16}, 5, {0, 0, 0}};
  const auto left = clipped(parse_disc("60,50,10:30:90"), box_of_grid(grid));
  const double exact = pi * 900 - (900 * std::acos(1 / 3.) - 10 * std::sqrt(800.));
  EXPECT_NEAR(area_of(left) / exact, 1, 3e-3);
  check_trace(grid, left);
  double area = 0;
  for (const auto& [number, density] : densities_of(grid, left)) area += 125 * density;
  // Of points within a cell of the edge a part counts to cells beyond it.
  EXPECT_LT(area, area_of(left));
  EXPECT_GT(area, area_of(left) - 60 * 5 / 4.);
  EXPECT_TRUE(clipped(parse_disc("60,50,-40:30:90"), box_of_grid(grid)).empty());
  EXPECT_EQ(clipped(parse_disc("60,50,40:30:90"), box_of_grid(grid)), parse_disc("60,50,40:30:90"));
  EXPECT_THROW(check_trace(grid, parse_disc("60,50,10:30:90")), Error);
}

TEST(Discs, AreSeenOnSectionsWhereTheseMeetThem) {
  const auto disc = parse_disc("60,50,40:30:90");  // across x
  const auto on_y = met_by_plane(disc, 1, 60, 2.5);
  ASSERT_EQ(on_y.size(), 1U);
  for (const auto& end : on_y[0]) EXPECT_NEAR(end[0], 60, 1e-9);
  EXPECT_NEAR(std::abs(on_y[0][1][1] - on_y[0][0][1]) / (2 * std::sqrt(800.)), 1, 0.005);
  EXPECT_TRUE(met_by_plane(disc, 1, 81, 2.5).empty());
  EXPECT_EQ(met_by_plane(disc, 0, 61, 2.5)[0].size(), disc.size() + 1);
  EXPECT_TRUE(met_by_plane(disc, 0, 63, 2.5).empty());
  // An outline with a notch is met twice.
  const Polygon notched = {{0, 0, 0}, {40, 0, 0}, {40, 0, 30}, {20, 0, 10}, {0, 0, 30}};
  EXPECT_EQ(met_by_plane(notched, 2, 20, 1).size(), 2U);
  EXPECT_NEAR(area_of(notched), 800, 1e-9);
}

TEST(Discs, TakeCellsOfClustersAndAreRefusedWhereTheyCanNotBe) {
  auto model = model_with(set_of({parse_disc("60,50,40:20:35:20")}));
  add_fractures<3>(model, {"cluster", {SlipSystem<3>{{0, 0, 1}, 0.3, 0, 0}}},
                   [](const Point<3>& at) { return at[0] < 50; });
  EXPECT_GT(add_single_fractures(model, set_of({parse_disc("40,50,40:20")})).taken, 0);
  check(model);
  const auto fault = [](const Polygon& polygon) { return fault_of_polygon(polygon); };
  EXPECT_EQ(fault(parse_disc("60,50,40:20:35:20")), "");
  EXPECT_NE(fault({{0, 0, 0}, {1, 0, 0}}).find("2 points"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}).find("without area"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 0}, {10, 0, 0}, {10, 10, 1}, {0, 10, 0}}).find("bends"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 0}, {10, 0, 0}, {10, 0, 0}, {0, 10, 0}}).find("twice"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 20, 0}}).find("crosses itself"),
            std::string::npos);
  EXPECT_NE(fault({{0, 0, 0}, {10, 10, 0}, {NAN, 0, 0}}).find("without end"), std::string::npos);
  for (const auto* const text : {"1,2,3", "1,2:3", "1,2,3:0", "1,2,3:4,5", "1,2,3:4:91", "1,2,3:4:5:6:7"})
    EXPECT_THROW(parse_disc(text), Error) << text;
  auto damped = model_with(set_of({parse_disc("60,50,40:20:35:20")}));
  damped.fracture_sets[0].systems[0].compliance.normal_dashpot_pa_s_m = 1;
  EXPECT_THROW(check(damped), Error);
  auto on_faces = model_with(set_of({parse_disc("60,50,40:20")}));
  on_faces.fracture_sets[0].on_faces = true;
  EXPECT_THROW(check(on_faces), Error);
}

// Proves (S31a).
TEST(DiscNetwork, HasTheRadiiAndPolesItIsDrawnFrom) {
  const Grid<3> grid{{200, 200, 200}, 10, {0, 0, 0}};
  FractureNetwork of{4000, 0, 10, 200, 2.5, 60, 8, 7, 30};
  const auto region = region_of_box<3>({{500, 500, 500}, {1500, 1500, 1500}});
  const auto all = drawn_fractures(grid, region, of);
  ASSERT_EQ(all.size(), 4000U);
  const auto power = [](double radius) { return std::pow(radius, 1 - 2.5); };
  for (const double radius : {15., 30., 80.}) {
    double larger = 0;
    for (const auto& disc : all) larger += area_of(disc) > pi * radius * radius;
    EXPECT_NEAR(larger / 4000, (power(radius) - power(200)) / (power(10) - power(200)), 0.025) << radius;
  }
  // The mean cosine from the mean pole is coth(kappa) - 1/kappa (S31a); all directions about it are alike.
  const auto mean = normal_of_dip(60, 30);
  Point<3> sum{};
  for (const auto& disc : all) {
    const auto normal = normal_of_polygon(disc);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis] / 4000;
  }
  double along = 0, across = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) along += sum[axis] * mean[axis];
  for (std::size_t axis = 0; axis < 3; ++axis) across += std::pow(sum[axis] - along * mean[axis], 2);
  EXPECT_NEAR(along, 1 / std::tanh(8.) - 1 / 8., 0.01);
  EXPECT_LT(std::sqrt(across), 0.02);
  // A smaller number is the beginning of a larger one.
  of.count = 10;
  const auto few = drawn_fractures(grid, region, of);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
  of.seed = 8;
  EXPECT_NE(drawn_fractures(grid, region, of), few);
}

// Proves (S31a).
TEST(DiscNetwork, OfNoConcentrationHasPolesInAllDirections) {
  const Grid<3> grid{{20, 20, 20}, 10, {0, 0, 0}};
  const auto all =
      drawn_fractures(grid, region_of_box<3>({{90, 90, 90}, {110, 110, 110}}), {3000, 0, 5, 5, 2, 20, 0, 3});
  // The second moment of normals is a third of the unit tensor.
  SymmetricTensor<3, double> moment;
  for (const auto& disc : all) {
    const auto n = normal_of_polygon(disc);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) moment(i, j) += n[std::size_t(i)] * n[std::size_t(j)] / 3000;
  }
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(moment.values[std::size_t(c)], c < 3 ? 1 / 3. : 0, 0.02);
  for (const double kappa : {1e-9, 0.5, 8., 2000.}) {
    double mean = 0;
    for (int n = 0; n < 100000; ++n) mean += drawn_cosine(kappa, (n + 0.5) / 100000) / 100000;
    EXPECT_NEAR(mean, kappa < 1e-6 ? 0 : 1 / std::tanh(kappa) - 1 / kappa, 1e-5) << kappa;
  }
}

// Proves (S31a).
TEST(DiscNetwork, HasTheIntensityAskedForAndEndsWithTheModel) {
  const Grid<3> grid{{40, 40, 40}, 10, {0, 0, 0}};
  const FractureNetwork of{0, 0.05, 20, 80, 2, -40, 5, 3};
  double area = 0, largest = 0;
  for (const auto& disc : drawn_fractures(grid, region_of_box<3>({{0, 0, 0}, {400, 400, 300}}), of)) {
    check_trace(grid, disc);
    area += area_of(disc);
    largest = std::max(largest, area_of(disc));
  }
  EXPECT_LE(std::abs(area - 0.05 * 400 * 400 * 300), largest / 2 + 1);
}

TEST(FractureTraces, InThreeDimensionsArePolygons) {
  const auto path =
      std::filesystem::temp_directory_path() / ("polygons-" + std::to_string(getpid()) + ".txt");
  std::ofstream(path) << "0 0 0\n10 0 0\n0,10,0\n> second\n0 0 5\n10 0 5\n10 10 5\n0 10 5\n";
  const std::vector<Polygon> two = {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}},
                                    {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}}};
  EXPECT_EQ(read_fracture_traces<3>(path.string()), two);
  std::ofstream(path) << "0 0 0\n10 0 0\n";
  try {
    read_fracture_traces<3>(path.string());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 1: found a fracture of two points, expected at least 3"),
              std::string::npos)
        << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace slipwave::disc_model_test
