// SPDX-License-Identifier: BSD-3-Clause
#include "scene/splitting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace slipwave::solver_splitting_test {
namespace {

using Vector = std::array<double, 3>;

/// Turned by an angle about the unit vector n (Rodrigues).
Vector turned(const Vector& u, const Vector& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), along = n[0] * u[0] + n[1] * u[1] + n[2] * u[2];
  const Vector across = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = c * u[i] + s * across[i] + (1 - c) * along * n[i];
  return out;
}

/// Error of a turn by `angle` about the sum of the axes made of turns about one axis at a time: motions that
/// do not commute, each exact, like sweeps along the axes. (In two axes it is an acoustic wave across both.)
double error_of(const std::vector<SweepFraction>& sweeps, int dimension, double angle, int steps) {
  const double length = std::sqrt(double(dimension)), dt = angle / length / steps;
  const Vector begin = {0.6, 0, 0.8};
  Vector u = begin;
  for (int step = 0; step < steps; ++step)
    for (const auto& [axis, part] : sweeps) {
      Vector n{};
      n[std::size_t(axis)] = 1;
      u = turned(u, n, part * dt);
    }
  Vector sum{};
  for (int axis = 0; axis < dimension; ++axis) sum[std::size_t(axis)] = 1 / length;
  const Vector exact = turned(begin, sum, angle);
  return std::hypot(u[0] - exact[0], u[1] - exact[1], u[2] - exact[2]);
}

double error_of(int dimension, int time_order, int steps) {
  return error_of(splitting(dimension, time_order), dimension, std::sqrt(double(dimension)), steps);
}

// Proves (E18).
TEST(Splitting, HasItsOrderInTime) {
  // 0.05 for the next term of the error.
  for (const int dimension : {2, 3})
    for (const int order : {2, 4}) {
      const double coarse = error_of(dimension, order, 8), fine = error_of(dimension, order, 16);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.05) << dimension << "-D: " << coarse << ' ' << fine;
    }
}

TEST(Splitting, OfFourthOrderErrsLessForTheSameWork) {
  // Five times the work per step, and second order is given a fifth more.
  EXPECT_LT(error_of(2, 4, 2), 0.02 * error_of(2, 2, 12));
}

// Proves (E18).
TEST(Splitting, OfFiveStagesErrsLessThanTheBestKnownOfSixForTheSameWork) {
  // Blanes & Moan (2002), table 2, order 4, 6 stages.
  constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195;
  constexpr double b1 = 0.209515106613362, b2 = -0.143851773179818;
  std::vector<double> parts{a1, b1, a2, b2, a3, 0.5 - b1 - b2, 1 - 2 * (a1 + a2 + a3)};
  for (std::size_t n = 6; n > 0; --n) parts.push_back(parts[n - 1]);
  std::vector<SweepFraction> six;
  for (const double part : parts) six.push_back({int(six.size() % 2), part});
  // Three and ten periods, whose error is that of the period. A wave of ten has 8 sweeps a radian.
  for (const auto& [angle, unit] : {std::pair{20., 8}, {60., 22}})
    EXPECT_LT(error_of(splitting(2, 4), 2, angle, 6 * unit), 0.8 * error_of(six, 2, angle, 5 * unit))
        << angle;
}

TEST(Splitting, IsSymmetricInTimeAndMakesWholeSteps) {
  for (const int dimension : {2, 3})
    for (const int order : {2, 4}) {
      const auto sweeps = splitting(dimension, order);
      std::array<double, 3> sums{};
      for (std::size_t n = 0; n < sweeps.size(); ++n) {
        sums[std::size_t(sweeps[n].axis)] += sweeps[n].fraction;
        EXPECT_EQ(sweeps[n].axis, sweeps[sweeps.size() - 1 - n].axis);
        EXPECT_NEAR(sweeps[n].fraction, sweeps[sweeps.size() - 1 - n].fraction, 1e-15);
        // In 2-D no sweep of a step at Courant number 2 goes further than a cell.
        EXPECT_LE(std::abs(sweeps[n].fraction), order == 2 ? 1 : 0.5);
      }
      EXPECT_EQ(sweeps.front().axis, 0);
      for (int axis = 0; axis < dimension; ++axis) EXPECT_NEAR(sums[std::size_t(axis)], 1, 1e-15);
    }
}

}  // namespace
}  // namespace slipwave::solver_splitting_test
