// SPDX-License-Identifier: BSD-3-Clause
// Plane waves at an angle: through layers, from below a free surface, in 3-D, and what the edges add to the
// field that a body scatters.
#include <gtest/gtest.h>

#include <numbers>

#include "cube.hpp"
#include "fitted_medium.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_oblique_wave_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Rock upper{3000, 1500, 2200}, lower{4500, 2500, 2500}, sea_water{1500, 0, 1000};

/// One wave that a plane wave makes: direction of motion times amplitude, and its slowness along z.
struct Arrival {
  double amplitude, vx, vz, down;
};

/// vx and vz at a point x from the place where the waves meet and z below it, in units of the incident wave,
/// which is there at `first_s`.
std::array<std::vector<double>, 2> sum_of_waves(const std::vector<Arrival>& waves, const Wavelet& wavelet,
                                                double slowness, double first_s, double x, double z,
                                                std::int64_t samples, double dt_s) {
  std::array<std::vector<double>, 2> sum;
  for (std::int64_t n = 0; n < samples; ++n) {
    double vx = 0, vz = 0;
    for (const auto& wave : waves) {
      const double w = wave.amplitude * wavelet(double(n) * dt_s - first_s - slowness * x - wave.down * z);
      vx += wave.vx * w;
      vz += wave.vz * w;
    }
    sum[0].push_back(vx);
    sum[1].push_back(vz);
  }
  return sum;
}

double relative_error_of(const Gather& gather, std::size_t receiver, std::size_t receivers,
                         const std::array<std::vector<double>, 2>& exact) {
  std::vector<double> found, expected;
  for (std::size_t component = 0; component < 2; ++component) {
    const auto& samples = gather.traces[component * receivers + receiver].samples;
    found.insert(found.end(), samples.begin(), samples.end());
    expected.insert(expected.end(), exact[component].begin(), exact[component].end());
  }
  return relative_error(found, expected);
}

Scene<2> scene_of(const Medium<2>& medium, const std::string& kind, const Point<2>& reference,
                  double duration_s) {
  Scene<2> scene;
  scene.model.medium = medium;
  scene.model.fracture = Field<2, std::uint8_t>(medium.grid());
  scene.survey.sources = {{reference, parse_mechanism<2>(kind), parse_wavelet("ricker:20"), 1}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, duration_s, 0.001};
  scene.numerics.zone_cells = 12;
  return scene;
}

