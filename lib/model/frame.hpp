#pragma once

#include <array>
#include <cmath>
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
    if constexpr (D == 2) return std::hypot(local[0], local[1]) <= 1;
    if constexpr (D == 3) return std::hypot(local[0], local[1], local[2]) <= 1;
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
