// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "acquisition/fibre.hpp"
#include "base/error.hpp"

namespace slipwave::acquisition_fibre_test {
namespace {

/// The strain rate of a gauge where velocities are linear: gradient G, v = G x.
template <int D>
double in_uniform_strain(const std::vector<GaugePoint<D>>& points, const double (&g)[D][D]) {
  double sum = 0;
  for (const auto& point : points)
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = 0; j < D; ++j) sum += point.weight_per_m[i] * g[i][j] * point.at_m[j];
  return sum;
}

constexpr double gradient[2][2] = {{0.3, -0.2}, {0.5, 0.7}};

double along(double x, double z) {
  const double length = std::hypot(x, z);
  x /= length, z /= length;
  return x * x * gradient[0][0] + x * z * (gradient[0][1] + gradient[1][0]) + z * z * gradient[1][1];
}

Fibre path(double gauge_m) {
  Fibre fibre;
  fibre.along_path = true;
  fibre.gauge_m = gauge_m;
  return fibre;
}

}  // namespace

// Proves (A22).
TEST(Fibre, AlongAStraightPathIsTheStraightOne) {
  std::vector<Point<2>> receivers;
  for (int n = 0; n < 5; ++n) receivers.push_back({3. * n, 4. * n});
  const auto straight = parse_fibre<2>("das:" + std::to_string(std::atan2(3, 4) * 180 / M_PI) + ":8");
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    const auto points = gauge_points<2>(path(8), receivers, n),
               expected = gauge_points<2>(straight, receivers, n);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(points[end].at_m[axis], expected[end].at_m[axis], 1e-6);
        EXPECT_NEAR(points[end].weight_per_m[axis], expected[end].weight_per_m[axis], 1e-7);
      }
  }
}

// Proves (A22).
TEST(Fibre, RoundABendAveragesTheStrainOfBothPieces) {
  // Down for 20 m, then along x: a gauge of 10 m at 18 m has 7 m of the first and 3 m of the second.
  const std::vector<Point<2>> receivers = {{0, 0}, {0, 18}, {0, 20}, {2, 20}, {12, 20}};
  EXPECT_NEAR(in_uniform_strain<2>(gauge_points<2>(path(10), receivers, 1), gradient),
              0.7 * along(0, 1) + 0.3 * along(1, 0), 1e-12);
  EXPECT_NEAR(in_uniform_strain<2>(gauge_points<2>(path(10), receivers, 0), gradient), along(0, 1), 1e-12)
      << "beyond the first receiver it continues";
  EXPECT_NEAR(in_uniform_strain<2>(gauge_points<2>(path(10), receivers, 4), gradient), along(1, 0), 1e-12);
}

// Proves (A22).
TEST(Fibre, AroundAnArcHasTheMeanOfItsTangents) {
  std::vector<Point<2>> arc;
  constexpr int count = 200;
  for (int n = 0; n <= count; ++n) {
    const double angle = M_PI / 2 * n / count;
    arc.push_back({100 * (1 - std::cos(angle)), 100 * std::sin(angle)});
  }
  // Over all of it: the means of sin^2, cos^2 and sin cos over a quarter are 1/2, 1/2 and 1/pi.
  const double exact = 0.5 * (gradient[0][0] + gradient[1][1]) + (gradient[0][1] + gradient[1][0]) / M_PI;
  const double length = 50 * M_PI * 0.9999;
  EXPECT_NEAR(in_uniform_strain<2>(gauge_points<2>(path(length), arc, count / 2), gradient), exact, 1e-3);
}

TEST(Fibre, OfAPathNeedsReceiversApart) {
  const std::vector<Point<3>> one = {{0, 0, 5}}, twice = {{0, 0, 5}, {0, 0, 5}};
  EXPECT_THROW(gauge_points<3>(parse_fibre<3>("das:path:10"), one, 0), Error);
  EXPECT_THROW(gauge_points<3>(parse_fibre<3>("das:path:10"), twice, 0), Error);
  EXPECT_THROW(parse_fibre<2>("das:path:0"), Error);
  EXPECT_THROW(parse_fibre<2>("das:path"), Error);
}

}  // namespace slipwave::acquisition_fibre_test