Medium<2> two_layers(std::int64_t nx, std::int64_t nz, double h, double depth_m) {
  auto medium = uniform_medium(nx, nz, h, upper);
  for (std::int64_t k = std::llround(depth_m / h); k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(medium, {i, k}, lower);
  return medium;
}

/// Aki & Richards (2002), (5.39) and (5.40): a P wave of slowness p comes down to the interface of two
/// solids. Waves above: incident P, reflected P and S; below: P and S.
std::array<std::vector<Arrival>, 2> at_interface(const Rock& one, const Rock& two, double p) {
  const auto down = [p](double c) { return std::sqrt(1 / (c * c) - p * p); };
  const double qa1 = down(one.vp), qb1 = down(one.vs), qa2 = down(two.vp), qb2 = down(two.vs);
  const double mu1 = one.rho * one.vs * one.vs, mu2 = two.rho * two.vs * two.vs;
  const double above = one.rho - 2 * mu1 * p * p, below = two.rho - 2 * mu2 * p * p;
  const double a = below - above, b = below + 2 * mu1 * p * p, c = above + 2 * mu2 * p * p,
               d = 2 * (mu2 - mu1);
  const double e = b * qa1 + c * qa2, f = b * qb1 + c * qb2, g = a - d * qa1 * qb2, h = a - d * qa2 * qb1;
  const double det = e * f + g * h * p * p;
  const double pp = ((b * qa1 - c * qa2) * f - (a + d * qa1 * qb2) * h * p * p) / det;
  const double ps = -2 * qa1 * (a * b + c * d * qa2 * qb2) * p * one.vp / (one.vs * det);
  const double through_p = 2 * one.rho * qa1 * f * one.vp / (two.vp * det);
  const double through_s = 2 * one.rho * qa1 * h * p * one.vp / (two.vs * det);
  return {{{{1, p * one.vp, qa1 * one.vp, qa1},
            {pp, p * one.vp, -qa1 * one.vp, -qa1},
            {ps, qb1 * one.vs, p * one.vs, -qb1}},
           {{through_p, p * two.vp, qa2 * two.vp, qa2}, {through_s, qb2 * two.vs, -p * two.vs, qb2}}}};
}

// Proves (A16).
TEST(ObliquePlaneWave, IsReflectedConvertedAndTransmittedAsAkiAndRichardsSay) {
  const double h = 5, depth = 250, side = 500;
  for (const double angle : {15., 35., -35.}) {
    if (!long_form() && angle == 35) continue;
    const double p = std::sin(angle * pi / 180) / upper.vp, q = std::cos(angle * pi / 180) / upper.vp;
    const Point<2> reference = {side / 2, -250};
    auto scene = scene_of(two_layers(100, 100, h, depth), "plane:" + std::to_string(angle), reference, 0.6);
    scene.survey.receivers_m = {{102.5, 122.5}, {402.5, 122.5}, {102.5, 377.5}, {402.5, 377.5}};
    check(scene);
    const Gather gather = shoot(scene, 1);
    const auto waves = at_interface(upper, lower, p);
    for (std::size_t n = 0; n < 4; ++n) {
      const auto& at = scene.survey.receivers_m[n];
      const auto exact =
          sum_of_waves(waves[at[1] > depth], scene.survey.sources[0].wavelet, p, q * (depth - reference[1]),
                       at[0] - reference[0], at[1] - depth, gather.axis.count, 0.001);
      // 6 cells to the shortest S wave that counts (50 Hz).
      EXPECT_LT(relative_error_of(gather, n, 4, exact), 0.02) << angle << " degrees, receiver " << n;
    }
  }
}

/// A top that lies on no faces stretches the rows above and below it, which stay level.
TEST(ObliquePlaneWave, CrossesLevelRowsOfOtherHeightsAsAkiAndRichardsSay) {
  const double depth = 203, angle = 25, p = std::sin(angle * pi / 180) / upper.vp,
               q = std::cos(angle * pi / 180) / upper.vp;
  const Point<2> reference = {150, -150};
  const auto medium = fitted_medium<2>(
      Grid<2>{{60, 80}, 5},
      {{dipping(0, 0), upper.vp, upper.vs, upper.rho}, {dipping(depth, 0), lower.vp, lower.vs, lower.rho}});
  ASSERT_TRUE(medium.grid().rows);
  ASSERT_TRUE(medium.grid().rows->row_is_level(40));
  ASSERT_NE(medium.grid().height({0, 10}), 5);
  for (const std::string kind : {"plane:", "plane:-"}) {
    if (!long_form() && kind == "plane:") continue;
    auto scene = scene_of(medium, kind + std::to_string(angle), reference, 0.45);
    scene.survey.receivers_m = {{72.5, 122.5}, {222.5, 122.5}, {72.5, 302.5}, {222.5, 302.5}};
    check(scene);
    const Gather gather = shoot(scene, 1);
    const double along = kind == "plane:" ? p : -p;
    const auto waves = at_interface(upper, lower, along);
    for (std::size_t n = 0; n < 4; ++n) {
      const auto& at = scene.survey.receivers_m[n];
      const auto exact = sum_of_waves(waves[at[1] > depth], scene.survey.sources[0].wavelet, along,
                                      q * (depth - reference[1]), at[0] - reference[0], at[1] - depth,
                                      gather.axis.count, 0.001);
      EXPECT_LT(relative_error_of(gather, n, 4, exact), 0.02) << kind << " receiver " << n;
    }
  }
}

/// Aki & Richards (2002), (5.26) and (5.27): a P wave comes up to a free surface.
// Proves (A16).
TEST(ObliquePlaneWave, FromBelowIsReflectedAndConvertedByTheFreeSurface) {
  const double h = 5, side = 500, angle = 30, p = std::sin(angle * pi / 180) / upper.vp;
  const double qa = std::cos(angle * pi / 180) / upper.vp, qb = std::sqrt(1 / (upper.vs * upper.vs) - p * p);
  const double s = 1 / (upper.vs * upper.vs) - 2 * p * p, sum = s * s + 4 * p * p * qa * qb;
  const double pp = (4 * p * p * qa * qb - s * s) / sum, ps = 4 * upper.vp / upper.vs * p * qa * s / sum;
  const std::vector<Arrival> waves = {{1, p * upper.vp, -qa * upper.vp, -qa},
                                      {pp, p * upper.vp, qa * upper.vp, qa},
                                      {ps, qb * upper.vs, -p * upper.vs, qb}};
  const Point<2> reference = {side / 2, 750};
  auto scene =
      scene_of(uniform_medium(100, 100, h, upper), "plane:" + std::to_string(180 - angle), reference, 0.7);
  scene.edges[1][0] = EdgeLaw::free;
  scene.survey.receivers_m = {{102.5, 0}, {402.5, 0}, {102.5, 302.5}, {402.5, 302.5}};
  check(scene);
  const Gather gather = shoot(scene, 1);
  for (std::size_t n = 0; n < 4; ++n) {
    const auto& at = scene.survey.receivers_m[n];
    const auto exact = sum_of_waves(waves, scene.survey.sources[0].wavelet, p, qa * reference[1],
                                    at[0] - reference[0], at[1], gather.axis.count, 0.001);
    EXPECT_LT(relative_error_of(gather, n, 4, exact), 0.02) << "receiver " << n;
  }
}

/// Post-critical, with evanescent waves in the rock, and under a free surface: no closed form in time, but
/// the same traces however wide the model is.
// Proves (A16).
TEST(ObliquePlaneWave, InLayersIsTheSameHoweverWideTheModelIs) {
  const auto gather = [](std::int64_t nx, const std::string& kind, EdgeLaw top) {
    const double h = 5;
    auto medium = two_layers(nx, 70, h, 200);
    for (std::int64_t k = 0; k < 20 && top == EdgeLaw::free; ++k)
      for (std::int64_t i = 0; i < nx; ++i) put(medium, {i, k}, sea_water);
    const double middle = double(nx) * h / 2;
    auto scene = scene_of(medium, kind, {middle, top == EdgeLaw::free ? 700. : -300.}, 0.6);
    scene.edges[1][0] = top;
    scene.numerics.zone_cells = 12;
    scene.survey.sources[0].wavelet = parse_wavelet("ricker:15");
    scene.survey.receivers_m = {{middle - 50, 52}, {middle + 50, 152}, {middle, 302}};
    check(scene);
    return samples_of(shoot(scene, 1));
  };
  for (const auto& [kind, top] : {std::pair{std::string("plane:50"), EdgeLaw::absorbing},
                                  std::pair{std::string("plane-s:40"), EdgeLaw::absorbing},
                                  std::pair{std::string("plane:155"), EdgeLaw::free}})
    EXPECT_LT(relative_error(gather(30, kind, top), gather(50, kind, top)), 0.01) << kind;
}

TEST(ObliquePlaneWave, NeedsTheSameLayersAtBothSides) {
  auto scene = scene_of(two_layers(40, 80, 5, 200), "plane:20", {0, -300}, 0.2);
  EXPECT_NO_THROW(check(scene));
  put(scene.model.medium, {20, 60}, upper);
  EXPECT_NO_THROW(check(scene)) << "what is not at the sides scatters";
  put(scene.model.medium, {39, 60}, upper);
  EXPECT_THROW(check(scene), Error);
  put(scene.model.medium, {39, 60}, lower);
  scene.survey.sources[0].mechanism = parse_mechanism<2>("plane:90");
  EXPECT_THROW(check(scene), Error) << "along the layers";
  scene.survey.sources[0].mechanism = parse_mechanism<2>("plane:20");
  scene.survey.sources[0].position_m = {0, 350};
  EXPECT_THROW(check(scene), Error) << "already at the body";
}

/// In 3-D, across y the same everywhere.
// Proves (A16).
TEST(ObliquePlaneWave, TravelsThroughLayersIn3DAsIn2D) {
  const auto flat = two_layers(24, 28, 5, 60);
  for (const auto& [kind, flanks] :
       {std::pair{"plane:20", EdgeLaw::mirror}, std::pair{"plane-s:-30", EdgeLaw::absorbing}}) {
    auto scene = scene_of(flat, kind, {60, -80}, 0.16);
    scene.numerics.zone_cells = 6;
    scene.survey.receivers_m = {{62.5, 32.5}, {32.5, 102.5}};
    check(scene);
    Scene<3> cube;
    const Grid<3> grid{{24, 4, 28}, 5};
    cube.model.medium = Medium<3>(grid, flat);
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const auto at = grid.index(n);
      for (const auto property : flat.properties())
        cube.model.medium[property][std::size_t(n)] = flat[property]({at[0], at[2]});
    }
    cube.model.fracture = Field<3, std::uint8_t>(grid);
    cube.survey.sources = {{{60, 10, -80}, parse_mechanism<3>(kind), parse_wavelet("ricker:20"), 1}};
    cube.survey.receivers_m = {{62.5, 7.5, 32.5}, {32.5, 12.5, 102.5}};
    for (auto& law : cube.edges.law) law = {EdgeLaw::absorbing, EdgeLaw::absorbing};
    cube.edges[1] = {flanks, flanks};
    cube.numerics.zone_cells = 6;
    cube.recording = {{Component::vx, Component::vz}, 0.16, 0.001};
    check(cube);
    EXPECT_LT(relative_error(samples_of(shoot(cube, 1)), samples_of(shoot(scene, 1))), 5e-3) << kind;
  }
}

