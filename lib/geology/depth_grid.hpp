// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geology/points_file.hpp"

namespace slipwave {

class NetcdfFile;

/// A surface given by its depth at the nodes of a grid: every x with every y, both ascending, in steps that
/// may differ.
class DepthGrid {
 public:
  /// depths[j n + i] is the depth at x_m[i], y_m[j], with n = x_m.size(). Throws Error unless there are two
  /// nodes or more each way, at each of them a finite depth, and not all depths below zero, that is counted
  /// upwards.
  DepthGrid(std::vector<double> x_m, std::vector<double> y_m, std::vector<double> depths_m);

  /// Returns the grid of points X Y DEPTH in any order. Coordinates nearer to each other than 1e-6 of the way
  /// from the first to the last count as one. Throws Error, with the line, where a node has no point or two,
  /// or the points are no grid.
  static DepthGrid of_points(const std::vector<NumberedPoint<3>>& points);

  /// Between nodes bilinear, that is along x and along y straight. `smooth`: with continuous slopes, along
  /// either axis the cubics of Horizon::parse(). Beyond the nodes as at the nearest of the grid's edge.
  double at(double x_m, double y_m, bool smooth) const;

  const std::vector<double>& x_m() const { return x_m_; }
  const std::vector<double>& y_m() const { return y_m_; }
  const std::vector<double>& depths_m() const { return depths_m_; }

 private:
  std::vector<double> x_m_, y_m_, depths_m_;
};

/// The variable "depth" or "z" of two dimensions, else the only one that has two, with a coordinate variable
/// for each: rows of y, unless names or an attribute "axis" say that x comes first. Lengths in m or km, m
/// where there is no unit; `positive` = "up" turns depths round; ascending or descending coordinates. Throws
/// Error naming file and variable.
DepthGrid depth_grid_from_netcdf(const NetcdfFile& file);

}  // namespace slipwave
