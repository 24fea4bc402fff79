// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geology/horizon.hpp"
#include "geology/layers.hpp"
#include "io/netcdf_file.hpp"
#include "model_cases.hpp"

namespace slipwave::model_grid_horizon_test {
namespace {

constexpr double pi = std::numbers::pi;

Grid<3> cube_of(std::int64_t nx, std::int64_t ny, std::int64_t nz, double spacing_m) {
  Grid<3> grid;
  grid.shape = {nx, ny, nz};
  grid.spacing_m = spacing_m;
  return grid;
}

using Surface = std::function<double(double x, double y)>;

/// Rows "X Y DEPTH" of a surface at all of these x and y, x fastest.
std::vector<std::string> rows_of(const std::vector<double>& x, const std::vector<double>& y,
                                 const Surface& depth) {
  std::vector<std::string> rows;
  for (const double b : y)
    for (const double a : x) rows.push_back(shown(a) + ' ' + shown(b) + ' ' + shown(depth(a, b)));
  return rows;
}

std::string text_of(const std::vector<std::string>& rows) {
  std::string text;
  for (const auto& row : rows) text += row + '\n';
  return text;
}

std::vector<double> range(double from, double to, double step) {
  std::vector<double> values;
  for (int n = 0; from + n * step <= to + 1e-9; ++n) values.push_back(from + n * step);
  return values;
}

std::string refused(const std::string& content) {
  const TextFile file(content);
  const auto sentence = sentence_of([&] { Horizon::parse("@" + file.path()); });
  const std::string place = file.path() + ": ";
  return sentence.starts_with(place) ? sentence.substr(place.size()) : "no place: " + sentence;
}

const Layer soft{-1, 2500, 1200, 2000};
const std::string hard = ":4500:2250:2500";

}  // namespace

TEST(GridHorizon, IsBilinearBetweenNodesAndLevelBeyond) {
  const auto twisted = [](double x, double y) { return 200 + 0.3 * x - 0.2 * y + 1e-3 * x * y; };
  const TextFile file(text_of(rows_of({0, 100, 250}, {50, 80, 300, 310}, twisted)));
  const auto horizon = Horizon::parse("@" + file.path());
  EXPECT_TRUE(horizon.is_grid());
  EXPECT_FALSE(horizon.is_plane());
  for (const double x : {0., 30., 100., 249.})
    for (const double y : {50., 60., 80., 200., 310.}) EXPECT_NEAR(horizon.at(x, y), twisted(x, y), 1e-9);
  EXPECT_EQ(horizon.at(-40, 60), horizon.at(0, 60));
  EXPECT_EQ(horizon.at(300, 0), horizon.at(250, 50));
  EXPECT_EQ(horizon.at(70, 400), horizon.at(70, 310));
  EXPECT_EQ(horizon.from_m(0), 0);
  EXPECT_EQ(horizon.to_m(0), 250);
  EXPECT_EQ(horizon.from_m(1), 50);
  EXPECT_EQ(horizon.to_m(1), 310);
  // Straight along either axis where the surface is not.
  const TextFile bent("0 0 100\n100 0 200\n0 100 200\n100 100 100\n");
  EXPECT_NEAR(Horizon::parse("@" + bent.path()).at(50, 50), 150, 1e-12);
  EXPECT_NEAR(Horizon::parse("@" + bent.path()).at(25, 0), 125, 1e-12);
  EXPECT_NEAR(Horizon::parse("@" + bent.path(), 45).at(25, 0), 150, 1e-12);
}

TEST(GridHorizon, DoesNotDependOnTheOrderOfItsRows) {
  const auto surface = [](double x, double y) { return 300 + 40 * std::sin(x / 70) * std::cos(y / 90); };
  auto rows = rows_of(range(0, 500, 25), range(-100, 400, 20), surface);
  const TextFile sorted(text_of(rows));
  std::shuffle(rows.begin(), rows.end(), std::mt19937(4));
  rows.insert(rows.begin(), "\xef\xbb\xbf# X Y DEPTH");
  rows[7] += "  # a remark\r";
  std::replace(rows[9].begin(), rows[9].end(), ' ', ',');
  const TextFile shuffled(text_of(rows));
  for (const std::string kind : {"@", "smooth@"}) {
    const auto a = Horizon::parse(kind + sorted.path()), b = Horizon::parse(kind + shuffled.path());
    for (double x = -10; x < 520; x += 7.3)
      for (double y = -110; y < 420; y += 9.1) ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << ' ' << y;
  }
}

TEST(GridHorizon, TakesCoordinatesThatDifferByRoundingForOne) {
  const TextFile file("0 0 100\n1000 0.0001 200\n0.0002 500 300\n999.9999 500 400\n");
  EXPECT_NEAR(Horizon::parse("@" + file.path()).at(500, 250), 250, 1e-3);
}

TEST(GridHorizon, OfASmoothSurfaceGivesParabolasExactly) {
  const auto bowl = [](double x, double y) {
    return 300 - 0.4 * x + 5e-4 * x * x + 0.1 * y - 3e-4 * y * y + 2e-4 * x * y;
  };
  for (const auto& y : {std::vector<double>{0, 90, 100, 260, 500}, {0, 200, 500}}) {
    const TextFile file(text_of(rows_of({0, 80, 250, 300, 700}, y, bowl)));
    const auto horizon = Horizon::parse("smooth@" + file.path());
    for (double a = 0; a <= 700; a += 7)
      for (double b = 0; b <= 500; b += 11) ASSERT_NEAR(horizon.at(a, b), bowl(a, b), 1e-9) << a << ' ' << b;
  }
}

TEST(GridHorizon, OfASmoothSurfaceHasNoKinks) {
  std::mt19937 random(3);
  const auto rough = [&](double, double) { return 100 + double(random() % 1000) / 10; };
  const TextFile file(text_of(rows_of({0, 80, 250, 300, 700}, {0, 90, 100, 260, 500}, rough)));
  const auto horizon = Horizon::parse("smooth@" + file.path());
  const double step = 1e-4;
  for (const double x : {80., 250., 300.})
    for (const double y : {30., 90., 95., 300.}) {
      const double at = horizon.at(x, y);
      EXPECT_NEAR((at - horizon.at(x - step, y)) / step, (horizon.at(x + step, y) - at) / step, 1e-3);
    }
  for (const double x : {30., 80., 110., 650.})
    for (const double y : {90., 100., 260.}) {
      const double at = horizon.at(x, y);
      EXPECT_NEAR((at - horizon.at(x, y - step)) / step, (horizon.at(x, y + step) - at) / step, 1e-3);
    }
}

TEST(GridHorizon, ThatIsTheSameAlongYIsTheLine) {
  const std::vector<double> x = {0, 130, 300, 420, 600}, z = {100, 165, 240, 180, 200};
  std::string line;
  for (std::size_t n = 0; n < x.size(); ++n) line += shown(x[n]) + ' ' + shown(z[n]) + '\n';
  const auto depth = [&](double a, double) {
    return z[std::size_t(std::find(x.begin(), x.end(), a) - x.begin())];
  };
  const TextFile curve(line), surface(text_of(rows_of(x, {0, 40, 70, 200}, depth)));
  const auto grid = cube_of(60, 20, 30, 10);
  for (const std::string kind : {"@", "smooth@"}) {
    const auto extruded = layered_medium(grid, {soft, parse_layer(kind + curve.path() + hard + ":4")});
    const auto found = layered_medium(grid, {soft, parse_layer(kind + surface.path() + hard + ":4")});
    for (std::size_t cell = 0; cell < found.vp.size(); ++cell) {
      ASSERT_NEAR(found.vp[cell], extruded.vp[cell], 1e-3) << place_of(grid, std::int64_t(cell));
      ASSERT_NEAR(found.vs[cell], extruded.vs[cell], 1e-3);
      ASSERT_NEAR(found.rho[cell], extruded.rho[cell], 1e-3);
    }
  }
}

TEST(GridHorizon, ThatIsAPlaneIsTheDippingPlane) {
  // Three layers, the plane at a slope of 1/2, along x as the formula has it, and the same along y.
  const auto grid = cube_of(40, 40, 40, 10);
  const double dip = std::atan(0.5) * 180 / pi;
  const auto plane =
      layered_medium(grid, {soft, Layer(103, 4500, 2250, 2500, dip), Layer(157, 3000, 1500, 2200, dip)});
  const auto nodes = range(0, 400, 80);
  const auto medium = [&](const Surface& top) {
    const TextFile upper(text_of(rows_of(nodes, nodes, top)));
    const TextFile lower(text_of(rows_of(nodes, nodes, [&](double x, double y) { return top(x, y) + 54; })));
    return layered_medium(grid, {soft, parse_layer("@" + upper.path() + hard),
                                 parse_layer("@" + lower.path() + ":3000:1500:2200")});
  };
  const auto along_x = medium([](double x, double) { return 103 + x / 2; });
  const auto along_y = medium([](double, double y) { return 103 + y / 2; });
  // Kinds and centres sit on the edges of level nodes: nowhere nearer to a top than rounding.
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const auto turned = std::size_t(grid.flat({at[1], at[0], at[2]}));
    for (const auto property : {&Medium<3>::vp, &Medium<3>::vs, &Medium<3>::rho}) {
      const double expected = (plane.*property)[std::size_t(cell)];
      ASSERT_NEAR((along_x.*property)[std::size_t(cell)], expected, 1e-3) << place_of(grid, cell);
      ASSERT_NEAR((along_y.*property)[turned], expected, 1e-3) << place_of(grid, cell);
    }
  }
}

