// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "accuracy/full_space.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_plane_wave_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Rock rock{4500, 2250, 2500};
const std::vector<Component> all_components = {Component::vx,  Component::vz,  Component::sxx,
                                               Component::szz, Component::sxz, Component::p};

Scene<2> plane_scene(const Medium<2>& medium, double angle_deg, const Point<2>& reference, double duration_s,
                     const std::string& kind = "plane") {
  Scene<2> scene;
  scene.model.medium = medium;
  scene.model.fracture = Field<2, std::uint8_t>(medium.grid());
  scene.survey.sources = {{reference, parse_mechanism<2>(kind + ":" + std::to_string(angle_deg)),
                           parse_wavelet("ricker:30"), 0.002}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {all_components, duration_s, 0.001};
  scene.numerics.zone_cells = 12;
  return scene;
}

// Proves (E2), (E13).
TEST(PlaneWave, PassesReceiversWithTheStressAndAtTheTimeOfTheClosedForm) {
  const double h = 5, side = 800;
  const auto n = std::int64_t(side / h);
  for (const double angle : {0., 20., 45., 160., -70.}) {
    if (!long_form() && (angle == 0 || angle == 45)) continue;
    const double sine = std::sin(angle * pi / 180), cosine = std::cos(angle * pi / 180);
    const Point<2> reference = {side / 2 - 700 * sine, side / 2 - 700 * cosine};
    auto scene = plane_scene(uniform_medium(n, n, h, rock), angle, reference, 0.35);
    scene.survey.receivers_m = {{400.3, 401.9}, {151.2, 640.4}, {660.7, 133.3}};
    check(scene);
    const Gather gather = shoot(scene, 1);
    const double mu = rock.mu(), lambda = rock.lambda(), strain = -0.002 / rock.vp;
    const double sxx = strain * (lambda + 2 * mu * sine * sine),
                 szz = strain * (lambda + 2 * mu * cosine * cosine);
    const double factors[] = {0.002 * sine,    0.002 * cosine, sxx, szz, strain * 2 * mu * sine * cosine,
                              -(sxx + szz) / 2};
    const auto wavelet = parse_wavelet("ricker:30");
    for (std::size_t receiver = 0; receiver < 3; ++receiver) {
      const auto& at = scene.survey.receivers_m[receiver];
      const double travel = ((at[0] - reference[0]) * sine + (at[1] - reference[1]) * cosine) / rock.vp;
      for (std::size_t row = 0; row < all_components.size(); ++row) {
        const auto& found = gather.traces[row * 3 + receiver].samples;
        const double unit = row < 2 ? 0.002 : rock.rho * rock.vp * 0.002;
        double worst = 0;
        for (std::size_t t = 0; t < found.size(); ++t)
          worst = std::max(worst, std::abs(found[t] - factors[row] * wavelet(double(t) * 0.001 - travel)));
        // 12 cells to the shortest wave that counts (76 Hz); the way through the grid is 700 m.
        EXPECT_LT(worst / unit, 0.02)
            << angle << " degrees, " << name_of(all_components[row]) << ", receiver " << receiver;
      }
    }
  }
}

// Proves (A15).
TEST(PlaneSWave, PassesReceiversWithTheStressAndAtTheTimeOfTheClosedForm) {
  const double h = 5, side = 600;
  const Rock slow{3600, 2000, 2300};
  const auto n = std::int64_t(side / h);
  for (const double angle : {0., 30., 160., -70.}) {
    if (!long_form() && (angle == 0 || angle == 160)) continue;
    const double sine = std::sin(angle * pi / 180), cosine = std::cos(angle * pi / 180);
    const Point<2> reference = {side / 2 - 450 * sine, side / 2 - 450 * cosine};
    auto scene = plane_scene(uniform_medium(n, n, h, slow), angle, reference, 0.5, "plane-s");
    scene.survey.sources[0].wavelet = parse_wavelet("ricker:15");
    scene.survey.receivers_m = {{300.3, 301.9}, {151.2, 440.4}};
    scene.recording.components = {Component::vx, Component::vz, Component::sxx, Component::szz,
                                  Component::sxz};
    check(scene);
    const Gather gather = shoot(scene, 1);
    // It moves rock across its way: d = (sine, cosine), v along (cosine, -sine).
    const double strain = -0.002 / slow.vs, mu = slow.mu();
    const double factors[] = {0.002 * cosine, -0.002 * sine, strain * 2 * mu * sine * cosine,
                              -strain * 2 * mu * sine * cosine,
                              strain * mu * (cosine * cosine - sine * sine)};
    const auto& wavelet = scene.survey.sources[0].wavelet;
    for (std::size_t receiver = 0; receiver < 2; ++receiver) {
      const auto& at = scene.survey.receivers_m[receiver];
      const double travel = ((at[0] - reference[0]) * sine + (at[1] - reference[1]) * cosine) / slow.vs;
      for (std::size_t row = 0; row < 5; ++row) {
        const auto& found = gather.traces[row * 2 + receiver].samples;
        double worst = 0;
        for (std::size_t t = 0; t < found.size(); ++t)
          worst = std::max(worst, std::abs(found[t] - factors[row] * wavelet(double(t) * 0.001 - travel)));
        // 10.7 cells to the shortest wave that counts (37 Hz).
        EXPECT_LT(worst / (row < 2 ? 0.002 : slow.rho * slow.vs * 0.002), 0.02)
            << angle << " degrees, row " << row << ", receiver " << receiver;
      }
    }
  }
}

TEST(PlaneSWave, NeedsRockWhereItEnters) {
  auto scene = plane_scene(uniform_medium(20, 20, 5, {1500, 0, 1000}), 0, {0, -160}, 0.2, "plane-s");
  EXPECT_THROW(check(scene), Error);
  scene.survey.sources[0].mechanism = parse_mechanism<2>("plane:0");
  EXPECT_NO_THROW(check(scene));
}

/// A stack of layers: the plane wave comes down from a half-space above and leaves into one below.
struct Layer {
  Rock rock;
  double top_m;
};

/// vz at depth z per unit of the incident wave at depth 0: upgoing over downgoing waves by recursion from the
/// bottom, amplitudes from the top.
std::complex<double> layered_velocity(const std::vector<Layer>& layers, double omega, double z) {
  const auto delay = [&](std::size_t n, double metres) {
    return std::polar(1., -omega * metres / layers[n].rock.vp);
  };
  std::vector<std::complex<double>> up(layers.size(), 0);  // up/down of vz at the top of each layer
  const auto impedance = [&](std::size_t n) { return layers[n].rock.rho * layers[n].rock.vp; };
  const auto thickness = [&](std::size_t n) { return layers[n + 1].top_m - layers[n].top_m; };
  const auto at_bottom = [&](std::size_t n) {
    const double r = (impedance(n) - impedance(n + 1)) / (impedance(n) + impedance(n + 1));
    return (r + up[n + 1]) / (1. + r * up[n + 1]);
  };
  for (std::size_t n = layers.size() - 1; n-- > 0;)
    up[n] = at_bottom(n) * delay(n, thickness(n)) * delay(n, thickness(n));
  std::complex<double> down = 1;
  std::size_t n = 0;
  for (; n + 1 < layers.size() && z > layers[n + 1].top_m; ++n) {
    const auto arriving = down * delay(n, thickness(n));
    down = arriving * (1. + at_bottom(n)) / (1. + up[n + 1]);  // vz is continuous
  }
  const double depth = z - layers[n].top_m;
  return down * (delay(n, depth) + up[n] / delay(n, depth));
}

Medium<2> layered_medium(std::int64_t nz, double h, const std::vector<Layer>& layers) {
  auto medium = uniform_medium(24, nz, h, layers[0].rock);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < 24; ++i)
      for (const auto& layer : layers)
        if ((double(k) + 0.5) * h > layer.top_m) put(medium, {i, k}, layer.rock);
  return medium;
}

