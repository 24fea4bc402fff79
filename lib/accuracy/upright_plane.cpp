// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/upright_plane.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "grid/locate.hpp"

namespace slipwave {
namespace {

/// Receivers whose directions from the source differ by less than this share a plane, degrees.
constexpr double same_direction_deg = 10;
/// Columns of a plane beyond its source and receivers.
constexpr std::int64_t columns_beyond = 16;

/// A straight line on the map through the source.
struct MapLine {
  Point<3> source_m;
  double cosine, sine;
  Point<3> at(double along_m, double depth_m) const {
    return {source_m[0] + along_m * cosine, source_m[1] + along_m * sine, depth_m};
  }
  double along(const Point<3>& point_m) const {
    return (point_m[0] - source_m[0]) * cosine + (point_m[1] - source_m[1]) * sine;
  }
};

/// The cells under a line, column by column those that it runs through.
class SliceOfCells {
 public:
  /// From `low_m` to `high_m` of the source on, as far as the model reaches.
  SliceOfCells(const Medium<3>& medium, const MapLine& line, double low_m, double high_m)
      : medium_(medium), line_(line) {
    const auto& from = medium.grid();
    const double h = from.spacing_m;
    const std::size_t axis = std::abs(line.cosine) >= std::abs(line.sine) ? 0 : 1;
    // Along an axis columns are those of the model.
    const double place = (line.source_m[axis] - from.origin_m[axis]) / h, sign = way(axis);
    const double part = sign > 0 ? place - std::floor(place) : std::ceil(place) - place;
    const auto reach = [&](double far_m) {
      auto cells = std::int64_t(std::ceil(std::abs(far_m) / h)) + columns_beyond;
      while (cells > 0 && !inside(line.at(std::copysign(double(cells) * h, far_m), 0))) --cells;
      return cells;
    };
    const auto before = reach(std::min(low_m, -0.)), behind = reach(std::max(high_m, 0.));
    grid_.shape = {std::max<std::int64_t>(before + behind, 1), from.shape[2]};
    grid_.spacing_m = h;
    first_m_ = -(double(before) + part) * h;
    grid_.origin_m = {line.source_m[0] + first_m_, from.origin_m[2]};
    if (from.rows) grid_.rows = std::make_shared<const RowDepths<2>>(rows());
  }
  const Grid<2>& grid() const { return grid_; }
  Medium<2> medium() const {
    Medium<2> slice(grid_, medium_);
    const auto properties = medium_.properties();
    for (std::int64_t n = 0; n < grid_.size(); ++n) {
      const auto at = grid_.index(n);
      auto cell = column(at[0]);
      cell[2] = at[1];
      const auto from = std::size_t(medium_.grid().flat(cell));
      for (const Property property : properties) slice[property][std::size_t(n)] = medium_[property][from];
    }
    return slice;
  }

 private:
  double way(std::size_t axis) const { return axis == 0 ? line_.cosine : line_.sine; }
  double along(std::int64_t i, double part) const { return first_m_ + (double(i) + part) * grid_.spacing_m; }
  bool inside(const Point<3>& point_m) const {
    for (const std::size_t axis : {0, 1})
      if (point_m[axis] < medium_.grid().origin_m[axis] || point_m[axis] > medium_.grid().end(int(axis)))
        return false;
    return true;
  }
  Index<3> column(std::int64_t i) const {
    const auto& from = medium_.grid();
    const auto point = line_.at(along(i, 0.5), 0);
    Index<3> cell{};
    for (const std::size_t axis : {0, 1})
      cell[axis] = std::clamp<std::int64_t>(
          std::int64_t(std::floor((point[axis] - from.origin_m[axis]) / from.spacing_m)) - from.first[axis],
          0, from.shape[axis] - 1);
    return cell;
  }
  RowDepths<2> rows() const {
    const auto& from = medium_.grid();
    std::vector<double> corners;
    for (std::int64_t k = 0; k <= grid_.shape[1]; ++k)
      for (std::int64_t i = 0; i <= grid_.shape[0]; ++i) {
        auto at = from.in_cells(line_.at(along(i, 0), 0));
        at[2] = double(k);
        corners.push_back(from.rows->row_is_level(k) ? from.rows->row(k)[0] : from.rows->depth(at));
      }
    return {grid_.shape, std::move(corners), from.rows->horizons()};
  }

