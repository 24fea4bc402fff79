// SPDX-License-Identifier: BSD-3-Clause
#include "rock/cut_cell.hpp"

#include <algorithm>
#include <cmath>

#include "grid/grid.hpp"

namespace slipwave {
namespace {

using Outline = std::vector<Point<2>>;

Outline whole_cell() { return {{0, 0}, {1, 0}, {1, 1}, {0, 1}}; }

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const auto &a = outline[n], &b = outline[(n + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(twice) / 2;
}

/// The part of a convex outline where a linear function is negative; `with_zero`: or zero.
template <class Function>
Outline where_negative(const Outline& outline, const Function& function, bool with_zero = false) {
  const auto inside = [&](double value) { return value < 0 || (with_zero && value == 0); };
  Outline part;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const auto &a = outline[n], &b = outline[(n + 1) % outline.size()];
    const double from = function(a), to = function(b);
    if (inside(from)) part.push_back(a);
    if (inside(from) == inside(to)) continue;
    const double way = from / (from - to);
    part.push_back({a[0] + way * (b[0] - a[0]), a[1] + way * (b[1] - a[1])});
  }
  return part;
}

/// The part of a convex outline above a straight top.
Outline above(const Outline& outline, const Cut& top) {
  return where_negative(outline,
                        [&](const Point<2>& at) { return at[1] - top.low - (top.high - top.low) * at[0]; });
}

/// depth = middle + along_x (x - 1/2) + along_y (y - 1/2) over the unit square.
struct Plane {
  double middle = 0, along_x = 0, along_y = 0;

  double operator()(const Point<2>& at) const {
    return middle + along_x * (at[0] - 0.5) + along_y * (at[1] - 0.5);
  }
  double reach() const { return (std::abs(along_x) + std::abs(along_y)) / 2; }
};

/// Nearest to the depths at the four edges, by least squares.
Plane plane_of(const Cut3D& cut) {
  const Cut &a = cut.low_y, &b = cut.high_y;
  return {(a.low + a.high + b.low + b.high) / 4, (a.high - a.low + b.high - b.low) / 2,
          (b.low - a.low + b.high - a.high) / 2};
}

/// The integral of a linear function over a convex outline.
double integral_over(const Outline& outline, const Plane& plane) {
  double six_fold = 0;
  for (std::size_t n = 1; n + 1 < outline.size(); ++n) {
    const auto &a = outline[0], &b = outline[n], &c = outline[n + 1];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    six_fold += twice * (plane(a) + plane(b) + plane(c));
  }
  return six_fold / 6;
}

/// What of a unit cube lies above all planes: over the part of its base where a plane is the highest and
/// below the cube's upper face, the depth of that plane.
double volume_above(const std::vector<Plane>& planes) {
  double volume = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Outline part = whole_cell();
    for (std::size_t k = 0; k < planes.size() && !part.empty(); ++k) {
      if (k == i) continue;
      // Where two are the same plane the first of them counts.
      part = where_negative(
          part, [&](const Point<2>& at) { return planes[i](at) - planes[k](at); }, i < k);
    }
    part = where_negative(part, [&](const Point<2>& at) { return -planes[i](at); });
    volume += integral_over(part, planes[i]);
  }
  return volume;
}

}  // namespace

double Cut3D::least() const {
  if (low_y == high_y) return std::min(low_y.low, low_y.high);
  const auto plane = plane_of(*this);
  return plane.middle - plane.reach();
}

double Cut3D::largest() const {
  if (low_y == high_y) return std::max(low_y.low, low_y.high);
  const auto plane = plane_of(*this);
  return plane.middle + plane.reach();
}

std::vector<double> shares_of_cell(std::span<const Cut> tops) {
  std::vector<double> shares(tops.size() + 1, 0.);
  // The last layer takes what is below its top, those before it what it leaves: that stays convex.
  Outline rest = whole_cell();
  double left = 1;
  for (std::size_t i = tops.size(); i-- > 0 && left > 0;) {
    if (std::min(tops[i].low, tops[i].high) >= 1) continue;
    rest = std::max(tops[i].low, tops[i].high) <= 0 ? Outline{} : above(rest, tops[i]);
    const double area = std::min(area_of(rest), left);
    shares[i] = left - area;
    left = area;
  }
  shares.back() = left;
  return shares;
}

std::vector<double> shares_of_cell(std::span<const Cut3D> tops) {
  if (std::all_of(tops.begin(), tops.end(), [](const auto& top) { return top.low_y == top.high_y; })) {
    std::vector<Cut> section;
    for (const auto& top : tops) section.push_back(top.low_y);
    return shares_of_cell(section);
  }
  std::vector<double> shares(tops.size() + 1, 0.);
  std::vector<Plane> planes{{1, 0, 0}};  // the cell's lower face, and the tops that what is left lies above
  double left = 1;
  for (std::size_t i = tops.size(); i-- > 0 && left > 0;) {
    if (tops[i].least() >= 1) continue;
    planes.push_back(plane_of(tops[i]));
    const double volume = tops[i].largest() <= 0 ? 0 : std::clamp(volume_above(planes), 0., left);
    shares[i] = left - volume;
    left = volume;
  }
  shares.back() = left;
  return shares;
}

}  // namespace slipwave
