// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

template <int D>
class CornerDepths;

/// The metric of a fitted grid on the computed grid (theory.md (F1)): of curvilinear rows J and N by cell and
/// face; of level rows their height, by which the sweep along z over them is shorter or longer. Empty, and
/// never asked, where the grid is regular.
template <int D, class Real>
class Metric {
 public:
  Metric() = default;
  explicit Metric(const Domain<D>& domain);

  bool any_curvilinear() const { return !curvilinear_.empty(); }
  std::int64_t memory_bytes() const {
    return values_.size() * std::int64_t(sizeof(Real)) + bytes_of(curvilinear_) + bytes_of(inverse_heights_) +
           bytes_of(fluid_);
  }
  /// Whether a row (in 3-D a plane of rows), counted along z, or any that its stencils read is not level.
  bool curvilinear_row(std::int64_t row) const {
    return !curvilinear_.empty() && curvilinear_[std::size_t(row)];
  }
  bool curvilinear(std::int64_t line) const {
    return !curvilinear_.empty() && curvilinear_[std::size_t(line / lines_a_row_)];
  }
  /// h over the height of a level row; 1 for curvilinear ones.
  Real inverse_height(std::int64_t row) const {
    return inverse_heights_.empty() ? Real(1) : inverse_heights_[std::size_t(row)];
  }

  /// Whether there are fluid cells on either side of the face before a line, across the rows.
  bool fluid_at_face(std::int64_t line) const { return fluid(line) || fluid(line - lines_a_row_); }
  /// These return the metric of a curvilinear row, from cell x on: for sweeps along the row and for those
  /// across the rows.
  CurvilinearAlong<Real> along(int axis, const Index<D>& line, std::int64_t x) const;
  CurvilinearAcross<Real> across(const Index<D>& line, std::int64_t x) const;
  /// All rows of the metric of a line.
  static constexpr int rows_of_line = 2 * D + 1;
  const Real* first_row(const Index<D>& line) const { return row(line, 0); }
  std::int64_t row_pitch() const { return layout_.row_pitch(); }
  /// J of a cell.
  Real volume(const Index<D>& at) const;

 private:
  // Rows of a line: half of J of the face before the cell along each horizontal axis and half of N of the
  // upper face; then 1/J, |N|/J, 1/|N| of the upper face. The row behind the last one, a line more than the
  // grid has, holds the lower faces of that one.
  static constexpr int row_face = 0, row_n_face = D - 1, row_over_j = 2 * D - 2, row_stretch = row_over_j + 1,
                       row_over_face = row_stretch + 1;
  const Real* row(const Index<D>& line, int of) const {
    return values_.data() + layout_.line(line) + of * layout_.row_pitch();
  }
  bool fluid(std::int64_t line) const {
    return line >= 0 && line < std::int64_t(fluid_.size()) && fluid_[std::size_t(line)];
  }
  void find_fluid(const Domain<D>& domain);
  void fill(const Domain<D>& domain);
  void fill_ghosts(const Domain<D>& domain);
  void fill_ghosts_beyond(const Domain<D>& domain, const Index<D>& at, int axis, int side);
  void put_faces(const CornerDepths<D>& depth, const Index<D>& at, int axis, std::int64_t count);
  Real* place(const Index<D>& at, int of) {
    return values_.data() + layout_.cell(at) + of * layout_.row_pitch();
  }

  Index<D> cells_{};  // of the grid
  std::int64_t lines_a_row_ = 1;
  std::vector<char> curvilinear_;      // by row
  std::vector<Real> inverse_heights_;  // by row
  std::vector<char> fluid_;            // by line: whether it holds fluid cells
  Layout<D> layout_;
  Buffer<Real> values_;
};

}  // namespace slipwave::solver
