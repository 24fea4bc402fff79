// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "scene/bands.hpp"
#include "solver/sweep/band_columns.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// What two bands of cells exchange at the level face between them (theory.md (B4)): their grids have columns
/// of two widths, and each holds rows of the other beyond the face, in columns of its own.
template <int D, class Real>
class BandFace {
 public:
  /// A grid beside the face, and its states there.
  struct Side {
    State<D, Real>* state;
    SharedFaces<Real>* shared;
  };
  /// Rows of a grid beside the face that the other grid is filled from.
  static constexpr int most_rows_read = (max_reach + 1) * widest_step_in_rock;
  /// `reach` of the reconstruction; `own_heights`: rows of a grid beyond the face are as high as its own.
  /// Keeps references.
  BandFace(const Side& above, const Side& below, const EdgeLaws<D>& edges, int reach, bool own_heights);
  /// Before a sweep along the last axis: fills the rows beyond the face that each grid reads.
  void fill_rows();
  /// Once the grid with the narrower columns is swept: gives its states of the face to the other.
  void give_states();
  bool is_narrow(const State<D, Real>& state) const { return narrow().state == &state; }

 private:
  static const Index<D>& shape(const Side& side) { return side.state->layout.shape(); }
  const Side& narrow() const { return narrows_up_ ? above_ : below_; }
  const Side& wide() const { return narrows_up_ ? below_ : above_; }
  /// All lines of a row, one after the other, in columns of the other width, as parts of a field row.
  void interpolate(bool narrows, int field_row, std::vector<Real>& values);
  /// A row of a grid and its weight in a sum.
  using Row = std::pair<std::int64_t, Real>;
  /// A sum of rows of all fields of one grid as row `row` of the other.
  void fill(const Side& from, const std::vector<Row>& sum, const Side& to, std::int64_t row);
  void fill_as_high();

  Side above_, below_;
  bool narrows_up_, own_heights_;
  int reach_;
  EdgeLaws<D> edges_;
  std::vector<BandColumns<Real>> columns_;  // by horizontal axis
  std::vector<Real> lines_, values_;
};

}  // namespace slipwave::solver