  const Medium<3>& medium_;
  const MapLine& line_;
  Grid<2> grid_;
  double first_m_ = 0;
};

/// The part of a source that moves a plane, and how strong the rest is against it.
Mechanism<2> part_along(const PointInjection<3>& injection, const MapLine& line, UprightPlane& plane) {
  const double c = line.cosine, s = line.sine;
  const auto& f = injection.force;
  const auto& m = injection.moment_rate;
  const Point<2> force = {f[0] * c + f[1] * s, f[2]};
  SymmetricTensor<2, double> moment{};
  moment(0, 0) = c * c * m(0, 0) + 2 * c * s * m(0, 1) + s * s * m(1, 1);
  moment(0, 1) = c * m(0, 2) + s * m(1, 2);
  moment(1, 1) = m(2, 2);
  const double shear = c * s * (m(1, 1) - m(0, 0)) + (c * c - s * s) * m(0, 1);
  const double across = std::hypot(f[1] * c - f[0] * s, shear, c * m(1, 2) - s * m(0, 2));
  const double along = std::hypot(std::hypot(force[0], force[1]), std::hypot(moment(0, 0), moment(1, 1)),
                                  std::numbers::sqrt2 * moment(0, 1));
  plane.still = along <= 1e-9 * across;
  plane.moves_across = across > 0.1 * along;
  if (injection.isotropic) return Explosion{};
  if (force[0] != 0 || force[1] != 0) return PointForce<2>{force};
  return MomentTensor<2>{moment};
}

UprightPlane plane_of(const Scene<3>& scene, const Source<3>& source, const MapLine& line,
                      const std::vector<Point<3>>& receivers) {
  UprightPlane plane;
  plane.receivers_m = receivers;
  plane.along_x = std::abs(line.sine) < 1e-9;
  double low = 0, high = 0;
  auto& survey = plane.scene.survey;
  for (const auto& receiver : receivers) {
    const double side = line.along(receiver) < 0 ? -1 : 1;
    const double away =
        side * std::hypot(receiver[0] - source.position_m[0], receiver[1] - source.position_m[1]);
    low = std::min(low, away), high = std::max(high, away);
    survey.receivers_m.push_back({source.position_m[0] + away, receiver[2]});
  }
  const SliceOfCells slice(scene.model.medium, line, low, high);
  plane.scene.model.medium = slice.medium();
  plane.scene.model.history = scene.model.history;
  const auto injection = point_injection(source);
  survey.sources = {{{source.position_m[0], source.position_m[2]},
                     part_along(*injection, line, plane),
                     source.wavelet,
                     source.amplitude,
                     source.delay_s}};
  plane.scene.edges[0] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  plane.scene.edges[1] = scene.edges[2];
  plane.scene.numerics = scene.numerics;
  plane.scene.recording = scene.recording;
  plane.scene.recording.fibre.reset();
  plane.scene.attenuation = scene.attenuation;
  return plane;
}

}  // namespace

std::vector<UprightPlane> upright_planes(const Scene<3>& scene, std::size_t shot, std::size_t receivers) {
  const auto& source = scene.survey.sources[shot];
  if (!point_injection(source)) return {};
  struct Group {
    double azimuth;
    std::vector<Point<3>> receivers;
  };
  std::vector<Group> groups;
  const auto all = scene.survey.receivers_of(shot + 1);
  const std::size_t stride = std::max<std::size_t>(1, (all.size() + receivers - 1) / receivers);
  for (std::size_t n = stride / 2; n < all.size(); n += stride) {
    const auto& at = all[n].point_m;
    const double x = at[0] - source.position_m[0], y = at[1] - source.position_m[1];
    const bool above = std::hypot(x, y) < scene.model.grid().spacing_m;
    double azimuth = above && !groups.empty() ? groups.front().azimuth : above ? 0 : std::atan2(y, x);
    // Both ways along a line are one plane.
    if (azimuth < -1e-9) azimuth += std::numbers::pi;
    const auto near = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return std::abs(std::remainder(azimuth - group.azimuth, std::numbers::pi)) <
             same_direction_deg * std::numbers::pi / 180;
    });
    if (near != groups.end())
      near->receivers.push_back(at);
    else
      groups.push_back({azimuth, {at}});
  }
  std::vector<UprightPlane> planes;
  for (const auto& group : groups) {
    const MapLine line{source.position_m, std::cos(group.azimuth), std::sin(group.azimuth)};
    planes.push_back(plane_of(scene, source, line, group.receivers));
  }
  return planes;
}

}  // namespace slipwave
