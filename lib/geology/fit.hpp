// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// Which horizons rows shall follow.
struct FitChoice {
  bool surfaces = true;  // of solid or fluid against void
  bool floors = true;    // of fluid against solid
  bool layers = true;    // of solid against solid, fluid against fluid
  /// Given by the user: a surface or floor that cannot be followed is an error then, not a remark.
  bool asked = false;
  /// A fitted grid even where all horizons lie on faces.
  bool always = false;
};

/// "surface,floor", "all" or "none". Throws a usage Error.
FitChoice parse_fit(std::string_view text);

/// A horizon that rows of a grid may follow.
struct FitHorizon {
  std::string name;     // in files, of letters, digits and _, all different
  std::string shown;    // as messages name it: "floor at 400 m"
  std::string role;     // "surface", "floor" or "layer"
  bool strong = true;   // of solid, fluid and void: followed first, with rows down to a fifth of a cell
  bool is_top = false;  // nothing but void above: if followed, it becomes the top of the grid
  std::vector<double> depths_m;  // at the corners of all columns, x fastest (corner_columns())
  /// So many rows a cell may what is right above it have, and the time step is that of regular rows: how much
  /// slower its fastest wave is than that of the model.
  double rows_a_cell_above = 1;
};

/// A grid and what it follows.
template <int D>
struct Fit {
  Grid<D> grid;                       // the regular one where it follows nothing
  std::vector<std::int64_t> rows;     // of each horizon that was given: its row of corners, -1: not followed
  std::vector<std::string> left_out;  // a sentence for each horizon that cannot be followed, with its place
  std::string summary;                // "fitted: floor at 400 m, rows 0.82 to 1.21 of 5 m"; "" without
};

/// Corners of columns of a grid as points whose last coordinate is 0, x fastest, in m: one more than cells
/// along x [and y].
template <int D>
std::vector<Point<D>> corner_columns(const Grid<D>& grid);

/// Lets rows of a regular grid follow horizons, given from the top down (theory.md, fitted grids): depth is
/// z = zeta + sum_k s_k(x) W_k(zeta), with s_k how far horizon k lies from its row and W_k 1 there. Above and
/// below it W_k falls to 0 over as many rows as keep their heights between 0.85 and 1.15 of a cell, or 0.75
/// and 1.25, so that rows farther away stay regular; where the next horizon or the bottom is too near for
/// that, and between level horizons, rows of a column are of one height. A layer has as many rows as its mean
/// thickness in cells says, more where it would be thicker than 1.6 cells a row, and three at least, or as
/// many as may be that thin: between two interfaces fewer rows leave the reconstruction a low order. Between
/// horizons it has up to eight if they cost no time step (`rows_a_cell_above`). What
/// crosses others, leaves the model, or would have rows thinner than a fifth of a cell (a third, where it is
/// not strong) is left out and said, or is an Error where `choice.asked` and it is strong. Horizons on faces
/// are followed with others, chosen or not: rows that bend would leave them. Where all lie on faces of the
/// regular grid, that is kept, but for `choice.always`.
template <int D>
Fit<D> fit_grid(const Grid<D>& regular, const std::vector<FitHorizon>& horizons, const FitChoice& choice);

}  // namespace slipwave