// Proves (E8), (E13).
TEST(PlaneWave, CrossesLayersAsTheSumOfAllItsReflections) {
  const std::vector<Layer> layers = {
      {{2000, 900, 2000}, 0}, {{3300, 1800, 2300}, 300}, {{1800, 800, 1900}, 400}, {{4500, 2250, 2500}, 470}};
  const double h = 2.5, duration = 0.6;
  const auto medium = layered_medium(280, h, layers);
  for (const auto sides : {EdgeLaw::mirror, EdgeLaw::absorbing}) {
    if (!long_form() && sides == EdgeLaw::mirror) continue;
    auto scene = plane_scene(medium, 0, {0, 0}, duration);
    scene.edges[0] = {sides, sides};
    scene.survey.receivers_m = {{31, 21.3}, {31, 352.2}, {31, 433.1}, {31, 600.9}};
    check(scene);
    const Gather gather = shoot(scene, 1);
    for (std::size_t receiver = 0; receiver < 4; ++receiver) {
      const double z = scene.survey.receivers_m[receiver][1];
      const auto exact = ricker_response(30, 0.001, gather.axis.count, [&](double omega) {
        return Motion{layered_velocity(layers, omega, z) * 0.002};
      });
      // 9.5 cells to the shortest wave that counts (76 Hz at 1800 m/s), four interfaces and their multiples.
      const double error = relative_error(gather.traces[4 + receiver].samples, exact[0]);
      EXPECT_LT(error, 0.02) << "at " << z << " m";
      for (const double sideways : gather.traces[receiver].samples)
        EXPECT_LT(std::abs(sideways), 1e-5 * 0.002);
    }
  }
}

