// SPDX-License-Identifier: BSD-3-Clause
#include "geology/horizon.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "geology/layers.hpp"
#include "model_cases.hpp"

namespace slipwave::model_horizon_test {
namespace {

constexpr double pi = 3.141592653589793;

}  // namespace

TEST(Horizon, OfASineHasItsMeanItsCrestsAndItsPhase) {
  const auto sine = Horizon::parse("sine,400,30,1000");
  EXPECT_NEAR(sine.at(0), 400, 1e-12);
  EXPECT_NEAR(sine.at(250), 430, 1e-12);
  EXPECT_NEAR(sine.at(1750), 370, 1e-12);
  EXPECT_NEAR(Horizon::parse("sine,400,30,1000,90").at(0), 430, 1e-12);
  EXPECT_NEAR(Horizon::parse("sine,400,30,1000", 10).at(500), 400 + 500 * std::tan(pi / 18), 1e-9);
  EXPECT_FALSE(sine.is_plane());
}

TEST(Horizon, OfAFileIsStraightBetweenPointsAndLevelBeyond) {
  const TextFile file("\xef\xbb\xbf# x z\n0 100\n\n200,300 # a step down\r\n300 250\n");
  const auto curve = Horizon::parse("@" + file.path());
  EXPECT_EQ(curve.at(-50), 100);
  EXPECT_EQ(curve.at(0), 100);
  EXPECT_EQ(curve.at(50), 150);
  EXPECT_EQ(curve.at(200), 300);
  EXPECT_EQ(curve.at(260), 270);
  EXPECT_EQ(curve.at(1000), 250);
  EXPECT_EQ(curve.from_m(), 0);
  EXPECT_EQ(curve.to_m(), 300);
}

TEST(Horizon, OfASmoothCurveGoesThroughItsPointsWithoutAKink) {
  const TextFile file("0 100\n150 180\n300 190\n400 120\n700 300\n");
  const auto curve = Horizon::parse("smooth@" + file.path());
  for (const auto& [x, z] :
       std::vector<std::pair<double, double>>{{0, 100}, {150, 180}, {300, 190}, {400, 120}}) {
    EXPECT_NEAR(curve.at(x), z, 1e-9);
    if (x == 0) continue;
    const double step = 1e-4;
    EXPECT_NEAR((curve.at(x) - curve.at(x - step)) / step, (curve.at(x + step) - curve.at(x)) / step, 1e-4)
        << x;
  }
  EXPECT_EQ(curve.at(-10), 100);
}

TEST(Horizon, OfASmoothCurveGivesParabolasExactly) {
  std::string points;
  const auto parabola = [](double x) { return 300 - 0.4 * x + 5e-4 * x * x; };
  for (const double x : {0., 80., 250., 300., 700.})
    points += std::to_string(x) + ' ' + std::to_string(parabola(x)) + '\n';
  const TextFile file(points);
  const auto curve = Horizon::parse("smooth@" + file.path());
  for (double x = 0; x <= 700; x += 7) EXPECT_NEAR(curve.at(x), parabola(x), 1e-5) << x;
  const TextFile straight("0 100\n500 200\n");
  EXPECT_NEAR(Horizon::parse("smooth@" + straight.path()).at(125), 125, 1e-9);
}

TEST(Horizon, OfASmoothCurveIsNearerToWhatWasSampledThanStraightLines) {
  const auto sine = Horizon::parse("sine,400,50,1000");
  const auto error = [&](const std::string& kind, double spacing) {
    std::string points;
    for (double x = 0; x <= 1000; x += spacing)
      points += std::to_string(x) + ' ' + std::to_string(sine.at(x)) + '\n';
    const TextFile file(points);
    const auto curve = Horizon::parse(kind + file.path());
    double square = 0;
    for (double x = 0.5; x < 1000; ++x) square += std::pow(curve.at(x) - sine.at(x), 2);
    return std::sqrt(square / 1000);
  };
  for (const double spacing : {100., 50., 25.}) EXPECT_LT(error("smooth@", spacing), error("@", spacing) / 3);
  // Straight lines are of second order.
  EXPECT_NEAR(error("@", 50) / error("@", 25), 4, 0.2);
}

TEST(Horizon, IsParsedStrictly) {
  const auto sentence = [](const std::string& text) { return sentence_of([&] { Horizon::parse(text); }); };
  EXPECT_EQ(sentence("sine,400"), "found 'sine,400', expected sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]");
  EXPECT_EQ(sentence("sine,400,30,0"), "found a wavelength of 0 m, expected it above zero");
  EXPECT_EQ(sentence("cosine,400,30,1000"), "found 'cosine,400,30,1000', expected a number");
  EXPECT_EQ(sentence_of([] { Horizon::parse("10", 90); }),
            "found a dip of 90 degrees, expected it between -90 and 90");
}

TEST(Horizon, WantsPointsInOrder) {
  const TextFile file("0 100\n200 300\n200 310\n");
  EXPECT_EQ(sentence_of([&] { Horizon::parse("@" + file.path()); }),
            file.path() + ": line 3: found x = 200 after 200, expected x to ascend");
  const TextFile single("0 100\n");
  EXPECT_EQ(sentence_of([&] { Horizon::parse("@" + single.path()); }),
            single.path() + ": found 1 points, expected at least 2");
}

TEST(Layers, MayGainSpeedAndDensityWithDepth) {
  const auto layer = parse_layer("20:2000+0.5:900+0.25:1e+3-1e-1");
  EXPECT_EQ(layer.material, (Material{2000, 900, 1000}));
  EXPECT_EQ(layer.gradient, (Material{0.5, 0.25, -0.1}));
  const auto medium = layered_medium(grid_of(3, 10, 10), {layer});
  EXPECT_TRUE(medium.is_void(3));
  // Of rows of 10 m from 20 m down, centres lie 5, 15 ... m below the top.
  for (std::size_t row = 2; row < 10; ++row) {
    const double below = 10 * double(row - 2) + 5;
    EXPECT_FLOAT_EQ(medium.vp[3 * row], float(2000 + 0.5 * below));
    EXPECT_FLOAT_EQ(medium.vs[3 * row], float(900 + 0.25 * below));
    EXPECT_FLOAT_EQ(medium.rho[3 * row], float(1000 - 0.1 * below));
  }
}

TEST(Layers, GainWithDepthBelowTheirOwnTop) {
  // Along a dipping top the speed is the same everywhere, and so it is at any distance straight below.
  const auto grid = grid_of(60, 60, 10);
  const auto medium = layered_medium(grid, {parse_layer("50:2000+1:1000:2000:20")}, Average::none);
  const double slope = std::tan(pi / 9);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const double below = grid.centre(1, at[1]) - 50 - slope * grid.centre(0, at[0]);
    if (below < 0) continue;
    EXPECT_FLOAT_EQ(medium.vp[std::size_t(cell)], float(2000 + below));
  }
}

