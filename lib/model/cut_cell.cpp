#include "model/cut_cell.hpp"

#include <algorithm>
#include <cmath>

#include "grid/grid.hpp"

namespace slipwave {
namespace {

using Outline = std::vector<Point<2>>;

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const auto &a = outline[n], &b = outline[(n + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(twice) / 2;
}

/// The part of a convex outline above a straight top.
Outline above(const Outline& outline, const Cut& top) {
  const auto depth = [&](const Point<2>& at) { return at[1] - top.low - (top.high - top.low) * at[0]; };
  Outline part;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const auto &a = outline[n], &b = outline[(n + 1) % outline.size()];
    const double from = depth(a), to = depth(b);
    if (from < 0) part.push_back(a);
    if ((from < 0) == (to < 0)) continue;
    const double way = from / (from - to);
    part.push_back({a[0] + way * (b[0] - a[0]), a[1] + way * (b[1] - a[1])});
  }
  return part;
}

}  // namespace

std::vector<double> shares_of_cell(std::span<const Cut> tops) {
  std::vector<double> shares(tops.size() + 1, 0.);
  // The last layer takes what is below its top, those before it what it leaves: that stays convex.
  Outline rest{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
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

}  // namespace slipwave
