// SPDX-License-Identifier: BSD-3-Clause
#include "plot/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "grid/grid_netcdf.hpp"
#include "grid/true_depth.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_units.hpp"
#include "model/model_netcdf.hpp"
#include "model/planar_fracture.hpp"
#include "plot/derived_property.hpp"
#include "plot/ticks.hpp"
#include "rock/property_range.hpp"

namespace slipwave::plot {
namespace {

/// Refuses what check(model) would.
template <int D>
void check_range(const NetcdfFile& file, const Field<D>& field, const PropertyRow& row) {
  for (std::size_t cell = 0; cell < field.size(); ++cell)
    if (!is_in_range(row, double(field[cell])))
      throw Error(file.shown_name() + ": " + row.name + " at " + place_of(field.grid(), std::int64_t(cell)) +
                  " is " + shown_float(double(field[cell])) + ", expected " + expected_values(row));
}

template <int D>
Field<D> read_stored(const NetcdfFile& file, const Grid<D>& grid, const std::string& name) {
  if (!file.has_variable(name)) {
    const auto property = find_property(name);
    const bool optional = property && row_of(*property).if_absent;
    throw Error(file.shown_name() + ": found no variable '" + name + "', expected a model" +
                    (optional ? " with it" : ""),
                optional ? ErrorKind::usage : ErrorKind::data);
  }
  if (file.variable(name).dimensions != field_dimensions<D>())
    throw Error(file.shown_name() + ": " + name + ": is not a field of z and x" +
                (D == 2 ? ", expected a model in two dimensions" : " and y, expected a model"));
  const auto values = file.get_physical(name);
  Field<D> field(grid);
  std::copy(values.begin(), values.end(), field.begin());
  const auto property = find_property(name);
  if (property)
    if (const auto conversion = conversion_of(file, name, row_of(*property).units); conversion.changes())
      for (auto& value : field) value = float(conversion(double(value)));
  // Where rock is missing the others are not asked for.
  if (property && !row_of(*property).if_absent) check_range(file, field, row_of(*property));
  return field;
}

template <int D>
Field<D> read_property(const NetcdfFile& file, const Grid<D>& grid, const std::string& name) {
  const auto derived = find_derived_property(name);
  if (!derived) return read_stored(file, grid, name);
  const auto part = [&](bool of_it, const char* stored) {
    return of_it ? read_stored(file, grid, stored) : Field<D>();
  };
  const auto vp = part(derived->of_vp, "vp"), vs = part(derived->of_vs, "vs");
  const auto rho = part(derived->of_rho, "rho");
  const auto at = [](const Field<D>& field, std::size_t cell) {
    return field.empty() ? 0.0 : double(field[cell]);
  };
  Field<D> field(grid);
  for (std::size_t cell = 0; cell < field.size(); ++cell)
    field[cell] = float(derived->value({at(vp, cell), at(vs, cell), at(rho, cell)}));
  return field;
}

template <int D>
Field<D, std::uint8_t> read_codes(const NetcdfFile& file, const Grid<D>& grid, std::size_t sets) {
  const auto codes = file.get<std::uint8_t>("fracture");
  if (codes.size() != std::size_t(grid.size()))
    throw Error(file.shown_name() + ": fracture: found " + std::to_string(codes.size()) +
                " values, expected " + std::to_string(grid.size()));
  Field<D, std::uint8_t> field(grid);
  std::copy(codes.begin(), codes.end(), field.begin());
  const auto highest = *std::max_element(codes.begin(), codes.end());
  if (highest > sets)
    throw Error(file.shown_name() + ": fracture: found the code " + std::to_string(int(highest)) +
                ", expected 0 to " + std::to_string(sets));
  return field;
}

/// Sets as a section shows them: their normals without the part across it, and where it meets single
/// fractures, or those that lie in its cells.
std::vector<FractureSet<2>> seen_in_section(const std::vector<FractureSet<3>>& sets, const Slice& plane,
                                            double spacing_m) {
  const auto [across, down] = axes_left(plane.axis);
  std::vector<FractureSet<2>> seen;
  for (const auto& set : sets) {
    seen.push_back({set.name, {}});
    for (const auto& system : set.systems) {
      const auto& n = system.normal;
      const double length = std::hypot(n[across], n[down]);
      if (length < 0.01) continue;  // planes along the section draw no lines on it
      SlipSystem<2> flat;
      flat.normal = {n[across] / length, n[down] / length};
      seen.back().systems.push_back(flat);
    }
    auto& traces = seen.back().traces;
    for (const auto& polygon : set.traces)
      for (auto& line : met_by_plane(polygon, plane.axis, plane.at_m, spacing_m / 2))
        traces.push_back(std::move(line));
    // Cells beside single fractures are not those of a cluster, though the section meets none.
    if (!set.is_cluster() && traces.empty()) traces.emplace_back();
  }
  return seen;
}

/// Models without void, nearly all, say so in the range of rho: then rho itself need not be read.
bool may_have_void(const NetcdfFile& file) {
  const auto range = file.number_attribute("rho", "actual_range");
  return !range || range->empty() || !(range->front() > 0);
}

/// Without its values.
ModelSection begun_section(const NetcdfFile& file, const std::string& property) {
  ModelSection section;
  section.property = property;
  if (const auto row = find_property(property)) section.unit = typeset_unit(row_of(*row).shown_unit);
  if (const auto derived = find_derived_property(property)) {
    section.property = derived->label;
    section.unit = derived->unit;
  }
  section.title = file.text_attribute("", "title").value_or("");
  return section;
}

/// Makes values NaN where rho is 0: there is no rock.
void take_void_out(ModelSection& section, const Field<2>& rho) {
  for (std::size_t cell = 0; cell < rho.size(); ++cell)
    if (rho[cell] == 0) section.values[cell] = std::numeric_limits<float>::quiet_NaN();
}

std::vector<ModelSection> sections_of(const NetcdfFile& file, const Grid<3>& grid,
                                      const std::string& property, const std::vector<CellLayer>& layers) {
  std::vector<ModelSection> sections(layers.size(), begun_section(file, property));
  {
    const auto values = read_property(file, grid, property);
    for (std::size_t n = 0; n < layers.size(); ++n) {
      sections[n].axes = section_axes(layers[n].axis);
      sections[n].values = section_of(values, layers[n]);
    }
  }
  if (may_have_void(file)) {
    const auto rho = read_stored(file, grid, "rho");
    for (std::size_t n = 0; n < layers.size(); ++n) take_void_out(sections[n], section_of(rho, layers[n]));
  }
  if (file.has_variable("fracture")) {
    const auto sets = read_fracture_sets<3>(file);
    const auto codes = read_codes(file, grid, sets.size());
    for (std::size_t n = 0; n < layers.size(); ++n) {
      sections[n].sets = seen_in_section(sets, plane_of(grid, layers[n]), grid.spacing_m);
      sections[n].fracture = section_of(codes, layers[n]);
    }
  }
  return sections;
}

}  // namespace

namespace {

/// Quality factors from which rock is next to elastic: cells that hold a little of rock that attenuates have
/// millions, beside which all others would be of one colour.
constexpr float next_to_elastic = 1000;

/// From the least to the greatest value below a limit.
Limits range_below(std::span<const ModelSection> sections, float limit) {
  Limits range{INFINITY, -INFINITY};
  for (const auto& section : sections) {
    for (const float value : section.values) {
      if (!std::isfinite(value) || value >= limit) continue;
      range.low = std::min(range.low, double(value));
      range.high = std::max(range.high, double(value));
    }
  }
  return range.low > range.high ? Limits{0, 1} : range;
}

}  // namespace

ValueRange range_of(std::span<const ModelSection> sections) {
  const auto& property = sections.front().property;
  const Limits all = range_below(sections, INFINITY);
  const bool attenuates = (property == "qp" || property == "qs") && all.low < double(next_to_elastic);
  return {all, attenuates ? range_below(sections, next_to_elastic) : all};
}

std::string range_in_words(const ModelSection& section, const Limits& range) {
  std::string words = section.property + " " + shown(range.low, 4);
  if (range.low < range.high) words += " to " + shown(range.high, 4);
  return words + (section.unit.empty() ? "" : " " + section.unit);
}

std::vector<ModelSection> read_model_sections(const NetcdfFile& file, const std::string& property,
                                              std::span<const Slice> planes) {
  const auto grid = read_grid<3>(file);
  std::vector<CellLayer> layers;
  for (const auto& plane : planes)
    layers.push_back(in_place(file.shown_name(), [&] { return layer_on(grid, plane); }));
  return sections_of(file, grid, property, layers);
}

std::vector<Slice> planes_of(const Grid<3>& grid, const WantedPlanes& wanted) {
  const bool thin = std::any_of(grid.shape.begin(), grid.shape.end(), [](auto cells) { return cells == 1; });
  if (wanted.slice || thin) return {plane_of(grid, layer_to_show(grid, wanted.slice))};
  std::vector<Slice> planes;
  for (const int axis : {0, 1, 2}) {
    const auto along = std::size_t(axis);
    const auto [low, high] =
        axis == 2 ? depth_extent(grid) : std::array{grid.origin_m[along], grid.end(axis)};
    double at_m = (low + high) / 2;
    if (wanted.through)
      at_m = (*wanted.through)[along];
    else if (const auto& source = wanted.source;
             source && axis != 2 && (*source)[along] >= low && (*source)[along] <= high)
      at_m = (*source)[along];
    planes.push_back(plane_of(grid, layer_on(grid, {axis, at_m})));
  }
  return planes;
}

ModelSection read_model_section(const NetcdfFile& file, const std::string& property,
                                const std::optional<Slice>& slice) {
  if (dimension_of(file) == 3) {
    const auto grid = read_grid<3>(file);
    const auto layer = in_place(file.shown_name(), [&] { return layer_to_show(grid, slice); });
    return std::move(sections_of(file, grid, property, {layer}).front());
  }
  if (slice)
    throw Error(file.shown_name() + ": found a model in 2-D, expected one in 3-D with --slice",
                ErrorKind::usage);
  auto section = begun_section(file, property);
  const auto grid = read_grid<2>(file);
  section.values = read_property(file, grid, property);
  if (may_have_void(file)) take_void_out(section, read_stored(file, grid, "rho"));
  if (file.has_variable("fracture")) {
    section.sets = read_fracture_sets<2>(file);
    section.fracture = read_codes(file, grid, section.sets.size());
  }
  return section;
}

namespace {

/// Depths of the faces of a column of a fitted grid at a place on x within it.
std::vector<double> faces_at(const Grid<2>& grid, std::int64_t column, double x_m) {
  const double share = std::clamp((x_m - grid.origin_m[0]) / grid.spacing_m - double(column), 0., 1.);
  std::vector<double> faces(std::size_t(grid.shape[1]) + 1);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const double left = grid.rows->corner({column, std::int64_t(k)});
    faces[k] = left + share * (grid.rows->corner({column + 1, std::int64_t(k)}) - left);
  }
  return faces;
}

}  // namespace

