// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/metric.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {

/// This table holds the depths of the corners of the computed grid, in cells, by place.
template <int D>
class CornerDepths {
 public:
  explicit CornerDepths(const Domain<D>& domain) : depths_(corner_depths(domain)) {
    for (int axis = 0; axis < D; ++axis) corners_.shape[axis] = domain.grid.shape[axis] + 1;
    for (std::size_t axis = 1; axis < D; ++axis)
      strides_[axis] = strides_[axis - 1] * std::size_t(corners_.shape[axis - 1]);
  }
  /// Returns the place of a cell's first corner; corners along x follow each other.
  std::size_t place(const Index<D>& cell) const { return std::size_t(corners_.flat(cell)); }
  /// What the depth gains from a cell's first corners to the next along `step`, the mean along the horizontal
  /// axis other than `axis`.
  double mean_gain(std::size_t place, std::size_t axis, std::size_t step) const {
    if (D == 2) return gain(place, step);
    return (gain(place, step) + gain(place + strides_[1 - axis], step)) / 2;
  }
  /// Returns the slope of the upper face of a cell along a horizontal axis: dz/dx or dz/dy.
  double slope_of_face(std::size_t place, std::size_t axis) const { return mean_gain(place, axis, axis); }
  /// Height in cells of the face before a cell along a horizontal axis.
  double height_of_face(std::size_t place, std::size_t axis) const { return mean_gain(place, axis, D - 1); }
  std::size_t row_below(std::size_t place) const { return place + strides_[D - 1]; }

 private:
  double gain(std::size_t place, std::size_t axis) const {
    return depths_[place + strides_[axis]] - depths_[place];
  }
  Grid<D> corners_;
  std::array<std::size_t, std::size_t(D)> strides_{1};
  std::vector<double> depths_;
};

template <int D, class Real>
Metric<D, Real>::Metric(const Domain<D>& domain) : curvilinear_(domain.curvilinear_rows) {
  for (const double height : domain.row_heights) inverse_heights_.push_back(Real(1 / height));
  if (curvilinear_.empty()) return;
  cells_ = domain.grid.shape;
  auto with_last_faces = cells_;
  ++with_last_faces[D - 1];
  layout_ = Layout<D>(with_last_faces, rows_of_line);
  lines_a_row_ = layout_.lines() / with_last_faces[D - 1];
  values_ = Buffer<Real>(layout_.total());
  find_fluid(domain);
  fill(domain);
  fill_ghosts(domain);
}

template <int D, class Real>
void Metric<D, Real>::find_fluid(const Domain<D>& domain) {
  const auto &z_p = domain.impedance(wave_p), &z_s = domain.impedance(wave_s);
  const std::int64_t nx = cells_[0];
  for (std::int64_t cell = 0; cell < domain.grid.size(); ++cell) {
    if (cell % nx == 0) fluid_.push_back(0);
    if (z_p[std::size_t(cell)] > 0 && z_s[std::size_t(cell)] == 0) fluid_.back() = 1;
  }
}

/// Half of what belongs to the faces before some cells of a line along an axis, from `at` on.
template <int D, class Real>
void Metric<D, Real>::put_faces(const CornerDepths<D>& depth, const Index<D>& at, int axis,
                                std::int64_t count) {
  const auto first = depth.place(at), cells = std::size_t(count);
  if (axis < D - 1) {
    Real* const face = place(at, row_face + axis);
    for (std::size_t x = 0; x < cells; ++x)
      face[x] = Real(depth.height_of_face(first + x, std::size_t(axis)) / 2);
    return;
  }
  Real* const over_face = place(at, row_over_face);
  for (std::size_t x = 0; x < cells; ++x) {
    double square = 1;
    for (std::size_t other = 0; other < D - 1; ++other) {
      const double slope = depth.slope_of_face(first + x, other);
      square += slope * slope;
      place(at, row_n_face + int(other))[x] = Real(-slope / 2);
    }
    over_face[x] = Real(1 / std::sqrt(square));
  }
}

