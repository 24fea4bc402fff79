#include "grid/slice.hpp"

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {

Slice parse_slice(std::string_view text) {
  const auto parts = split(text, '=');
  const auto axis = std::string_view("xyz").find(parts[0]);
  if (parts.size() != 2 || parts[0].size() != 1 || axis == std::string_view::npos)
    throw Error("found '" + std::string(text) + "', expected a plane like y=500", ErrorKind::usage);
  return {int(axis), parse_number(parts[1])};
}

std::int64_t cells_on(const Grid<3>& grid, const Slice& slice) {
  const double low = grid.origin_m[std::size_t(slice.axis)], high = grid.end(slice.axis);
  if (!(slice.at_m >= low && slice.at_m <= high))
    throw Error("found " + std::string(1, axis_names<3>()[std::size_t(slice.axis)]) + "=" +
                    shown(slice.at_m) + ", expected it from " + shown(low) + " to " + shown(high),
                ErrorKind::usage);
  const auto cell = std::int64_t(std::floor((slice.at_m - low) / grid.spacing_m));
  return std::min(cell, grid.shape[std::size_t(slice.axis)] - 1);
}

CellLayer layer_to_show(const Grid<3>& grid, const std::optional<Slice>& slice) {
  if (slice) return {slice->axis, cells_on(grid, *slice)};
  for (const int axis : {1, 0, 2})
    if (grid.shape[std::size_t(axis)] == 1) return {axis, 0};
  throw Error("found a volume, expected --slice AXIS=AT, for example --slice y=" +
                  shown((grid.origin_m[1] + grid.end(1)) / 2),
              ErrorKind::usage);
}

std::array<std::size_t, 2> axes_left(int axis) { return {axis == 0 ? 1U : 0U, axis == 2 ? 1U : 2U}; }

std::array<const char*, 2> section_axes(int axis) {
  constexpr const char* names[] = {"x", "y", "depth"};
  const auto [across, down] = axes_left(axis);
  return {names[across], names[down]};
}

Grid<3> layer_of(const Grid<3>& grid, int axis, std::int64_t number) {
  Grid<3> layer = grid;
  layer.shape[std::size_t(axis)] = 1;
  layer.origin_m[std::size_t(axis)] += double(number) * grid.spacing_m;
  return layer;
}

Field<3> layer_of(const Field<3>& field, int axis, std::int64_t number) {
  Field<3> layer(layer_of(field.grid(), axis, number));
  for (std::int64_t n = 0; n < layer.grid().size(); ++n) {
    auto at = layer.grid().index(n);
    at[std::size_t(axis)] = number;
    layer[std::size_t(n)] = field(at);
  }
  return layer;
}

Grid<2> section_grid(const Grid<3>& grid, int axis) {
  const auto [across, down] = axes_left(axis);
  return {
      {grid.shape[across], grid.shape[down]}, grid.spacing_m, {grid.origin_m[across], grid.origin_m[down]}};
}

template <class Value>
Field<2, Value> section_of(const Field<3, Value>& field, int axis, std::int64_t number) {
  const auto [across, down] = axes_left(axis);
  Field<2, Value> section(section_grid(field.grid(), axis));
  for (std::int64_t n = 0; n < section.grid().size(); ++n) {
    const auto from = section.grid().index(n);
    Index<3> at{};
    at[std::size_t(axis)] = number;
    at[across] = from[0];
    at[down] = from[1];
    section[std::size_t(n)] = field(at);
  }
  return section;
}

template Field<2, float> section_of(const Field<3, float>&, int, std::int64_t);
template Field<2, std::uint8_t> section_of(const Field<3, std::uint8_t>&, int, std::int64_t);

}  // namespace slipwave
