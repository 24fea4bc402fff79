// SPDX-License-Identifier: BSD-3-Clause
#include "geology/horizon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "geology/points_file.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {
namespace {

std::vector<Point<2>> curve_of(const std::vector<NumberedPoint<2>>& numbered) {
  std::vector<Point<2>> points;
  for (const auto& point : numbered) {
    if (!points.empty() && !(point.at[0] > points.back()[0])) {
      throw Error("line " + std::to_string(point.line) + ": found x = " + shown(point.at[0]) + " after " +
                  shown(points.back()[0]) + ", expected x to ascend");
    }
    points.push_back(point.at);
  }
  if (points.size() < 2)
    throw Error("found " + std::to_string(points.size()) + " points, expected at least 2");
  return points;
}

double slope_between(const Point<2>& a, const Point<2>& b) { return (b[1] - a[1]) / (b[0] - a[0]); }

/// Slopes at the points of a smooth curve: of the parabola through a point and both its neighbours, at the
/// ends of that through the next point.
std::vector<double> smooth_slopes(const std::vector<Point<2>>& points) {
  const std::size_t last = points.size() - 1;
  if (last == 1) return std::vector<double>(2, slope_between(points[0], points[1]));
  std::vector<double> slopes(points.size(), 0.);
  for (std::size_t n = 1; n < last; ++n) {
    const double before = slope_between(points[n - 1], points[n]),
                 next = slope_between(points[n], points[n + 1]);
    const double left = points[n][0] - points[n - 1][0], right = points[n + 1][0] - points[n][0];
    slopes[n] = (right * before + left * next) / (left + right);
  }
  // A parabola's slope between two points is the mean of those at both.
  slopes[0] = 2 * slope_between(points[0], points[1]) - slopes[1];
  slopes[last] = 2 * slope_between(points[last - 1], points[last]) - slopes[last - 1];
  return slopes;
}

/// The points or the grid of a file.
void read(const std::string& path, HorizonShape& shape) {
  const InputStart start(path, 8);
  if (begins_netcdf({start.bytes().data(), start.bytes().size()})) {
    shape.grid = depth_grid_from_netcdf(
        start.is_regular() ? NetcdfFile::open(path)
                           : NetcdfFile::open(read_all(path, start.taken()), shown_input(path)));
    return;
  }
  const auto text = read_text(path, start.taken());
  in_place(shown_input(path), [&] {
    if (columns_of_text(text) == 3)
      shape.grid = DepthGrid::of_points(points_of_text<3>(text));
    else
      shape.points_m = curve_of(points_of_text<2>(text));
  });
}

}  // namespace

Horizon::Horizon(double depth_m, double dip_deg)
    : Horizon(HorizonShape{.depth_m = depth_m, .dip_deg = dip_deg, .name = shown(depth_m) + " m"}) {}

Horizon::Horizon(HorizonShape shape)
    : shape_(std::move(shape)), slope_(std::tan(shape_.dip_deg * std::numbers::pi / 180)) {
  if (!(std::abs(shape_.dip_deg) < 90)) {
    throw Error("found a dip of " + shown(shape_.dip_deg) + " degrees, expected it between -90 and 90",
                ErrorKind::usage);
  }
  if (!(shape_.wavelength_m > 0)) {
    throw Error("found a wavelength of " + shown(shape_.wavelength_m) + " m, expected it above zero",
                ErrorKind::usage);
  }
  if (shape_.smooth && !shape_.points_m.empty()) slopes_ = smooth_slopes(shape_.points_m);
}

Horizon Horizon::parse(std::string_view text, double dip_deg) {
  HorizonShape shape{.dip_deg = dip_deg, .name = std::string(text)};
  const auto parts = split(text, ',');
  constexpr std::string_view smooth = "smooth@";
  if (text.starts_with('@')) {
    read(std::string(text.substr(1)), shape);
  } else if (text.starts_with(smooth)) {
    shape.smooth = true;
    read(std::string(text.substr(smooth.size())), shape);
  } else if (parts.front() == "sine") {
    if (parts.size() != 4 && parts.size() != 5) {
      throw Error("found '" + std::string(text) + "', expected sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]",
                  ErrorKind::usage);
    }
    shape.depth_m = parse_number(parts[1]);
    shape.amplitude_m = parse_number(parts[2]);
    shape.wavelength_m = parse_number(parts[3]);
    shape.phase_deg = parts.size() == 5 ? parse_number(parts[4]) : 0;
  } else {
    return Horizon(parse_number(text), dip_deg);
  }
  return Horizon(std::move(shape));
}

std::string Horizon::name_with_dip() const {
  return shape_.dip_deg == 0 ? name() : name() + " dip " + shown(shape_.dip_deg);
}

double Horizon::at(double x_m, double y_m) const {
  double depth = shape_.depth_m + slope_ * x_m;
  if (shape_.amplitude_m != 0) {
    const double phase = 2 * std::numbers::pi * (x_m / shape_.wavelength_m + shape_.phase_deg / 360);
    depth += shape_.amplitude_m * std::sin(phase);
  }
  if (shape_.grid) return depth + shape_.grid->at(x_m, y_m, shape_.smooth);
  if (shape_.points_m.empty()) return depth;
  const auto behind = std::upper_bound(shape_.points_m.begin(), shape_.points_m.end(), x_m,
                                       [](double x, const Point<2>& point) { return x < point[0]; });
  if (behind == shape_.points_m.begin()) return depth + shape_.points_m.front()[1];
  if (behind == shape_.points_m.end()) return depth + shape_.points_m.back()[1];
  const auto& a = *(behind - 1);
  const auto& b = *behind;
  const double width = b[0] - a[0], t = (x_m - a[0]) / width;
  depth += a[1] + (b[1] - a[1]) * t;
  if (slopes_.empty()) return depth;
  // What a cubic with the slopes of both ends adds to the straight line.
  const auto n = std::size_t(behind - shape_.points_m.begin());
  const double slope = slope_between(a, b);
  return depth + width * t * (1 - t) * ((slopes_[n - 1] - slope) * (1 - t) - (slopes_[n] - slope) * t);
}

double Horizon::from_m(int axis) const {
  if (shape_.grid && !shape_.endless) return (axis == 0 ? shape_.grid->x_m() : shape_.grid->y_m()).front();
  return shape_.points_m.empty() || shape_.endless || axis != 0 ? -std::numeric_limits<double>::infinity()
                                                                : shape_.points_m.front()[0];
}

double Horizon::to_m(int axis) const {
  if (shape_.grid && !shape_.endless) return (axis == 0 ? shape_.grid->x_m() : shape_.grid->y_m()).back();
  return shape_.points_m.empty() || shape_.endless || axis != 0 ? std::numeric_limits<double>::infinity()
                                                                : shape_.points_m.back()[0];
}

}  // namespace slipwave