TEST(GridHorizon, ThatIsObliqueKeepsMass) {
  // A plane that dips along both axes: depth over the model's middle times its area is what is soft.
  const auto grid = cube_of(30, 50, 40, 10);
  const TextFile file(
      text_of(rows_of({0, 300}, {0, 500}, [](double x, double y) { return 60 + 0.4 * x + 0.3 * y; })));
  const auto medium = layered_medium(grid, {soft, parse_layer("@" + file.path() + hard)});
  const double middle = 60 + 0.4 * 150 + 0.3 * 250;
  EXPECT_NEAR(mass_of(medium) / (300. * 500), 2000 * middle + 2500 * (400 - middle), 1e-2);
}

// Proves (M1).
TEST(GridHorizon, FollowsADome) {
  // 120 m high, sampled every 20 m, in cells of 10 m. Of a surface with second derivatives of at most c the
  // bilinear one is off by c (20 m)^2/8 along each axis at most.
  const double height = 120, radius = 100, base = 260;
  const auto dome = [&](double x, double y) {
    return base - height * std::exp(-(std::pow(x - 300, 2) + std::pow(y - 280, 2)) / (2 * radius * radius));
  };
  const double curvature = height / (radius * radius), off = 2 * curvature * 20 * 20 / 8;
  const TextFile file(text_of(rows_of(range(0, 600, 20), range(0, 560, 20), dome)));
  const auto grid = cube_of(60, 56, 40, 10);
  const auto layer = parse_layer("@" + file.path() + hard);
  const auto centres = layered_medium(grid, {soft, layer}, Average::none);
  int above = 0, below = 0;
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const double top = dome(grid.centre(0, at[0]), grid.centre(1, at[1])), z = grid.centre(2, at[2]);
    if (std::abs(z - top) <= off) continue;
    ASSERT_EQ(centres.vp[std::size_t(cell)], z > top ? 4500 : 2500) << place_of(grid, cell);
    (z > top ? below : above) += 1;
  }
  EXPECT_LT(grid.size() - above - below, grid.size() / 40);
  // What the dome lifts is its integral over the model.
  const auto along = [&](double from, double to) {
    return radius * std::sqrt(pi / 2) *
           (std::erf(to / (radius * std::sqrt(2))) - std::erf(from / (radius * std::sqrt(2))));
  };
  const double volume = height * along(-300, 300) * along(-280, 280);
  const auto lifted = [&](const Medium<3>& medium) {
    return (mass_of(medium) - 600. * 560 * (2000 * base + 2500 * (400 - base))) / 500;
  };
  EXPECT_NEAR(lifted(layered_medium(grid, {soft, layer})) / volume, 1, 2e-3);
  EXPECT_NEAR(lifted(layered_medium(grid, {soft, parse_layer("smooth@" + file.path() + hard)})) / volume, 1,
              2e-3);
}