Scene<3> cube_of(const Medium<2>& column, std::int64_t side, const std::string& kind, double depth_m) {
  Scene<3> cube;
  const Grid<3> grid{{side, side, column.grid().shape[1]}, column.grid().spacing_m};
  cube.model.medium = Medium<3>(grid, column);
  for (std::int64_t n = 0; n < grid.size(); ++n)
    for (const auto property : column.properties())
      cube.model.medium[property][std::size_t(n)] = column[property]({0, grid.index(n)[2]});
  cube.model.fracture = Field<3, std::uint8_t>(grid);
  cube.survey.sources = {{{25, 30, depth_m}, parse_mechanism<3>(kind), parse_wavelet("ricker:20"), 1}};
  cube.survey.receivers_m = {{42.5, 12.5, 42.5}, {12.5, 37.5, 87.5}};
  for (auto& law : cube.edges.law) law = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  cube.numerics.zone_cells = 6;
  cube.recording = {{Component::vx, Component::vy, Component::vz}, 0.16, 0.002};
  return cube;
}

/// What the receivers of a cube recorded, as a scene in the plane of travel records it: along it, then down;
/// behind them what is across it.
std::vector<double> in_plane_of_travel(const Gather& gather, double azimuth_deg) {
  const double c = std::cos(azimuth_deg * pi / 180), s = std::sin(azimuth_deg * pi / 180);
  std::vector<double> along, down, across;
  for (std::size_t n = 0; n < 2; ++n) {
    const auto &x = gather.traces[n].samples, &y = gather.traces[n + 2].samples,
               &z = gather.traces[n + 4].samples;
    down.insert(down.end(), z.begin(), z.end());
    for (std::size_t k = 0; k < x.size(); ++k) {
      along.push_back(c * x[k] + s * y[k]);
      across.push_back(c * y[k] - s * x[k]);
    }
  }
  along.insert(along.end(), down.begin(), down.end());
  along.insert(along.end(), across.begin(), across.end());
  return along;
}

