#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/fracture.hpp"

/// Single fractures (docs/theory.md 2.8): lines in the plane of a 2-D model, which give the cells beside them
/// a share of their compliance.
namespace slipwave {

/// "X,Z:X,Z" in metres. Throws a usage Error.
FractureTrace<2> parse_segment(const std::string& text);

/// Those of a file: "X Z" or "X,Z" a line and vertex; an empty line or one that begins with ">" parts two
/// fractures; # begins a comment. Throws Error naming file and line.
std::vector<FractureTrace<2>> read_fracture_traces(const std::string& path);

/// Of the line between its tips.
Point<2> normal_between_tips(const FractureTrace<2>& trace);

/// Metres from tip to tip, along the trace.
double length_of(const FractureTrace<2>& trace);

/// What single fractures do to a cell.
struct CrossedCell {
  static constexpr std::size_t components = 3;
  std::size_t cell = 0;  // its number in the grid
  /// Components of the strain of the cell for those of its stress (SymmetricTensor), row after row, 1/Pa.
  std::array<double, components * components> strain{};
};

/// The cells that the fractures of a set lie in or beside, ascending: every point of a fracture counts to the
/// nine cells about it, the nearer the more (S30).
std::vector<CrossedCell> cells_crossed(const Grid<2>& grid, const FractureSet<2>& set);

/// Marks the solid cells that the fractures of all sets lie in, as the grid has them now: after cells have
/// changed. In 3-D there are none.
template <int D>
void place_single_fractures(Model<D>& model);

/// Throws a usage Error where a trace has less than two vertices, a piece of no length or a vertex outside
/// the model.
void check_trace(const Grid<2>& grid, const FractureTrace<2>& trace);

/// Adds a set of single fractures and marks the solid cells they lie in; an earlier cluster gives way there,
/// earlier single fractures stay. One on faces marks no cells: its faces are counted. Throws as check_trace()
/// does, and an Error where none crosses rock.
FractureCount add_single_fractures(Model<2>& model, const FractureSet<2>& set);

}  // namespace slipwave
