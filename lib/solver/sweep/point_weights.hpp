// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "acquisition/interpolation.hpp"
#include "gather/component.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// A value of the state that a point reads or adds to, and its weight.
struct ValueWeight {
  std::int64_t line = 0;   // number of the line
  std::int64_t place = 0;  // from cell 0 of row 0 of that line
  double weight = 0;
};

/// The weight of the value of a stored row in a cell.
template <int D>
ValueWeight value_weight(const Layout<D>& layout, const Index<D>& cell, std::int64_t row, double weight) {
  return {layout.line_number(cell), cell[0] + row * layout.row_pitch(), weight};
}
/// Returns the cell that a value is of.
template <int D>
Index<D> cell_of_value(const Layout<D>& layout, const ValueWeight& value) {
  auto cell = layout.line_index(value.line);
  cell[0] = layout.column(value.place);
  return cell;
}

/// Numbers of the lines that take part, ascending, each once.
std::vector<std::int64_t> lines_of(const std::vector<ValueWeight>& values);

/// The side of an interface of fluid and solid that counts for a point on it: the solid's for forces,
/// velocities and stresses, the fluid's for pressure and explosions.
enum class Side : std::uint8_t { solid, fluid };

/// Weights of the values of one field row round a point (theory.md (A1)-(A3)), from cells of the same kind
/// (solid or fluid) as the one the point is in: nothing is read across a fluid-solid interface, and across
/// another strong one only where fewer than widest_beyond cells are on this side. Of a velocity beside one of
/// rocks there are values of other fields, too, which take away its errors there (theory.md (A24)). At an
/// edge of the grid the field is extended by the edge law, beside void as at a free edge. Empty for shear
/// stresses that are not stored.
template <int D>
std::vector<ValueWeight> row_weights(const Layout<D>& layout, const Domain<D>& domain,
                                     const Point<D>& point_m, int field_row, Side side = Side::solid);

/// Returns the weights for a source, which adds with them: velocities as they are read but for the errors
/// with which a free surface answers to forces (theory.md (A23)). Stresses of solids that would reach beyond
/// a free surface go to the two nearest cells across it instead, or are extrapolated from them beyond the
/// last centre.
template <int D>
std::vector<ValueWeight> source_weights(const Layout<D>& layout, const Domain<D>& domain,
                                        const Point<D>& point_m, int field_row, Side side = Side::solid);

/// Returns the weights of a source for a stress in a solid, smoothly spread over cells of the rock that the
/// source is in (theory.md (A8), (A8a)). They are empty in fluid, and where that rock is too thin.
template <int D>
std::vector<ValueWeight> smooth_source_weights(const Layout<D>& layout, const Domain<D>& domain,
                                               const Point<D>& point_m, int field_row, Side side,
                                               Moment moment);

/// What ends the cells that are read: another kind of cell (solid, fluid, void), or strong interfaces, too.
enum class Reach { over_one_kind, to_strong_interfaces };
/// The cells round a cell that may be read along each axis, the extension of a field row beyond those at an
/// edge of the grid or a free surface, and whether they end at a free surface on either side (0 low, 1 high).
template <int D>
struct ExtendedCells {
  std::array<AxisCells, std::size_t(D)> cells;
  std::array<std::array<bool, 2>, std::size_t(D)> ends_free{};
};
template <int D>
ExtendedCells<D> extended_cells(const Domain<D>& domain, const Index<D>& centre, int field_row, bool fluid,
                                Reach reach = Reach::over_one_kind);

/// Row of a field of the wave equation.
template <int D>
int row_of(const WaveField& field);

/// The cell of the computed grid a point is in; the high faces of the grid belong to the cells before them,
/// other faces to those behind them, but where fluid and solid or void meet there.
template <int D>
Index<D> cell_at(const Domain<D>& domain, const Point<D>& point_m, Side side = Side::solid);

/// Whether a point is in the cells that a domain owns. On a face between bands it is in those behind, unless
/// only those before it are of its side.
template <int D>
bool owns_point(const Domain<D>& domain, const Point<D>& point_m, Side side = Side::solid);

}  // namespace slipwave::solver
