// SPDX-License-Identifier: BSD-3-Clause
// What an interface that dips reflects from beyond a side of the model: image sources in the plane.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "accuracy/beyond_sides.hpp"

namespace slipwave {
namespace {

constexpr double wavelength_m = 40, far_m = 1e4;

/// Rises to the right by 45 degrees and would reach depth 0 at x = 150.
constexpr LineBeyondSide rising{{50, 100}, true, -1, 0.5, false, 0};

TEST(BeyondASide, IsTheFootOfThePerpendicularOfASourceThatListens) {
  const Point<2> source{0, 0};
  const double way = 2 * 150 / std::sqrt(2);
  EXPECT_NEAR(reflected_from_beyond(rising, source, source, far_m, wavelength_m), 0.25 * wavelength_m / way,
              1e-12);
  EXPECT_EQ(reflected_from_beyond(rising, source, source, way - 1, wavelength_m), 0)
      << "later than the trace";
  auto inside = rising;
  inside.at_m = {80, 70};
  EXPECT_EQ(reflected_from_beyond(inside, source, source, far_m, wavelength_m), 0) << "in the model";
  EXPECT_EQ(reflected_from_beyond(rising, source, {200, 10}, far_m, wavelength_m), 0) << "behind it";
}

TEST(BeyondASide, IsTheSameOnTheLeft) {
  const LineBeyondSide mirrored{{-50, 100}, false, 1, 0.5, false, 0};
  EXPECT_DOUBLE_EQ(reflected_from_beyond(rising, {-30, 10}, {20, 30}, far_m, wavelength_m),
                   reflected_from_beyond(mirrored, {30, 10}, {-20, 30}, far_m, wavelength_m));
}

TEST(BeyondASide, IsNothingOfALevelInterfaceOrOneThatFallsAway) {
  for (const double slope : {0., 0.3})
    EXPECT_EQ(reflected_from_beyond({{50, 100}, true, slope, 0.5, true, 0}, {-100, 20}, {40, 30}, far_m,
                                    wavelength_m),
              0)
        << slope;
}

/// The same by rays: they leave the source in all directions and are reflected where they meet the surface or
/// the interface; one that passes the receiver on the other side than its neighbour arrives there.
double by_rays(const LineBeyondSide& line, const Point<2>& source, const Point<2>& receiver, double longest_m,
               double direct_m) {
  struct Arrival {
    double aside = 0, way = 0;
    int faces = 0;
    bool beyond = false;
    std::vector<bool> mirrors{};  // by which it came: true of the interface
  };
  const auto arrivals = [&](double angle) {
    std::vector<Arrival> found;
    double x = source[0], z = source[1], dx = std::cos(angle), dz = std::sin(angle), way = 0;
    Arrival state;
    while (way < longest_m) {
      const double to_surface = dz < -1e-12 ? (line.surface_m - z) / dz : 1e30;
      const double closing = dz - line.slope * dx, gap = line.at_m[1] + line.slope * (x - line.at_m[0]) - z;
      const double to_face = closing > 1e-12 ? gap / closing : 1e30, step = std::min(to_surface, to_face);
      const double along = (receiver[0] - x) * dx + (receiver[1] - z) * dz;
      if (along > 0 && along < step) {
        auto arrival = state;
        arrival.aside = (receiver[0] - x) * dz - (receiver[1] - z) * dx, arrival.way = way + along;
        found.push_back(arrival);
      }
      if (step > 1e29) break;
      x += step * dx, z += step * dz, way += step;
      const bool face = to_face < to_surface;
      state.mirrors.push_back(face);
      if (!face) {
        dz = -dz;
        continue;
      }
      ++state.faces;
      state.beyond = state.beyond || x > line.at_m[0];
      const double square = 1 + line.slope * line.slope, twice = 2 * (dz - line.slope * dx) / square;
      dx += twice * line.slope, dz -= twice;
    }
    return found;
  };
  double sum = 0;
  constexpr int rays = 40000;
  auto before = arrivals(0);
  for (int n = 1; n <= rays; ++n) {
    auto now = arrivals(2 * std::numbers::pi * n / rays);
    for (const auto& one : now)
      for (const auto& other : before)
        if (one.mirrors == other.mirrors && one.beyond && one.way < longest_m &&
            (one.aside < 0) != (other.aside < 0))
          sum += std::pow(line.reflection, 2 * one.faces) * direct_m / one.way;
    before = std::move(now);
  }
  return sum;
}

TEST(BeyondASide, IsWhatRaysBringIncludingMultiples) {
  for (const double slope : {-1., -0.4, -0.15}) {
    const LineBeyondSide line{{50, 100}, true, slope, 0.7, true, 5};
    for (const auto& [source, receiver] : {std::pair<Point<2>, Point<2>>{{-200, 40}, {-100, 61}},
                                           {{-150, 20}, {30, 15}},
                                           {{-20, 90}, {-60, 12}}}) {
      const double direct = std::hypot(source[0] - receiver[0], source[1] - receiver[1]);
      const double by_images = reflected_from_beyond(line, source, receiver, 2000, wavelength_m);
      EXPECT_NEAR(by_images, by_rays(line, source, receiver, 2000, direct), 0.02 * by_images + 1e-6) << slope;
    }
  }
}

}  // namespace
}  // namespace slipwave
