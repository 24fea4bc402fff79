// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geology/depth_grid.hpp"
#include "grid/grid.hpp"

namespace slipwave {

/// Everything that says where a horizon is: a plane, and what is added to it.
struct HorizonShape {
  double depth_m = 0, dip_deg = 0;                          // of the plane at x = 0
  double amplitude_m = 0, wavelength_m = 1, phase_deg = 0;  // of a sine; amplitude 0: none
  std::vector<Point<2>> points_m = {};                      // of a curve: x and what it adds
  std::optional<DepthGrid> grid = {};                       // in place of a curve
  bool smooth = false;                                      // with continuous slopes between them
  bool endless = false;                                     // level beyond the ends of curve or grid
  std::string name;                                         // as a message names it
};

/// The top of a layer over x, the same all along y: a plane, to which a sine or a curve through points may be
/// added. In 3-D also a surface through the nodes of a grid.
class Horizon {
 public:
  Horizon() = default;
  /// z = depth + x tan(dip), deepening towards +x where the dip is positive. Throws a usage Error unless
  /// |dip| < 90 degrees.
  explicit Horizon(double depth_m, double dip_deg = 0);
  /// Throws a usage Error for a dip as above or a wavelength not above zero.
  explicit Horizon(HorizonShape shape);
  /// "DEPTH"; "sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]" for z = MEAN + AMPLITUDE sin(360 x/WAVELENGTH + PHASE)
  /// in degrees; "@FILE" for straight lines between points "X Z", one a line, x ascending; "smooth@FILE" for
  /// a curve with a continuous slope through them: cubics whose slope at a point is that of the parabola
  /// through it and its neighbours. A FILE of lines "X Y DEPTH" or in netCDF is a grid (DepthGrid).
  /// `dip_deg` tilts any of them about x = 0. Throws a usage Error, or one naming file and place.
  static Horizon parse(std::string_view text, double dip_deg = 0);

  double at(double x_m, double y_m = 0) const;
  const HorizonShape& shape() const { return shape_; }
  bool is_plane() const { return shape_.amplitude_m == 0 && shape_.points_m.empty() && !shape_.grid; }
  /// Only then it may change along y.
  bool is_grid() const { return shape_.grid.has_value(); }
  /// Returns the depth of the plane at x = 0, in m.
  double depth_m() const { return shape_.depth_m; }
  /// These return where a curve or grid begins and ends along x (axis 0) or y (1), in m: beyond it is level.
  /// They are infinite where there is none, or it is endless.
  double from_m(int axis = 0) const;
  double to_m(int axis = 0) const;
  /// Returns how a message names it: "400 m", "sine,400,20,500", "@top.txt".
  const std::string& name() const { return shape_.name; }
  /// Returns name() with the dip: "400 m dip 15".
  std::string name_with_dip() const;

 private:
  HorizonShape shape_{.name = "0 m"};
  double slope_ = 0;
  std::vector<double> slopes_;  // at the points, of a smooth curve; else empty
};

}  // namespace slipwave