TEST(GridHorizon, LeavesVoidAboveATopography) {
  const auto hill = [](double x, double y) { return 20 + 0.1 * std::abs(x - 150) + 0.2 * std::abs(y - 100); };
  const TextFile file(text_of(rows_of({0, 150, 300}, {0, 100, 200}, hill)));
  const auto grid = cube_of(30, 20, 12, 10);
  const auto medium = layered_medium(grid, {parse_layer("@" + file.path() + ":3000:1500:2200")});
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const bool above = grid.centre(2, at[2]) < hill(grid.centre(0, at[0]), grid.centre(1, at[1]));
    ASSERT_EQ(medium.is_void(std::size_t(cell)), above) << place_of(grid, cell);
    if (!above) {
      ASSERT_EQ(medium.rho[std::size_t(cell)], 2200);
    }
  }
}

TEST(GridHorizon, SaysWhichNodeIsWrong) {
  EXPECT_EQ(refused("0 0 1\n10 0 2\n0 5 3\n"),
            "found no depth at x = 10, y = 5, expected one for each of 2 x with each of 2 y");
  EXPECT_EQ(refused("0 0 1\n10 0 2\n0 5 3\n# here\n10 5 4\n0 5 3\n"),
            "line 6: found a second depth at x = 0, y = 5 after that of line 3, expected one");
  EXPECT_EQ(refused("0 0 1\n10 0 2\n0 5 3\n10 5 nan\n"), "line 4: found 'nan', expected a number");
  EXPECT_EQ(refused("0 0 1\n10 0 two\n"), "line 2: found 'two', expected a number");
  EXPECT_EQ(refused("0 0 1\n10 0\n"), "line 2: found 2 values, expected X Y Z");
  EXPECT_EQ(refused("0 0 1\n10 0 2 3\n"), "line 2: found 4 values, expected X Y Z");
  EXPECT_EQ(refused("0 0 1\n10 0 2\n20 0 2\n"),
            "found 3 different x and 1 different y, expected at least 2 of each");
  EXPECT_EQ(
      refused("0 0 1\n3 2 2\n4 7 3\n9 5 3\n6 4 2\n"),
      "found 5 points at 5 different x and 5 different y, expected a grid: a point for every x with every y");
  EXPECT_EQ(refused("0 0 -10\n10 0 -20\n0 5 -30\n10 5 -40.5\n"),
            "found depths from -40.5 to -10 m, expected them to count downwards from the surface");
}