TEST(Layers, KeepMassUnderASine) {
  // Whole wavelengths: as much mass as under the plane through the mean. Chords instead of arcs are wrong by
  // the curvature, which cancels between crests and troughs.
  for (const double h : {20., 10., 5.}) {
    const auto grid = grid_of(std::int64_t(2000 / h), std::int64_t(500 / h), h);
    const auto wavy = layered_medium(
        grid, {parse_layer("-1:2500:1200:2000"), parse_layer("sine,250,80,500:4500:2250:2500")});
    EXPECT_NEAR(mass_of(wavy) / (2000. * 500), 2250, 1e-4) << h;
  }
}

TEST(Layers, FollowACurveAsTheyFollowThePlaneItIsPartOf) {
  const TextFile file("0 100\n130 165\n600 400\n");  // all on z = 100 + x/2
  const auto grid = grid_of(60, 60, 10);
  const auto curve = layered_medium(
      grid, {parse_layer("0:2500:1200:2000"), parse_layer("@" + file.path() + ":4500:2250:2500")});
  const auto plane = layered_medium(
      grid, {Layer(0, 2500, 1200, 2000), Layer(100, 4500, 2250, 2500, std::atan(0.5) * 180 / pi)});
  for (std::size_t cell = 0; cell < plane.vp.size(); ++cell) {
    EXPECT_NEAR(curve.vp[cell], plane.vp[cell], 1e-2);
    EXPECT_NEAR(curve.rho[cell], plane.rho[cell], 1e-2);
  }
}