/// In layers as a wave in 2-D, whose layers are the closed forms of the tests above.
// Proves (A16).
TEST(ObliquePlaneWave, TravelsInAnyVerticalPlaneIn3DAsIn2D) {
  const auto flat = two_layers(36, 24, 5, 60);
  struct Case {
    const char* kind;
    double azimuth_deg, from_m;
    EdgeLaw top;
  };
  for (const auto& [kind, azimuth_deg, from_m, top] :
       {Case{"plane-s:-30", 45, -20, EdgeLaw::absorbing}, Case{"plane:155", -120, 160, EdgeLaw::free}}) {
    auto cube = cube_of(flat, 10, kind + ("," + std::to_string(azimuth_deg)), from_m);
    cube.edges[2][0] = top;
    cube.numerics.zone_cells = 4;
    auto scene = scene_of(flat, kind, {90, from_m}, cube.recording.duration_s);
    scene.recording.interval_s = cube.recording.interval_s;
    scene.edges[1][0] = top;
    scene.numerics.zone_cells = cube.numerics.zone_cells;
    for (const auto& at : cube.survey.receivers_m)
      scene.survey.receivers_m.push_back({90 + (at[0] - 25) * std::cos(azimuth_deg * pi / 180) +
                                              (at[1] - 30) * std::sin(azimuth_deg * pi / 180),
                                          at[2]});
    check(scene);
    check(cube);
    auto expected = samples_of(shoot(scene, 1));
    expected.resize(expected.size() * 3 / 2, 0);  // nothing moves across the plane of travel
    EXPECT_LT(relative_error(in_plane_of_travel(shoot(cube, 1), azimuth_deg), expected), 5e-3) << kind;
  }
}

