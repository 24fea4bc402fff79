// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parse.hpp"
#include "grid/grid.hpp"

namespace slipwave {

/// A place, directions at right angles to each other, and a length along each: the first dips towards an
/// azimuth, the last is across the planes that dip so.
template <int D>
struct Frame {
  Point<D> centre{}, size_m{};
  std::array<Point<D>, std::size_t(D)> axes{};

  Frame(const Point<D>& centre, const Point<D>& size_m, double dip_deg, double azimuth_deg = 0)
      : centre(centre), size_m(size_m) {
    const double degree = std::numbers::pi / 180;
    const double cosine = std::cos(dip_deg * degree), sine = std::sin(dip_deg * degree);
    if constexpr (D == 2) {
      axes = {{{cosine, sine}, {-sine, cosine}}};
    } else {
      const double x = std::cos(azimuth_deg * degree), y = std::sin(azimuth_deg * degree);
      axes = {{{cosine * x, cosine * y, sine}, {-y, x, 0}, {-sine * x, -sine * y, cosine}}};
    }
  }
  /// Along the axes, counted from the centre.
  Point<D> seen(const Point<D>& at) const {
    Point<D> local{};
    for (std::size_t n = 0; n < D; ++n)
      for (std::size_t i = 0; i < D; ++i) local[n] += axes[n][i] * (at[i] - centre[i]);
    return local;
  }
  bool in_slab(const Point<D>& at) const {
    const auto local = seen(at);
    for (std::size_t n = 0; n < D; ++n)
      if (!(std::abs(local[n]) <= size_m[n] / 2)) return false;
    return true;
  }
  bool in_ellipse(const Point<D>& at) const {
    auto local = seen(at);
    for (std::size_t n = 0; n < D; ++n) local[n] /= size_m[n];
    if constexpr (D == 2)
      return std::hypot(local[0], local[1]) <= 1;
    else
      return std::hypot(local[0], local[1], local[2]) <= 1;
  }
  /// From where to where, along an axis of space, the line through a point is in the slab: low > high where
  /// it is not.
  std::array<double, 2> slab_chord(const Point<D>& at, std::size_t axis) const {
    const auto local = seen(at);
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t n = 0; n < D; ++n) {
      const double slope = axes[n][axis], half = size_m[n] / 2;
      if (std::abs(slope) < 1e-12) {
        if (std::abs(local[n]) > half) return {1, 0};
        continue;
      }
      const double middle = -local[n] / slope, reach = half / std::abs(slope);
      low = std::max(low, middle - reach), high = std::min(high, middle + reach);
    }
    return {at[axis] + low, at[axis] + high};
  }
  /// From where to where, along an axis of space, the line through a point is in the ellipse: low > high
  /// where it is not.
  std::array<double, 2> ellipse_chord(const Point<D>& at, std::size_t axis) const {
    const auto local = seen(at);
    double a = 0, b = 0, c = -1;  // a t^2 + 2 b t + c = 0
    for (std::size_t n = 0; n < D; ++n) {
      const double place = local[n] / size_m[n], slope = axes[n][axis] / size_m[n];
      a += slope * slope, b += place * slope, c += place * place;
    }
    const double square = b * b - a * c;
    if (!(square > 0)) return {1, 0};
    return {at[axis] - (b + std::sqrt(square)) / a, at[axis] - (b - std::sqrt(square)) / a};
  }
  /// Corners of the slab in 2-D, one after the other along its edge.
  std::array<Point<D>, 4> corners() const {
    std::array<Point<D>, 4> all{};
    for (std::size_t n = 0; n < 4; ++n) {
      const double along = n == 1 || n == 2 ? 0.5 : -0.5, across = n >= 2 ? 0.5 : -0.5;
      for (std::size_t i = 0; i < D; ++i)
        all[n][i] = centre[i] + along * size_m[0] * axes[0][i] + across * size_m[1] * axes[1][i];
    }
    return all;
  }
  Box<D> slab_bounds() const {
    Point<D> half{};
    for (std::size_t n = 0; n < D; ++n)
      for (std::size_t i = 0; i < D; ++i) half[i] += size_m[n] * std::abs(axes[n][i]) / 2;
    return box(half);
  }
  Box<D> ellipse_bounds() const {
    Point<D> half{};
    for (std::size_t n = 0; n < D; ++n)
      for (std::size_t i = 0; i < D; ++i) half[i] = std::hypot(half[i], size_m[n] * axes[n][i]);
    return box(half);
  }

 private:
  Box<D> box(const Point<D>& half) const {
    Box<D> bounds;
    for (std::size_t i = 0; i < D; ++i) {
      bounds.low_m[i] = centre[i] - half[i];
      bounds.high_m[i] = centre[i] + half[i];
    }
    return bounds;
  }
};

}  // namespace slipwave