template <int D, class Real>
void Metric<D, Real>::fill(const Domain<D>& domain) {
  const CornerDepths<D> depth(domain);
  // Padding and ghosts hold a regular grid.
  std::fill(values_.data(), values_.data() + values_.size(), Real(1));
  parallel_for(lines_a_row_ * cells_[D - 1], 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      const Index<D> at = layout_.line_index(line);
      for (int axis = 0; axis < D; ++axis) {
        put_faces(depth, at, axis, axis == 0 ? cells_[0] + 1 : cells_[0]);
        Index<D> last = at;
        if (axis > 0 && ++last[axis] == cells_[axis]) put_faces(depth, last, axis, cells_[0]);
      }
      const auto first = depth.place(at);
      Real *const over_j = place(at, row_over_j), *const stretch = place(at, row_stretch);
      for (std::size_t x = 0; x < std::size_t(cells_[0]); ++x) {
        const auto upper = first + x, lower = depth.row_below(upper);
        const double j = (depth.height_of_face(upper, 0) + depth.height_of_face(upper + 1, 0)) / 2;
        double square = 1;  // of |N|
        for (std::size_t axis = 0; axis < D - 1; ++axis) {
          const double slope = (depth.slope_of_face(upper, axis) + depth.slope_of_face(lower, axis)) / 2;
          square += slope * slope;
        }
        over_j[x] = Real(1 / j);
        stretch[x] = Real(std::sqrt(square) / j);
      }
    }
  });
}

template <int D, class Real>
void Metric<D, Real>::fill_ghosts(const Domain<D>& domain) {
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1})
      for (std::int64_t line = 0; line < lines_a_row_ * cells_[D - 1]; ++line) {
        Index<D> at = layout_.line_index(line);
        const std::int64_t edge = side ? cells_[axis] - 1 : 0;
        if (axis > 0 && at[axis] != edge) continue;
        // Along x one cell, on other axes all cells of the line and the face behind the last.
        const std::int64_t first = axis == 0 ? edge : 0, last = axis == 0 ? edge : cells_[0];
        for (at[0] = first; at[0] <= last; ++at[0]) fill_ghosts_beyond(domain, at, axis, side);
      }
}

/// Beyond one cell of an edge: J as mirrored, N as what tractions there are mirrored with. Those of cells are
/// of two faces, so a face across the axis is what the cell leaves of the face before.
template <int D, class Real>
void Metric<D, Real>::fill_ghosts_beyond(const Domain<D>& domain, const Index<D>& at, int axis, int side) {
  const EdgeLaw law = domain.edges[axis][side];
  const Real sign = axis == D - 1 && law == EdgeLaw::mirror ? Real(-1) : Real(1);
  const std::int64_t cells = cells_[axis];
  for (std::int64_t j = 0; j < max_reach; ++j) {
    Index<D> from = at, ghost = at;
    const std::int64_t image = law == EdgeLaw::absorbing ? 0 : std::min(j, cells - 1);
    from[axis] = side ? cells - 1 - image : image;
    ghost[axis] = side ? cells + j : -1 - j;
    for (int of = 0; of < rows_of_line; ++of) {
      const bool of_normal = of >= row_n_face && of < row_over_j;
      const bool across = axis == D - 1 ? of_normal : of == row_face + axis;
      if (!across) {
        const bool last_face = side && j == 0 && axis == D - 1 && of == row_over_face;
        if (!last_face) *place(ghost, of) = (of_normal ? sign : Real(1)) * *place(from, of);
        continue;
      }
      Index<D> behind = from, known = ghost, wanted = ghost;
      ++behind[axis];
      (side ? wanted : known)[axis] += 1;
      *place(wanted, of) = sign * (*place(from, of) + *place(behind, of)) - *place(known, of);
    }
  }
}

template <int D, class Real>
CurvilinearAlong<Real> Metric<D, Real>::along(int axis, const Index<D>& line, std::int64_t x) const {
  const Real* const face = row(line, row_face + axis) + x;
  const std::int64_t stride = layout_.stride(axis);
  return {row(line, row_face) + x, face, face + stride, stride, row(line, row_over_j) + x};
}

template <int D, class Real>
CurvilinearAcross<Real> Metric<D, Real>::across(const Index<D>& line, std::int64_t x) const {
  return {row(line, row_n_face) + x,  layout_.row_pitch(),       layout_.stride(D - 1),
          row(line, row_stretch) + x, row(line, row_over_j) + x, row(line, row_over_face) + x};
}

template <int D, class Real>
Real Metric<D, Real>::volume(const Index<D>& at) const {
  if (!curvilinear_row(at[D - 1])) return 1 / inverse_height(at[D - 1]);
  Index<D> line = at;
  line[0] = 0;
  const Real* const half = row(line, row_face) + at[0];
  return half[0] + half[1];
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Metric);

}  // namespace slipwave::solver