GridPixels pixels_of(const Panel& panel, const Page& page, const Grid<2>& grid) {
  const Rect& plot = panel.plot();
  const int width = pixels_along(plot.width, page), height = pixels_along(plot.height, page);
  GridPixels pixels{cells_of_pixels(panel.x_scale(), plot.x, plot.right(), width,
                                    even_edges(grid.origin_m[0], grid.spacing_m, grid.shape[0])),
                    {},
                    {},
                    std::size_t(height)};
  if (!grid.rows) {
    pixels.rows = cells_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height,
                                  even_edges(grid.origin_m[1], grid.spacing_m, grid.shape[1]));
    return pixels;
  }
  const double pixel_pt = plot.width / width;
  pixels.curvilinear_rows = [=, x = panel.x_scale(), y = panel.y_scale()](std::size_t pixel,
                                                                          std::int64_t column) {
    const double middle_m = x.value(plot.x + (double(pixel) + 0.5) * pixel_pt);
    return cells_of_pixels(y, plot.y, plot.bottom(), height, faces_at(grid, column, middle_m));
  };
  return pixels;
}

namespace {

/// Columns of a fitted grid interpolated along their rows, and each column of pixels between its rows.
Raster interpolated_curvilinear(const Field<2>& field, const Panel& panel, const std::vector<Mix>& columns,
                                int height, Take take) {
  const auto& grid = field.grid();
  const Rect& plot = panel.plot();
  Raster raster{int(columns.size()), height, {}};
  raster.values.assign(columns.size() * std::size_t(height), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t pixel = 0; pixel < columns.size(); ++pixel) {
    if (columns[pixel].cells.first == columns[pixel].cells.last) continue;
    const double at_m =
        panel.x_scale().value(plot.x + (double(pixel) + 0.5) * plot.width / double(columns.size()));
    const auto column = std::clamp(std::int64_t(std::floor((at_m - grid.origin_m[0]) / grid.spacing_m)),
                                   std::int64_t(0), grid.shape[0] - 1);
    const auto faces = faces_at(grid, column, at_m);
    std::vector<float> line(faces.size() - 1);
    for (std::size_t k = 0; k < line.size(); ++k)
      line[k] = mixed([&](std::int64_t i) { return field({i, std::int64_t(k)}); }, columns[pixel], take);
    const auto rows =
        mixes_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height, faces, middles_of(faces));
    for (std::size_t n = 0; n < rows.size(); ++n)
      raster.values[n * columns.size() + pixel] =
          mixed([&](std::int64_t k) { return line[std::size_t(k)]; }, rows[n], take);
  }
  return raster;
}

}  // namespace