TEST(GridHorizon, WantsAModelInSpaceThatItReaches) {
  const TextFile file(text_of(rows_of({0, 500}, {20, 180}, [](double, double) { return 100.; })));
  const auto layer = parse_layer("@" + file.path() + hard);
  EXPECT_EQ(
      sentence_of([&] { layered_medium(grid_of(50, 20, 10), {layer}); }),
      "found a grid of depths over x and y in @" + file.path() + ", expected points X Z for a model in 2-D");
  EXPECT_EQ(sentence_of([&] { layered_medium(cube_of(50, 20, 10, 10), {layer}); }),
            "@" + file.path() +
                " reaches from y = 20 to 180 m, expected at least 5 to 195, the centres of the outer cells");
  EXPECT_EQ(sentence_of([&] { layered_medium(cube_of(60, 20, 10, 10), {layer}); }),
            "@" + file.path() +
                " reaches from x = 0 to 500 m, expected at least 5 to 595, the centres of the outer cells");
}

TEST(GridHorizon, SaysWhereItCutsLayersOff) {
  const auto grid = cube_of(50, 20, 30, 10);
  // Above 150 m where y < 100.
  const TextFile file(text_of(rows_of({0, 500}, {0, 200}, [](double, double y) { return 50 + y; })));
  const TextFile high(text_of(rows_of({0, 500}, {0, 200}, [](double, double) { return 40.; })));
  const Layer plane(150, 3000, 1500, 2200);
  const auto layer = parse_layer("@" + file.path() + hard);
  const auto sentences = cut_off_layers(grid, {soft, plane, layer});
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0], "the layer at 150 m is cut off by the one at @" + file.path() +
                              " between x=5 and x=495, y=5 and y=95");
  EXPECT_TRUE(cut_off_layers(grid, {soft, layer}).empty());
  EXPECT_EQ(
      sentence_of([&] {
        layered_medium(grid, {plane, parse_layer("@" + high.path() + hard)});
      }),
      "the layer at @" + high.path() +
          " lies above the one before it, at 150 m, all along the model; expected them from the top down");
}

}  // namespace slipwave::model_grid_horizon_test