// Proves (A15).
TEST(PlaneSWave, CrossesLayersAsTheSumOfAllItsReflections) {
  // Those of the P wave, by their S speeds.
  const std::vector<Layer> layers = {{{2000, 0, 2000}, 0}, {{3300, 0, 2300}, 300}, {{1800, 0, 1900}, 400}};
  const double h = 2.5;
  auto rocks = layers;
  for (auto& layer : rocks) layer.rock = {1.8 * layer.rock.vp, layer.rock.vp, layer.rock.rho};
  const auto medium = layered_medium(220, h, rocks);
  auto scene = plane_scene(medium, 0, {0, 0}, 0.5, "plane-s");
  scene.survey.receivers_m = {{31, 21.3}, {31, 352.2}, {31, 433.1}};
  check(scene);
  const Gather gather = shoot(scene, 1);
  for (std::size_t receiver = 0; receiver < 3; ++receiver) {
    const double z = scene.survey.receivers_m[receiver][1];
    const auto exact = ricker_response(30, 0.001, gather.axis.count, [&](double omega) {
      return Motion{layered_velocity(layers, omega, z) * 0.002};
    });
    EXPECT_LT(relative_error(gather.traces[receiver].samples, exact[0]), 0.02) << "at " << z << " m";
    for (const double upwards : gather.traces[3 + receiver].samples)
      EXPECT_LT(std::abs(upwards), 1e-5 * 0.002);
  }
}

// Proves (E13).
TEST(PlaneWave, IsTheSameWithAbsorbingSidesAsWithMirrorsHoweverShallowTheModel) {
  // Zones of 40 cells above and, where there are any, below and beside 12 cells.
  for (const auto bottom : {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::absorbing}) {
    auto scene = plane_scene(uniform_medium(20, 12, 5, rock), 0, {0, -160}, 0.2);
    scene.edges[1][1] = bottom;
    scene.numerics.zone_cells = 0;
    scene.survey.receivers_m = {{3, 31.2}, {52, 8.3}};
    check(scene);
    const auto in_zones = shoot(scene, 1);
    scene.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    const auto in_mirrors = shoot(scene, 1);
    for (std::size_t n = 0; n < in_zones.traces.size(); ++n) {
      const double unit = n < 4 ? 0.002 : rock.rho * rock.vp * 0.002;
      double largest = 0;
      for (std::size_t t = 0; t < in_zones.traces[n].samples.size(); ++t) {
        const double expected = in_mirrors.traces[n].samples[t];
        largest = std::max(largest, std::abs(expected));
        // The rounding of single precision, some hundred steps long.
        EXPECT_LT(std::abs(in_zones.traces[n].samples[t] - expected), 1e-5 * unit) << "trace " << n;
      }
      if (n == 2) {
        EXPECT_GT(largest, 0.5 * unit);
      }
    }
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_plane_wave_test
