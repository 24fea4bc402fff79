// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "accuracy/full_space.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_full_space_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};
constexpr double peak_hz = 20;  // S waves of 112 m at that frequency
constexpr double interval_s = 0.001;

/// Receivers in all sorts of directions, 10 to 15 S wavelengths from the source, none on a cell's centre.
const std::vector<Point<2>> receivers = {{1203.3, 7.1}, {830.7, 851.9}, {-511.2, 1171.4}, {3.3, -1301.1}};

/// What comes back from its edges is a thousandth of what arrives there.
Gather shoot_in_a_full_space(const char* mechanism, double duration_s) {
  const double h = 5.5;
  const std::int64_t n = 540;  // 1485 m to each side
  Scene<2> scene;
  scene.model.medium = uniform_medium(n, n, h, rock);
  for (auto* field : {&scene.model.medium.vp, &scene.model.medium.vs, &scene.model.medium.rho}) {
    Grid<2> grid = field->grid();
    grid.origin_m = {-double(n) * h / 2, -double(n) * h / 2};
    Field<2> moved(grid);
    std::copy(field->begin(), field->end(), moved.begin());
    *field = moved;
  }
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  scene.survey.sources = {{{1.7, -0.9}, parse_mechanism<2>(mechanism), parse_wavelet("ricker:20"), 3e6}};
  scene.survey.receivers_m = receivers;
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.order = 7;
  scene.numerics.cfl = 0.4;
  scene.recording = {
      {Component::vx, Component::vz, Component::sxx, Component::szz, Component::sxz, Component::p},
      duration_s,
      interval_s};
  check(scene);
  return shoot(scene, 1);
}

/// What of the difference to `exact` a stretched or shifted copy of it explains: found = (1 + gain) exact(t -
/// delay), by least squares.
struct Misfit {
  double gain, delay_s, error;
};
Misfit misfit(const std::vector<double>& found, const std::vector<double>& exact) {
  double size = 0, along = 0, slopes = 0, slope_along = 0;
  for (std::size_t n = 1; n + 1 < exact.size(); ++n) {
    const double slope = (exact[n + 1] - exact[n - 1]) / (2 * interval_s), difference = found[n] - exact[n];
    size += exact[n] * exact[n];
    along += difference * exact[n];
    slopes += slope * slope;
    slope_along += difference * slope;
  }
  return {along / size, -slope_along / slopes, relative_error(found, exact)};
}

template <class MotionAt>
void expect_close(const Gather& gather, const std::vector<std::size_t>& rows, double bound,
                  MotionAt&& motion_at) {
  for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver) {
    const double x = receivers[receiver][0] - 1.7, z = receivers[receiver][1] + 0.9;
    const auto exact = ricker_response(peak_hz, interval_s, gather.axis.count,
                                       [&](double omega) { return motion_at(omega, x, z); });
    double largest = 0;  // components that vanish by symmetry are measured by those that do not
    for (const std::size_t row : rows)
      for (const double value : exact[row])
        largest = std::max(largest, std::abs(value) * (row < 2 ? rock.rho * rock.vp : 1));
    for (const std::size_t row : rows) {
      auto found = gather.traces[row * receivers.size() + receiver].samples;
      for (auto& value : found) value /= 3e6;
      double peak = 0;
      for (const double value : exact[row])
        peak = std::max(peak, std::abs(value) * (row < 2 ? rock.rho * rock.vp : 1));
      if (peak < 0.05 * largest) continue;
      const auto [gain, delay_s, error] = misfit(found, exact[row]);
      const auto message = testing::Message() << "row " << row << " at " << x << ' ' << z;
      EXPECT_LT(error, bound) << message;
      EXPECT_LT(std::abs(gain), 0.005) << message;
      EXPECT_LT(std::abs(delay_s), 0.05 * interval_s) << message;
    }
  }
}

// Proves (E2).
TEST(FullSpace, ExplosionMovesAndStrainsTheRockAsInTheClosedForm) {
  const Gather gather = shoot_in_a_full_space("explosion", 0.45);
  expect_close(gather, {0, 1, 2, 3, 4}, 0.01,
               [](double omega, double x, double z) { return explosion_motion(rock, omega, x, z); });
  // p is minus the mean of the normal stresses, and rises where the explosion pushes.
  const std::size_t count = receivers.size();
  for (std::size_t receiver = 0; receiver < count; ++receiver)
    for (std::size_t n = 0; n < gather.traces[0].samples.size(); n += 10)
      EXPECT_NEAR(
          gather.traces[5 * count + receiver].samples[n],
          -(gather.traces[2 * count + receiver].samples[n] + gather.traces[3 * count + receiver].samples[n]) /
              2,
          1e-6 * 3e6);
}

// Proves (E1), (E2).
TEST(FullSpace, ForceAlongXMovesTheRockAsInTheClosedForm) {
  expect_close(shoot_in_a_full_space("force:1,0", 0.72), {0, 1}, 0.01,
               [](double omega, double x, double z) { return force_motion(rock, omega, x, z, 0); });
}

// Proves (E2).
TEST(FullSpace, ForceAlongZMovesTheRockAsInTheClosedForm) {
  if (!long_form()) return;
  expect_close(shoot_in_a_full_space("force:0,1", 0.72), {0, 1}, 0.01,
               [](double omega, double x, double z) { return force_motion(rock, omega, x, z, 1); });
}

}  // namespace
}  // namespace slipwave::solver::solver_full_space_test
