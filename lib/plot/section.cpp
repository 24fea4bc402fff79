#include "plot/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/netcdf_file.hpp"
#include "grid/grid_netcdf.hpp"
#include "model/model_netcdf.hpp"

namespace slipwave::plot {
namespace {

Field<2> read_property(const NetcdfFile& file, const Grid<2>& grid, const std::string& name) {
  if (!file.has_variable(name))
    throw Error(file.shown_name() + ": found no variable '" + name + "', expected a model");
  if (file.variable(name).dimensions != field_dimensions<2>())
    throw Error(file.shown_name() + ": " + name +
                ": is no field of z and x, expected a model in two dimensions");
  const auto values = file.get_physical(name);
  Field<2> field(grid);
  std::copy(values.begin(), values.end(), field.begin());
  return field;
}

/// Models without void, nearly all, say so in the range of rho: then rho itself need not be read.
bool may_have_void(const NetcdfFile& file) {
  const auto range = file.number_attribute("rho", "actual_range");
  return !range || range->empty() || !(range->front() > 0);
}

}  // namespace

ModelSection read_model_section(const NetcdfFile& file, const std::string& property) {
  ModelSection section;
  section.property = property;
  section.unit = property == "rho" ? "kg/m\u00b3" : "m/s";
  const auto grid = read_grid<2>(file);
  section.values = read_property(file, grid, property);
  if (may_have_void(file)) {
    const auto rho = read_property(file, grid, "rho");
    for (std::size_t cell = 0; cell < rho.size(); ++cell) {
      if (rho[cell] == 0) section.values[cell] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  if (file.has_variable("fracture")) {
    section.sets = read_fracture_sets<2>(file);
    const auto codes = file.get<std::uint8_t>("fracture");
    if (codes.size() != std::size_t(grid.size()))
      throw Error(file.shown_name() + ": fracture: found " + std::to_string(codes.size()) +
                  " values, expected " + std::to_string(grid.size()));
    section.fracture = Field<2, std::uint8_t>(grid);
    std::copy(codes.begin(), codes.end(), section.fracture.begin());
    const auto highest = *std::max_element(codes.begin(), codes.end());
    if (highest > section.sets.size())
      throw Error(file.shown_name() + ": fracture: found the code " + std::to_string(int(highest)) +
                  ", expected 0 to " + std::to_string(section.sets.size()));
  }
  section.title = file.text_attribute("", "title").value_or("");
  return section;
}

GridPixels pixels_of(const Panel& panel, const Page& page, const Grid<2>& grid) {
  const Rect& plot = panel.plot();
  return {cells_of_pixels(panel.x_scale(), plot.x, plot.right(), pixels_along(plot.width, page),
                          even_edges(grid.origin_m[0], grid.spacing_m, grid.shape[0])),
          cells_of_pixels(panel.y_scale(), plot.y, plot.bottom(), pixels_along(plot.height, page),
                          even_edges(grid.origin_m[1], grid.spacing_m, grid.shape[1]))};
}

Raster reduced(const Field<2>& field, const GridPixels& pixels, Take take) {
  return reduced<float>([&](std::int64_t k) { return field.line(k).data(); }, pixels.columns, pixels.rows,
                        take);
}

SectionAxes axes_of(const Grid<2>& grid, const Look& look) {
  SectionAxes axes{{"x", "m", grid.origin_m[0], grid.end(0)}, {"depth", "m", grid.origin_m[1], grid.end(1)}};
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

}  // namespace slipwave::plot
