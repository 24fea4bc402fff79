// SPDX-License-Identifier: BSD-3-Clause
#include "geology/depth_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace slipwave {
namespace {

std::string node(double x_m, double y_m) { return "x = " + shown(x_m) + ", y = " + shown(y_m); }

/// What up to four nodes of an axis count at a place between the second and the third of them.
struct Weights {
  std::size_t first = 0, count = 0;
  std::array<double, 4> of{};
};

Weights weights_at(const std::vector<double>& nodes, double place, bool smooth) {
  const std::size_t last = nodes.size() - 1;
  if (place <= nodes.front()) return {0, 1, {1}};
  if (place >= nodes.back()) return {last, 1, {1}};
  const auto b = std::size_t(std::upper_bound(nodes.begin(), nodes.end(), place) - nodes.begin()), a = b - 1;
  const double width = nodes[b] - nodes[a], t = (place - nodes[a]) / width;
  if (!smooth || last == 1) return {a, 2, {1 - t, t}};
  // What a cubic with the slopes of parabolas at both ends adds to the straight line (Horizon::at()): the
  // slope at an end differs from that of the line by a share of what the next line's slope differs. At the
  // first and last node the parabola is that through the node beside it, whose slopes there and here have the
  // line's as their mean.
  const bool has_low = a > 0, has_high = b < last;
  const double low_width = has_low ? nodes[a] - nodes[a - 1] : 1;
  const double high_width = has_high ? nodes[b + 1] - nodes[b] : 1;
  const double low_share = width / (low_width + width), high_share = width / (width + high_width);
  const double bend = width * t * (1 - t);
  const double by_low = has_low ? bend * low_share * (has_high ? 1 - t : 1) : 0;
  const double by_high = has_high ? -bend * high_share * (has_low ? t : 1) : 0;
  // Slopes between nodes as weights of the nodes; that of the line itself is taken off twice.
  std::array<double, 4> of{-by_low / low_width, 1 - t + by_low / low_width + (by_low + by_high) / width,
                           t - by_high / high_width - (by_low + by_high) / width, by_high / high_width};
  if (has_low && has_high) return {a - 1, 4, of};
  if (has_low) return {a - 1, 3, of};
  return {a, 3, {of[1], of[2], of[3]}};
}

/// The different ones among coordinates, ascending, and what is too near to count as different.
std::vector<double> different(std::vector<double> values, double near) {
  std::sort(values.begin(), values.end());
  std::vector<double> nodes;
  for (const double value : values) {
    if (nodes.empty() || value > nodes.back() + near) nodes.push_back(value);
  }
  return nodes;
}

/// The nodes of an axis, and which of them a coordinate is.
struct Axis {
  double near = 0;
  std::vector<double> nodes;

  Axis(const std::vector<NumberedPoint<3>>& points, std::size_t axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const auto& point : points) values.push_back(point.at[axis]);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    near = 1e-6 * (*high - *low);
    nodes = different(std::move(values), near);
  }
  std::size_t index(double value) const {
    return std::size_t(std::upper_bound(nodes.begin(), nodes.end(), value) - nodes.begin()) - 1;
  }
};

}  // namespace

DepthGrid::DepthGrid(std::vector<double> x_m, std::vector<double> y_m, std::vector<double> depths_m)
    : x_m_(std::move(x_m)), y_m_(std::move(y_m)), depths_m_(std::move(depths_m)) {
  if (x_m_.size() < 2 || y_m_.size() < 2) {
    throw Error("found " + std::to_string(x_m_.size()) + " different x and " + std::to_string(y_m_.size()) +
                " different y, expected at least 2 of each");
  }
  for (std::size_t n = 0; n < depths_m_.size(); ++n) {
    if (std::isfinite(depths_m_[n])) continue;
    throw Error("the depth at " + node(x_m_[n % x_m_.size()], y_m_[n / x_m_.size()]) + " is " +
                (std::isnan(depths_m_[n]) ? "NaN" : shown(depths_m_[n])) + ", expected a number");
  }
  const auto [least, largest] = std::minmax_element(depths_m_.begin(), depths_m_.end());
  if (*largest < 0) {
    throw Error("found depths from " + shown(*least) + " to " + shown(*largest) +
                " m, expected them to count downwards from the surface");
  }
}

DepthGrid DepthGrid::of_points(const std::vector<NumberedPoint<3>>& points) {
  if (points.empty()) throw Error("found no point, expected a grid of points X Y DEPTH");
  const Axis x(points, 0), y(points, 1);
  const std::size_t columns = x.nodes.size(), rows = y.nodes.size();
  // Of a grid with gaps most nodes are there; where hardly any two points share an x, one gap says nothing.
  if (double(columns) * double(rows) > 2 * double(points.size())) {
    throw Error("found " + std::to_string(points.size()) + " points at " + std::to_string(columns) +
                " different x and " + std::to_string(rows) +
                " different y, expected a grid: a point for every x with every y");
  }
  std::vector<double> depths(columns * rows, 0.);
  std::vector<int> lines(columns * rows, 0);
  for (const auto& point : points) {
    const std::size_t n = y.index(point.at[1]) * columns + x.index(point.at[0]);
    if (lines[n] != 0) {
      throw Error("line " + std::to_string(point.line) + ": found a second depth at " +
                  node(point.at[0], point.at[1]) + " after that of line " + std::to_string(lines[n]) +
                  ", expected one");
    }
    lines[n] = point.line;
    depths[n] = point.at[2];
  }
  const auto gap = std::size_t(std::find(lines.begin(), lines.end(), 0) - lines.begin());
  if (gap < lines.size()) {
    throw Error("found no depth at " + node(x.nodes[gap % columns], y.nodes[gap / columns]) +
                ", expected one for each of " + std::to_string(columns) + " x with each of " +
                std::to_string(rows) + " y");
  }
  return {x.nodes, y.nodes, std::move(depths)};
}

double DepthGrid::at(double x_m, double y_m, bool smooth) const {
  const auto along_x = weights_at(x_m_, x_m, smooth), along_y = weights_at(y_m_, y_m, smooth);
  double depth = 0;
  for (std::size_t j = 0; j < along_y.count; ++j) {
    const double* row = &depths_m_[(along_y.first + j) * x_m_.size() + along_x.first];
    double of_row = 0;
    for (std::size_t i = 0; i < along_x.count; ++i) of_row += along_x.of[i] * row[i];
    depth += along_y.of[j] * of_row;
  }
  return depth;
}

}  // namespace slipwave
