#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// The top of a layer over x: a plane, to which a sine or a curve through points may be added.
class Horizon {
 public:
  Horizon() = default;
  /// z = depth + x tan(dip), deepening towards +x where the dip is positive. Throws a usage Error unless
  /// |dip| < 90 degrees.
  explicit Horizon(double depth_m, double dip_deg = 0);
  /// "DEPTH"; "sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]" for z = MEAN + AMPLITUDE sin(360 x/WAVELENGTH + PHASE)
  /// in degrees; "@FILE" for straight lines between points "X Z", one a line, x ascending; "smooth@FILE" for
  /// a curve with a continuous slope through them: cubics whose slope at a point is that of the parabola
  /// through it and its neighbours. `dip_deg` tilts any of them about x = 0. Throws a usage Error, or one
  /// naming file and line.
  static Horizon parse(std::string_view text, double dip_deg = 0);

  double at(double x_m) const;
  bool is_plane() const { return amplitude_m_ == 0 && points_.empty(); }
  /// Of the plane at x = 0.
  double depth_m() const { return depth_m_; }
  /// Where a curve ends on either side: from there on it is level. Infinite where there is none.
  double from_m() const;
  double to_m() const;
  /// As a message names it: "400 m", "sine,400,20,500", "@top.txt".
  const std::string& name() const { return name_; }

 private:
  double depth_m_ = 0, slope_ = 0;
  double amplitude_m_ = 0, wavelength_m_ = 1, phase_deg_ = 0;
  std::vector<Point<2>> points_;
  std::vector<double> slopes_;  // at the points, of a smooth curve; else empty
  std::string name_ = "0 m";
};

}  // namespace slipwave
