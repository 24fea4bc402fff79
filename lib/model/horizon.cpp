// SPDX-License-Identifier: BSD-3-Clause
#include "model/horizon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "model/points_file.hpp"

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

}  // namespace

Horizon::Horizon(double depth_m, double dip_deg)
    : depth_m_(depth_m),
      dip_deg_(dip_deg),
      slope_(std::tan(dip_deg * std::numbers::pi / 180)),
      name_(shown(depth_m) + " m") {
  if (!(std::abs(dip_deg) < 90)) {
    throw Error("found a dip of " + shown(dip_deg) + " degrees, expected it between -90 and 90",
                ErrorKind::usage);
  }
}

Horizon Horizon::parse(std::string_view text, double dip_deg) {
  Horizon horizon(0, dip_deg);
  const auto parts = split(text, ',');
  constexpr std::string_view smooth = "smooth@";
  if (text.starts_with('@')) {
    horizon.read(std::string(text.substr(1)));
  } else if (text.starts_with(smooth)) {
    horizon.smooth_ = true;
    horizon.read(std::string(text.substr(smooth.size())));
  } else if (parts.front() == "sine") {
    if (parts.size() != 4 && parts.size() != 5) {
      throw Error("found '" + std::string(text) + "', expected sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]",
                  ErrorKind::usage);
    }
    horizon.depth_m_ = parse_number(parts[1]);
    horizon.amplitude_m_ = parse_number(parts[2]);
    horizon.wavelength_m_ = parse_number(parts[3]);
    horizon.phase_deg_ = parts.size() == 5 ? parse_number(parts[4]) : 0;
    if (!(horizon.wavelength_m_ > 0)) {
      throw Error("found a wavelength of " + parts[3] + " m, expected it above zero", ErrorKind::usage);
    }
  } else {
    return Horizon(parse_number(text), dip_deg);
  }
  horizon.name_ = text;
  return horizon;
}

void Horizon::read(const std::string& path) {
  const InputStart start(path, 8);
  if (begins_netcdf({start.bytes().data(), start.bytes().size()})) {
    grid_ = depth_grid_from_netcdf(start.is_regular()
                                       ? NetcdfFile::open(path)
                                       : NetcdfFile::open(read_all(path, start.taken()), shown_input(path)));
    return;
  }
  const auto text = read_text(path, start.taken());
  in_place(shown_input(path), [&] {
    if (columns_of_text(text) == 3) {
      grid_ = DepthGrid::of_points(points_of_text<3>(text));
      return;
    }
    points_ = curve_of(points_of_text<2>(text));
    if (smooth_) slopes_ = smooth_slopes(points_);
  });
}

std::string Horizon::name_with_dip() const {
  return dip_deg_ == 0 ? name_ : name_ + " dip " + shown(dip_deg_);
}

double Horizon::at(double x_m, double y_m) const {
  double depth = depth_m_ + slope_ * x_m;
  if (amplitude_m_ != 0) {
    const double phase = 2 * std::numbers::pi * (x_m / wavelength_m_ + phase_deg_ / 360);
    depth += amplitude_m_ * std::sin(phase);
  }
  if (grid_) return depth + grid_->at(x_m, y_m, smooth_);
  if (points_.empty()) return depth;
  const auto behind = std::upper_bound(points_.begin(), points_.end(), x_m,
                                       [](double x, const Point<2>& point) { return x < point[0]; });
  if (behind == points_.begin()) return depth + points_.front()[1];
  if (behind == points_.end()) return depth + points_.back()[1];
  const auto& a = *(behind - 1);
  const auto& b = *behind;
  const double width = b[0] - a[0], t = (x_m - a[0]) / width;
  depth += a[1] + (b[1] - a[1]) * t;
  if (slopes_.empty()) return depth;
  // What a cubic with the slopes of both ends adds to the straight line.
  const auto n = std::size_t(behind - points_.begin());
  const double slope = slope_between(a, b);
  return depth + width * t * (1 - t) * ((slopes_[n - 1] - slope) * (1 - t) - (slopes_[n] - slope) * t);
}

double Horizon::from_m(int axis) const {
  if (grid_) return (axis == 0 ? grid_->x_m() : grid_->y_m()).front();
  return points_.empty() || axis != 0 ? -std::numeric_limits<double>::infinity() : points_.front()[0];
}

double Horizon::to_m(int axis) const {
  if (grid_) return (axis == 0 ? grid_->x_m() : grid_->y_m()).back();
  return points_.empty() || axis != 0 ? std::numeric_limits<double>::infinity() : points_.back()[0];
}

}  // namespace slipwave