// Proves (A16).
TEST(ObliquePlaneWave, OfOneMediumHasItsClosedFormAtAnyAzimuth) {
  for (const int time_order : {2, 4}) {
    auto cube = cube_of(uniform_medium(36, 20, 5, upper), 10, "plane:40,45", -20);
    cube.recording.duration_s = 0.09;
    cube.numerics.zone_cells = 3;  // nothing is scattered
    cube.numerics.time_order = time_order;
    if (time_order == 4) cube.numerics.cfl = 1.9;
    cube.recording.components = {Component::vx, Component::vy, Component::vz};
    check(cube);
    const auto& wave = std::get<PlaneWave<3>>(cube.survey.sources[0].mechanism);
    const auto gather = shoot(cube, 1);
    std::vector<double> expected;
    for (const double part : wave.direction)
      for (const auto& at : cube.survey.receivers_m)
        for (std::size_t n = 0; n < gather.traces[0].samples.size(); ++n) {
          double way = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
            way += wave.direction[axis] * (at[axis] - cube.survey.sources[0].position_m[axis]);
          expected.push_back(part * cube.survey.sources[0].wavelet(double(n) * 0.002 - way / upper.vp));
        }
    EXPECT_LT(relative_error(samples_of(gather), expected), 5e-3) << time_order;
  }
}

TEST(ObliquePlaneWave, WithAnAzimuthNeedsTheSideItEntersBy) {
  auto cube = cube_of(uniform_medium(36, 20, 5, upper), 10, "plane:40,45", -20);
  cube.edges[1][1] = EdgeLaw::mirror;
  EXPECT_NO_THROW(check(cube));
  cube.edges[1][0] = EdgeLaw::mirror;
  EXPECT_THROW(check(cube), Error);
  cube.survey.sources[0].mechanism = parse_mechanism<3>("plane:40");
  EXPECT_NO_THROW(check(cube));
}

/// What a soft block scatters, recorded round it, in a model whose edges lie that far beyond the receivers.
std::vector<double> scattered(const std::string& kind, double h, double margin_m) {
  const double side = 600 + 2 * margin_m;
  const auto n = std::int64_t(std::llround(side / h));
  const Rock host{4500, 2250, 2500}, soft{3600, 1700, 2300};
  std::vector<double> samples[2];
  for (const bool with_block : {false, true}) {
    auto medium = uniform_medium(n, n, h, host);
    const auto first = std::llround((margin_m + 200) / h), last = std::llround((margin_m + 400) / h);
    for (auto k = first; k < last && with_block; ++k)
      for (auto i = first; i < last; ++i) put(medium, {i, k}, soft);
    auto scene = scene_of(medium, kind, {side / 2, side / 2 - 900}, 0.75);
    scene.numerics.zone_cells = 0;
    scene.survey.sources[0].wavelet = parse_wavelet("ricker:7.5");
    for (const double x : {60., 300., 540.})
      for (const double z : {60., 540.}) scene.survey.receivers_m.push_back({margin_m + x, margin_m + z});
    check(scene);
    samples[with_block] = samples_of(shoot(scene, 1));
  }
  for (std::size_t k = 0; k < samples[0].size(); ++k) samples[1][k] -= samples[0][k];
  return samples[1];
}

// Proves (E13).
TEST(PlaneWaveEdges, AddTheLessToAScatteredFieldTheFinerTheCells) {
  for (const char* kind : {"plane:0", "plane:30"}) {
    if (!long_form() && std::string(kind) == "plane:0") continue;
    double before = 0;
    for (const double h : {40., 20., 10.}) {
      const double error = relative_error(scattered(kind, h, 0), scattered(kind, h, 400));
      if (before > 0) {
        EXPECT_LT(error, 0.8 * before) << kind << ", " << h << " m";
      }
      before = error;
    }
    EXPECT_LT(before, 5e-3) << kind;
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_oblique_wave_test
