// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grid/field.hpp"
#include "grid/slice.hpp"
#include "model/model.hpp"
#include "plot/look.hpp"
#include "plot/panel.hpp"
#include "plot/raster.hpp"

namespace slipwave {
class NetcdfFile;
}

namespace slipwave::plot {

/// One property of a model, and its fractures.
struct ModelSection {
  std::string property, unit;       // "vp", "m/s"
  Field<2> values;                  // NaN in void
  Field<2, std::uint8_t> fracture;  // empty when the model has none
  std::vector<FractureSet<2>> sets;
  std::string title;
  std::array<const char*, 2> axes = {"x", "depth"};  // across and down
  const Grid<2>& grid() const { return values.grid(); }
};

/// From the least to the greatest value of sections, and of those that colours show: without quality factors
/// of rock that is next to elastic where other rock is not.
struct ValueRange {
  Limits all, shown;
};
ValueRange range_of(std::span<const ModelSection> sections);

/// "vp 1500 to 4500 m/s", "vp 4500 m/s".
std::string range_in_words(const ModelSection& section, const Limits& range);

/// Reads a property by its name, and nothing else that is large, from a model file; of a model in 3-D what
/// lies on a plane. Throws Error naming the file.
ModelSection read_model_section(const NetcdfFile& file, const std::string& property,
                                const std::optional<Slice>& slice = std::nullopt);

/// Reads the property of a model in 3-D on several planes, at once.
std::vector<ModelSection> read_model_sections(const NetcdfFile& file, const std::string& property,
                                              std::span<const Slice> planes);

/// The planes that a volume is shown on.
struct WantedPlanes {
  std::optional<Slice> slice = {};       // this one alone
  std::optional<Point<3>> through = {};  // three, across x, y and z, through this point,
  std::optional<Point<3>> source = {};   // or the upright ones through this one, if it is within
};
/// One plane, or three where none is wanted: through the middle, if nothing else is said. Of a grid one cell
/// thick that layer. Throws a usage Error when a wanted one misses the grid.
std::vector<Slice> planes_of(const Grid<3>& grid, const WantedPlanes& wanted);

/// The pixels of a panel, and the cells of a grid that each shows.
struct GridPixels {
  std::vector<Cells> columns, rows;
  /// Replaces `rows` in a fitted grid: what a column of pixels shows of a column of cells. Rows are where
  /// they are in the middle of the pixels.
  std::function<std::vector<Cells>(std::size_t pixel, std::int64_t column)> curvilinear_rows = {};
  std::size_t height = 0;  // pixels
  /// Whether a pixel has cells or, of a fitted grid, lies above or below cells.
  bool within(std::size_t pixel) const {
    const Cells& across = columns[pixel % columns.size()];
    if (curvilinear_rows || across.first == across.last) return across.first < across.last;
    const Cells& down = rows[pixel / columns.size()];
    return down.first < down.last;
  }
};
GridPixels pixels_of(const Panel& panel, const Page& page, const Grid<2>& grid);

/// A field reduced to these pixels.
template <class Value>
Raster reduced(const Field<2, Value>& field, const GridPixels& pixels, Take take);

/// Returns the values of a field as `look` asks for them: interpolated between cells, or not.
Raster shown_values(const Field<2>& field, const Panel& panel, const Page& page, Take take, const Look& look);

/// The x and true depth axes of a grid, or of what `look` shows of it, in one unit; and the height of a panel
/// over its width that gives them one scale.
struct SectionAxes {
  Axis x, depth;
};
SectionAxes axes_of(const Grid<2>& grid, const Look& look,
                    const std::array<const char*, 2>& names = {"x", "depth"});
double height_per_width(const Axis& x, const Axis& depth);

/// Outlines fractured cells and, if so wanted, hatches them along their planes, over what is drawn.
void draw_fractures(Canvas& canvas, const Panel& panel, const ModelSection& section, const GridPixels& pixels,
                    const Image& below, bool hatched = true);

}  // namespace slipwave::plot