TEST(Layers, LeaveVoidAboveATopography) {
  const TextFile file("0 100\n300 20\n600 140\n");
  const auto grid = grid_of(60, 30, 10);
  const auto medium = layered_medium(grid, {parse_layer("@" + file.path() + ":3000:1500:2200")});
  const auto top = Horizon::parse("@" + file.path());
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const bool above = grid.centre(1, at[1]) < top.at(grid.centre(0, at[0]));
    EXPECT_EQ(medium.is_void(std::size_t(cell)), above);
    // Rock is never thinned by the air beside it.
    if (!above) {
      EXPECT_EQ(medium.rho[std::size_t(cell)], 2200);
    }
  }
}

TEST(Layers, ThinnerThanACellStillWeighWhatTheyDo) {
  // A seam of 2 m in cells of 10 m, dipping; its centre line lies in the middle of a row at x = 0.
  const auto grid = grid_of(100, 60, 10);
  const auto medium =
      layered_medium(grid, {parse_layer("-1:2500:1200:2000"), parse_layer("204:2000:900:1500:10"),
                            parse_layer("206:2500:1200:2000:10")});
  EXPECT_NEAR(mass_of(medium), 2000. * 1000 * 600 - 500. * 1000 * 2, 1e2);  // rounded to float
}

TEST(Layers, SayWhereACurveCutsThemOff) {
  const auto grid = grid_of(100, 60, 10);
  const std::vector<Layer> crossing = {parse_layer("0:1500:0:1000"), parse_layer("200:2000:1000:2000"),
                                       parse_layer("sine,250,100,1000:3000:1500:2200")};
  const auto sentences = cut_off_layers(grid, crossing);
  ASSERT_EQ(sentences.size(), 1u);
  // sin < -1/2 between 7/12 and 11/12 of the wavelength.
  EXPECT_EQ(sentences[0],
            "the layer at 200 m is cut off by the one at sine,250,100,1000 between x=585 and x=915");
  EXPECT_TRUE(cut_off_layers(grid, {crossing[0], crossing[1]}).empty());
}

TEST(Layers, RefuseAPileThatIsNoPile) {
  const TextFile file("200 100\n700 100\n");
  const auto grid = grid_of(100, 60, 10);
  EXPECT_EQ(sentence_of([&] { layered_medium(grid, {parse_layer("@" + file.path() + ":3000:1500:2200")}); }),
            "@" + file.path() +
                " reaches from x = 200 to 700 m, expected at least 5 to 995, the centres of the outer cells");
  EXPECT_EQ(
      sentence_of([&] {
        layered_medium(grid,
                       {parse_layer("200:3000:1500:2200"), parse_layer("sine,100,20,500:3000:1500:2200")});
      }),
      "the layer at sine,100,20,500 lies above the one before it, at 200 m, all along the model; expected "
      "them from the top down");
}

TEST(Horizon, TakesPointsBelowAHeaderInItsUnits) {
  for (const char* text : {"x z\n0 50\n100 60\n200 40\n", "X;Depth\n0;50\n100;60\n200;40\n",
                           "Elevation [m], X [km]\n-50,0\n-60,0.1\n-40,0.2\n",
                           "x (ft) depth (ft)\n0 164.0419947506562\n328.0839895013123 196.8503937007874\n"
                           "656.1679790026247 131.2335958005249\n"}) {
    const TextFile file(text);
    const auto horizon = Horizon::parse("@" + file.path());
    EXPECT_NEAR(horizon.at(50), 55, 1e-9) << text;
    EXPECT_NEAR(horizon.at(150), 50, 1e-9) << text;
  }
  const TextFile grid("Y X Z\n0 0 50\n0 200 60\n100 0 40\n100 200 55\n");
  EXPECT_NEAR(Horizon::parse("@" + grid.path()).at(200, 0), 60, 1e-12);
  const TextFile wrong("x velocity\n0 50\n100 60\n");
  EXPECT_NE(sentence_of([&] {
              Horizon::parse("@" + wrong.path());
            }).find("line 1: found column 'velocity', expected x and z, depth or elevation, each once"),
            std::string::npos);
}

}  // namespace slipwave::model_horizon_test
