// SPDX-License-Identifier: BSD-3-Clause
#include "grid/slice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "grid/true_depth.hpp"

namespace slipwave {
namespace {

/// Corners of a layer of a fitted grid: those before and behind it, and its own number of cells.
std::vector<double> corners_of(const Grid<3>& grid, const CellLayer& layer) {
  const auto [across, down] = axes_left(layer.axis);
  const auto axis = std::size_t(layer.axis);
  Index<3> count{};
  count[axis] = 2;
  count[across] = grid.shape[across] + 1;
  count[down] = grid.shape[down] + 1;
  std::vector<double> corners;
  Index<3> at{};
  for (at[2] = 0; at[2] < count[2]; ++at[2])
    for (at[1] = 0; at[1] < count[1]; ++at[1])
      for (at[0] = 0; at[0] < count[0]; ++at[0]) {
        Index<3> from = at;
        from[axis] += layer.number;
        for (std::size_t n = 0; n < 3; ++n) from[n] += grid.first[n];
        corners.push_back(grid.rows->corner(from));
      }
  return corners;
}

template <class Value>
constexpr Value nothing() {
  return std::numeric_limits<Value>::has_quiet_NaN ? std::numeric_limits<Value>::quiet_NaN() : Value{};
}

/// Calls take(cell of the layer, counted x fastest, value).
template <class Value, class Take>
void over_layer(const Field<3, Value>& field, const CellLayer& layer, Take&& take) {
  const auto& grid = field.grid();
  auto shape = grid.shape;
  shape[std::size_t(layer.axis)] = 1;
  const Grid<3> cells{shape, grid.spacing_m, {}};
  for (std::int64_t n = 0; n < cells.size(); ++n) {
    auto at = cells.index(n);
    at[std::size_t(layer.axis)] =
        layer.depth_m ? row_between(faces_of_column(grid, at), *layer.depth_m) : layer.number;
    take(std::size_t(n), at[std::size_t(layer.axis)] < 0 ? nothing<Value>() : field(at));
  }
}

}  // namespace

Slice parse_slice(std::string_view text) {
  const auto parts = split(text, '=');
  const auto axis = std::string_view("xyz").find(parts[0]);
  if (parts.size() != 2 || parts[0].size() != 1 || axis == std::string_view::npos)
    throw Error("found '" + std::string(text) + "', expected a plane like y=500", ErrorKind::usage);
  return {int(axis), parse_number(parts[1])};
}

CellLayer layer_on(const Grid<3>& grid, const Slice& slice) {
  const bool curvilinear = slice.axis == 2 && grid.rows;
  const auto [low, high] = curvilinear
                               ? depth_extent(grid)
                               : std::array{grid.origin_m[std::size_t(slice.axis)], grid.end(slice.axis)};
  if (!(slice.at_m >= low && slice.at_m <= high))
    throw Error("found " + std::string(1, axis_names<3>()[std::size_t(slice.axis)]) + "=" +
                    shown(slice.at_m) + ", expected it from " + shown(low) + " to " + shown(high),
                ErrorKind::usage);
  if (curvilinear) return {2, 0, slice.at_m};
  const auto cell = std::int64_t(std::floor((slice.at_m - low) / grid.spacing_m));
  return {slice.axis, std::min(cell, grid.shape[std::size_t(slice.axis)] - 1)};
}

CellLayer layer_to_show(const Grid<3>& grid, const std::optional<Slice>& slice) {
  if (slice) return layer_on(grid, *slice);
  for (const int axis : {1, 0, 2})
    if (grid.shape[std::size_t(axis)] == 1) return {axis, 0};
  throw Error("found a volume, expected --slice AXIS=AT, for example --slice y=" +
                  shown((grid.origin_m[1] + grid.end(1)) / 2),
              ErrorKind::usage);
}

Slice plane_of(const Grid<3>& grid, const CellLayer& layer) {
  return {layer.axis, layer.depth_m ? *layer.depth_m : grid.centre(layer.axis, layer.number)};
}

std::array<std::size_t, 2> axes_left(int axis) { return {axis == 0 ? 1U : 0U, axis == 2 ? 1U : 2U}; }

std::array<const char*, 2> section_axes(int axis) {
  constexpr const char* names[] = {"x", "y", "depth"};
  const auto [across, down] = axes_left(axis);
  return {names[across], names[down]};
}

Grid<3> layer_of(const Grid<3>& grid, const CellLayer& layer) {
  const auto axis = std::size_t(layer.axis);
  Grid<3> part = grid;
  part.shape[axis] = 1;
  if (layer.depth_m) {
    part.origin_m[axis] = *layer.depth_m - grid.spacing_m / 2;
    part.first[axis] = 0;
    part.rows = nullptr;
    return part;
  }
  part.origin_m[axis] += double(layer.number) * grid.spacing_m;
  if (grid.rows && layer.axis != 2) {
    part.rows =
        std::make_shared<const RowDepths<3>>(part.shape, corners_of(grid, layer), grid.rows->horizons());
    for (std::size_t n = 0; n < 3; ++n) part.origin_m[n] += double(grid.first[n]) * grid.spacing_m;
    part.first = {};
  }
  return part;
}

Field<3> layer_of(const Field<3>& field, const CellLayer& layer) {
  Field<3> part(layer_of(field.grid(), layer));
  over_layer(field, layer, [&](std::size_t n, float value) { part[n] = value; });
  return part;
}

Grid<2> section_grid(const Grid<3>& grid, const CellLayer& layer) {
  const auto [across, down] = axes_left(layer.axis);
  Grid<2> section = {
      {grid.shape[across], grid.shape[down]}, grid.spacing_m, {grid.origin_m[across], grid.origin_m[down]}};
  if (!grid.rows || layer.axis == 2) return section;
  // Half way between the corners before and behind.
  const RowDepths<3> part(layer_of(grid, layer).shape, corners_of(grid, layer));
  std::vector<double> corners;
  for (std::int64_t k = 0; k <= section.shape[1]; ++k)
    for (std::int64_t i = 0; i <= section.shape[0]; ++i) {
      Index<3> at{};
      at[across] = i;
      at[down] = k;
      const double before = part.corner(at);
      at[std::size_t(layer.axis)] = 1;
      corners.push_back((before + part.corner(at)) / 2);
    }
  section.rows =
      std::make_shared<const RowDepths<2>>(section.shape, std::move(corners), grid.rows->horizons());
  return section;
}

template <class Value>
Field<2, Value> section_of(const Field<3, Value>& field, const CellLayer& layer) {
  Field<2, Value> section(section_grid(field.grid(), layer));
  over_layer(field, layer, [&](std::size_t n, Value value) { section[n] = value; });
  return section;
}

template Field<2, float> section_of(const Field<3, float>&, const CellLayer&);
template Field<2, std::uint8_t> section_of(const Field<3, std::uint8_t>&, const CellLayer&);

}  // namespace slipwave
