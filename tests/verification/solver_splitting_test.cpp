#include "scene/splitting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace slipwave {
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

/// Error of a turn about the sum of the axes made of turns about one axis at a time: motions that do not
/// commute, each exact, like sweeps along the axes.
double error_of(int dimension, int time_order, int steps) {
  const double dt = 1. / steps, length = std::sqrt(double(dimension));
  const Vector begin = {0.6, 0, 0.8};
  Vector u = begin;
  for (int step = 0; step < steps; ++step)
    for (const auto& [axis, part] : splitting(dimension, time_order)) {
      Vector n{};
      n[std::size_t(axis)] = 1;
      u = turned(u, n, part * dt);
    }
  Vector sum{};
  for (int axis = 0; axis < dimension; ++axis) sum[std::size_t(axis)] = 1 / length;
  const Vector exact = turned(begin, sum, length);
  return std::hypot(u[0] - exact[0], u[1] - exact[1], u[2] - exact[2]);
}

TEST(Splitting, HasItsOrderInTime) {
  // 0.05 for the next term of the error.
  for (const int dimension : {2, 3})
    for (const int order : {2, 4}) {
      const double coarse = error_of(dimension, order, 8), fine = error_of(dimension, order, 16);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.05) << dimension << "-D: " << coarse << ' ' << fine;
    }
}

TEST(Splitting, OfFourthOrderErrsLessForTheSameWork) {
  // Six times the work per step.
  EXPECT_LT(error_of(2, 4, 2), 0.02 * error_of(2, 2, 12));
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
}  // namespace slipwave
