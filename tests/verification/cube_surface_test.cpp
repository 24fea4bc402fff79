// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube_shot.hpp"
#include "long_form.hpp"

namespace slipwave::solver::cube_surface_test {
namespace {

constexpr double spacing_m = 5, interval_s = 0.001, amplitude = 1e9;

/// Velocity down of the surface at a distance from a vertical force `amplitude` w on it, for lambda = mu,
/// from the displacement that a step of force makes (Pekeris 1955; Kausel 2012, Lamb's problem at its
/// simplest): with T = vs t/r,
///   mu r u/(step) = 0 before P, (6 - sqrt(3)/sqrt(T^2 - 1/4) - sqrt(3 sqrt(3) + 5)/sqrt(c - T^2)
///     + sqrt(3 sqrt(3) - 5)/sqrt(T^2 + b))/(32 pi) up to S, (6 - sqrt(3 sqrt(3) + 5)/sqrt(c - T^2))/(16 pi)
///     up to
///   the surface wave, T^2 = c = (3 + sqrt(3))/4, and 3/(8 pi) after it; b = (sqrt(3) - 3)/4.
class Pekeris {
 public:
  Pekeris(const Rock& rock, const RickerForm& wavelet) : rock_(rock), wavelet_(wavelet) {}
  double velocity(double distance, double t) const {
    // v(t) = integral of u_step(s) w''(t - s) ds, its square roots taken as the variable.
    const double unit = distance / rock_.vs, root3 = std::sqrt(3.), c = (3 + root3) / 4;
    const double p = std::sqrt(1 / 3.), ray = std::sqrt(c), end = t / unit;
    const auto bend = [&](double time) { return wavelet_.bend(t - time * unit); };
    const auto integral = [&](double from, double to, auto&& u) {
      to = std::min(to, end);
      if (to <= from) return 0.;
      constexpr int count = 400;
      double sum = 0;
      // T = ray sin(q) takes the singularity at the surface wave.
      const double low = std::asin(std::min(from / ray, 1.)), high = std::asin(std::min(to / ray, 1.));
      for (int n = 0; n < count; ++n) {
        const double q = low + (n + 0.5) * (high - low) / count, time = ray * std::sin(q);
        sum += u(time, ray * std::cos(q)) * bend(time) * (high - low) / count;
      }
      return sum;
    };
    // dT = ray cos(q) dq, and sqrt(c - T^2) = ray cos(q).
    const double strong = std::sqrt(3 * root3 + 5), weak = std::sqrt(3 * root3 - 5);
    double sum = integral(p, 1, [&](double time, double left) {
      const double square = time * time;
      return (left * (6 - root3 / std::sqrt(square - 0.25) + weak / std::sqrt(square + (root3 - 3) / 4)) -
              strong) /
             32;
    });
    sum += integral(1, ray, [&](double, double left) { return (6 * left - strong) / 16; });
    // After the surface wave the surface stays where it is: the integral of w'' is w'.
    if (end > ray) sum += 3. / 8 * wavelet_.slope(t - ray * unit) / unit;
    return amplitude * sum * unit / (std::numbers::pi * rock_.mu() * distance);
  }

 private:
  Rock rock_;
  RickerForm wavelet_;
};

// Proves (E11).
TEST(CubeFreeSurface, MovesUnderAForceAsInPekerisClosedForm) {
  const Rock rock{3000 * std::sqrt(3.), 3000, 2500};  // lambda = mu
  constexpr RickerForm wavelet{25};                   // 24 cells a dominant S wavelength
  const Pekeris pekeris(rock, wavelet);
  const std::int64_t n = 70;
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[2][0] = EdgeLaw::free;
  const std::vector<Point<3>> receivers = {{100, 0.1, 0}, {70, 70, 0}, {0.1, 140, 0}};
  auto scene = scene_of(uniform_cube({n, n, n}, spacing_m, rock), edges, {0, 0, 0}, "force:0,0,1",
                        "ricker:25", receivers, {Component::vz}, 0.115, interval_s);
  scene.numerics.order = 7;
  check(scene);
  const auto gather = shoot(scene, 1);
  for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver) {
    const auto& samples = gather.traces[receiver].samples;
    const double distance = std::hypot(receivers[receiver][0], receivers[receiver][1]);
    std::vector<double> found, exact;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      found.push_back(samples[k] / 4);  // two planes of symmetry run through the force
      exact.push_back(pekeris.velocity(distance, double(k) * interval_s));
    }
    EXPECT_LT(relative_error(found, exact), 0.05) << "receiver " << receiver;
  }
}

// Proves (E11).
TEST(CubeFreeSurface, OfWaterSendsAnExplosionBackAsItsImage) {
  const Rock water{1500, 0, 1000};
  constexpr RickerForm wavelet{15};  // 20 cells per dominant wavelength
  const std::int64_t n = 50;
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[2][0] = EdgeLaw::free;
  const Point<3> source = {0, 0, 38}, receiver = {91, 52, 63};
  auto scene = scene_of(uniform_cube({n, n, n}, spacing_m, water), edges, source, "explosion", "ricker:15",
                        {receiver}, {Component::p}, 0.26, interval_s);
  scene.numerics.order = 7;
  scene.numerics.cfl = 0.6;  // the error of the splitting is 2 % at 0.9, 0.2 % at 0.3
  check(scene);
  const auto samples = shoot(scene, 1).traces[0].samples;
  const auto pressure = [&](double distance, double t) {
    return amplitude * water.rho * water.vp * water.vp * wavelet.slope(t - distance / water.vp) /
           (4 * std::numbers::pi * water.rho * std::pow(water.vp, 4) * distance);
  };
  std::vector<double> found, exact;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double t = double(k) * interval_s;
    found.push_back(samples[k] / 4);
    exact.push_back(pressure(std::hypot(receiver[0], receiver[1], receiver[2] - source[2]), t) -
                    pressure(std::hypot(receiver[0], receiver[1], receiver[2] + source[2]), t));
  }
  EXPECT_LT(relative_error(found, exact), 0.01);
}

// Proves (E14).
TEST(CubeAbsorbingEdges, SendBackLittleOfAnExplosionAndAForce) {
  // Against the same shot in a grid so large that nothing is back in time.
  const Rock rock{4500, 2600, 2500};
  const double h = 10;
  for (const std::string mechanism : {"explosion", "force:1,2,3"}) {
    // A force sends waves of both kinds.
    if (!long_form() && mechanism == "explosion") continue;
    const auto traces = [&](std::int64_t more, EdgeLaw law) {
      const Grid<3> grid{{24 + 2 * more, 22 + 2 * more, 26 + 2 * more}, h, {}};
      const double low = -double(more) * h;
      auto scene = scene_of(uniform_cube(grid.shape, h, rock, {low, low, low}), edges_all_3d(law),
                            {121, 113, 135}, mechanism.c_str(), "ricker:25", {{63, 171, 59}, {225, 32, 241}},
                            {Component::vx, Component::vy, Component::vz}, 0.15, interval_s);
      scene.numerics.zone_cells = 12;
      check(scene);
      return samples_of(shoot(scene, 1));
    };
    // The reflections of the far mirrors travel for 0.14 s, and weak before the wavelet's peak.
    const auto alone = traces(24, EdgeLaw::mirror);
    EXPECT_LT(relative_error(traces(0, EdgeLaw::absorbing), alone), 0.015) << mechanism;
    EXPECT_GT(relative_error(traces(0, EdgeLaw::mirror), alone), 0.5) << mechanism;
  }
}

}  // namespace
}  // namespace slipwave::solver::cube_surface_test
