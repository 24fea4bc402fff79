// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "grid/tensor.hpp"
#include "model/fracture.hpp"

/// Single fractures (docs/theory/fractures.md): lines in the plane of a 2-D model, plane polygons in a 3-D
/// one, which give the cells beside them a share of their compliance.
namespace slipwave {

/// "X,Z:X,Z" in metres. Throws a usage Error.
FractureTrace<2> parse_segment(const std::string& text);

/// Returns the traces of a file: "X Z" or "X,Z" a line and vertex, in 3-D "X Y Z"; an empty line or one that
/// begins with ">" parts two fractures; # begins a comment. Throws Error naming file and line.
template <int D>
std::vector<FractureTrace<D>> read_fracture_traces(const std::string& path);

/// Returns the unit normal of the line between its tips; of a closed trace that of its first piece.
Point<2> normal_between_tips(const FractureTrace<2>& trace);

/// Metres from tip to tip, along the trace.
double length_of(const FractureTrace<2>& trace);

/// How much of fractures lies on others or, of a trace that goes back, on itself, where it has the compliance
/// of both: m; in 3-D m2 of polygons that stand there twice.
double doubled_size(const std::vector<FractureTrace<2>>& traces);
double doubled_size(const std::vector<FractureTrace<3>>& polygons);

/// What single fractures do to a cell.
template <int D>
struct CrossedCell {
  static constexpr auto components = std::size_t(SymmetricTensor<D, double>::components);
  std::size_t cell = 0;  // its number in the grid
  /// Components of the strain of the cell for those of its stress (SymmetricTensor), row after row, 1/Pa.
  std::array<double, components * components> strain{};
};

/// The cells that the fractures of a set lie in or beside, ascending: every point of a fracture counts to the
/// nine cells about it, in 3-D the 27, the nearer the more (S30).
template <int D>
std::vector<CrossedCell<D>> cells_crossed(const Grid<D>& grid, const FractureSet<D>& set);

/// Marks the solid cells that the fractures of all sets lie in, as the grid has them now: after cells have
/// changed.
template <int D>
void place_single_fractures(Model<D>& model);

/// Throws a usage Error where a trace has less than two vertices, a piece of no length or a vertex outside
/// the model.
void check_trace(const Grid<2>& grid, const FractureTrace<2>& trace);
/// Checks a polygon (planar_fracture.hpp) as check_trace() does a trace; in a fitted grid it is held against
/// the box of the model.
void check_trace(const Grid<3>& grid, const FractureTrace<3>& polygon);

/// Adds a set of single fractures and marks the solid cells they lie in; an earlier cluster gives way there,
/// earlier single fractures stay. One on faces (2-D) marks no cells: its faces are counted. Throws as
/// check_trace() does, and an Error where none crosses rock.
template <int D>
FractureCount add_single_fractures(Model<D>& model, const FractureSet<D>& set);

}  // namespace slipwave
