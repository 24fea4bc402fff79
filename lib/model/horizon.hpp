// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grid/grid.hpp"
#include "model/depth_grid.hpp"

namespace slipwave {

/// The top of a layer over x, the same all along y: a plane, to which a sine or a curve through points may be
/// added. In 3-D also a surface through the nodes of a grid.
class Horizon {
 public:
  Horizon() = default;
  /// z = depth + x tan(dip), deepening towards +x where the dip is positive. Throws a usage Error unless
  /// |dip| < 90 degrees.
  explicit Horizon(double depth_m, double dip_deg = 0);
  /// "DEPTH"; "sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]" for z = MEAN + AMPLITUDE sin(360 x/WAVELENGTH + PHASE)
  /// in degrees; "@FILE" for straight lines between points "X Z", one a line, x ascending; "smooth@FILE" for
  /// a curve with a continuous slope through them: cubics whose slope at a point is that of the parabola
  /// through it and its neighbours. A FILE of lines "X Y DEPTH" or in netCDF is a grid (DepthGrid).
  /// `dip_deg` tilts any of them about x = 0. Throws a usage Error, or one naming file and place.
  static Horizon parse(std::string_view text, double dip_deg = 0);

  double at(double x_m, double y_m = 0) const;
  bool is_plane() const { return amplitude_m_ == 0 && points_.empty() && !grid_; }
  /// Only then it may change along y.
  bool is_grid() const { return grid_.has_value(); }
  /// Of the plane at x = 0.
  double depth_m() const { return depth_m_; }
  /// Where a curve or grid ends on either side, along x (axis 0) or y (1): from there on it is level.
  /// Infinite where there is none.
  double from_m(int axis = 0) const;
  double to_m(int axis = 0) const;
  /// As a message names it: "400 m", "sine,400,20,500", "@top.txt".
  const std::string& name() const { return name_; }
  /// The same with its dip: "400 m dip 15".
  std::string name_with_dip() const;

 private:
  void read(const std::string& path);

  double depth_m_ = 0, dip_deg_ = 0, slope_ = 0;
  double amplitude_m_ = 0, wavelength_m_ = 1, phase_deg_ = 0;
  std::vector<Point<2>> points_;
  std::vector<double> slopes_;  // at the points, of a smooth curve; else empty
  std::optional<DepthGrid> grid_;
  bool smooth_ = false;
  std::string name_ = "0 m";
};

}  // namespace slipwave