Raster shown_values(const Field<2>& field, const Panel& panel, const Page& page, Take take,
                    const Look& look) {
  const auto& grid = field.grid();
  if (!look.interpolate.value_or(false)) return reduced(field, pixels_of(panel, page, grid), take);
  const Rect& plot = panel.plot();
  const int width = pixels_along(plot.width, page), height = pixels_along(plot.height, page);
  const auto mixes = [&](const Scale& scale, double begin, double end, int pixels, std::size_t axis) {
    const auto edges = even_edges(grid.origin_m[axis], grid.spacing_m, grid.shape[axis]);
    return mixes_of_pixels(scale, begin, end, pixels, edges, middles_of(edges));
  };
  const auto columns = mixes(panel.x_scale(), plot.x, plot.right(), width, 0);
  if (grid.rows) return interpolated_curvilinear(field, panel, columns, height, take);
  const auto rows = mixes(panel.y_scale(), plot.y, plot.bottom(), height, 1);
  return interpolated([&](std::int64_t k) { return field.line(k).data(); }, columns, rows, take);
}

template <class Value>
Raster reduced(const Field<2, Value>& field, const GridPixels& pixels, Take take) {
  if (!pixels.curvilinear_rows)
    return reduced<Value>([&](std::int64_t k) { return field.line(k).data(); }, pixels.columns, pixels.rows,
                          take);
  Raster raster{int(pixels.columns.size()), int(pixels.height), {}};
  raster.values.resize(pixels.columns.size() * pixels.height);
  std::vector<Reduction> column(pixels.height);
  for (std::size_t pixel = 0; pixel < pixels.columns.size(); ++pixel) {
    std::fill(column.begin(), column.end(), Reduction(take));
    for (auto i = pixels.columns[pixel].first; i < pixels.columns[pixel].last; ++i) {
      const auto rows = pixels.curvilinear_rows(pixel, i);
      for (std::size_t n = 0; n < rows.size(); ++n)
        for (auto k = rows[n].first; k < rows[n].last; ++k) column[n].add(float(field({i, k})));
    }
    for (std::size_t n = 0; n < column.size(); ++n)
      raster.values[n * pixels.columns.size() + pixel] = column[n].value();
  }
  return raster;
}

SectionAxes axes_of(const Grid<2>& grid, const Look& look, const std::array<const char*, 2>& names) {
  const auto [top, bottom] = depth_extent(grid);
  SectionAxes axes{{names[0], "m", grid.origin_m[0], grid.end(0)}, {names[1], "m", top, bottom}};
  axes.depth.upwards = false;
  narrow(axes.x, look.x, "--x");
  narrow(axes.depth, look.y, "--y");
  for (auto* axis : {&axes.x, &axes.depth}) {
    for (const double end : {axes.x.low, axes.x.high, axes.depth.low, axes.depth.high})
      axis->shared = std::max(axis->shared, std::fabs(end));
  }
  return axes;
}

double height_per_width(const Axis& x, const Axis& depth) {
  return (depth.high - depth.low) / (x.high - x.low);
}

template Raster reduced(const Field<2, float>&, const GridPixels&, Take);
template Raster reduced(const Field<2, std::uint8_t>&, const GridPixels&, Take);

}  // namespace slipwave::plot
