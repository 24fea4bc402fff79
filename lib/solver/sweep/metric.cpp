// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/metric.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {

/// This table holds the depths of the corners of the computed grid, in cells: corner_depth() of each, found
/// once.
template <int D>
class CornerDepths {
 public:
  explicit CornerDepths(const Domain<D>& domain) {
    for (int axis = 0; axis < D; ++axis) corners_.shape[axis] = domain.grid.shape[axis] + 1;
    depths_.resize(std::size_t(corners_.size()));
    parallel_for(corners_.size(), 1024, [&](std::int64_t begin, std::int64_t end, int) {
      for (auto n = begin; n < end; ++n) depths_[std::size_t(n)] = corner_depth(domain, corners_.index(n));
    });
  }
  /// What they gain from a corner to the next along an axis, of a corner and of the next along another.
  double gain(const Index<D>& corner, int axis, int other) const {
    const auto place = std::size_t(corners_.flat(corner)), next = stride(axis),
               beside = place + stride(other);
    return (depths_[place + next] - depths_[place]) + (depths_[beside + next] - depths_[beside]);
  }
  double gain(const Index<D>& corner, int axis) const {
    const auto place = std::size_t(corners_.flat(corner));
    return depths_[place + stride(axis)] - depths_[place];
  }

 private:
  std::size_t stride(int axis) const {
    std::int64_t corners = 1;
    for (int n = 0; n < axis; ++n) corners *= corners_.shape[n];
    return std::size_t(corners);
  }
  Grid<D> corners_;
  std::vector<double> depths_;
};

namespace {

/// What the depth of corners gains from a cell's first corners to the next along `step`, the mean along the
/// horizontal axis other than `axis`.
template <int D>
double mean_gain(const CornerDepths<D>& depth, const Index<D>& cell, int axis, int step) {
  return D == 3 ? depth.gain(cell, step, 1 - axis) / 2 : depth.gain(cell, step);
}

/// Returns the slope of the upper face of a cell along a horizontal axis: dz/dx or dz/dy.
template <int D>
double slope_of_face(const CornerDepths<D>& depth, const Index<D>& cell, int axis) {
  return mean_gain(depth, cell, axis, axis);
}

/// Height in cells of the face before a cell along a horizontal axis.
template <int D>
double height_of_face(const CornerDepths<D>& depth, const Index<D>& cell, int axis) {
  return mean_gain(depth, cell, axis, D - 1);
}

}  // namespace

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

/// Half of what belongs to the face before a cell along an axis, or to that behind the last one.
template <int D, class Real>
void Metric<D, Real>::put_face(const CornerDepths<D>& depth, const Index<D>& at, int axis) {
  if (axis < D - 1) return put(at, row_face + axis, height_of_face(depth, at, axis) / 2);
  double square = 1;
  for (int other = 0; other < D - 1; ++other) {
    const double slope = slope_of_face(depth, at, other);
    square += slope * slope;
    put(at, row_n_face + other, -slope / 2);
  }
  put(at, row_over_face, 1 / std::sqrt(square));
}

template <int D, class Real>
void Metric<D, Real>::fill(const Domain<D>& domain) {
  const CornerDepths<D> depth(domain);
  // Padding and ghosts hold a regular grid.
  std::fill(values_.data(), values_.data() + values_.size(), Real(1));
  parallel_for(lines_a_row_ * cells_[D - 1], 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      Index<D> at = layout_.line_index(line);
      for (at[0] = 0; at[0] < cells_[0]; ++at[0]) {
        const auto beyond = [&](int axis) {
          Index<D> next = at;
          ++next[axis];
          return next;
        };
        for (int axis = 0; axis < D; ++axis) {
          put_face(depth, at, axis);
          if (at[axis] + 1 == cells_[axis]) put_face(depth, beyond(axis), axis);
        }
        const double j = (height_of_face(depth, at, 0) + height_of_face(depth, beyond(0), 0)) / 2;
        double square = 1;  // of |N|
        for (int axis = 0; axis < D - 1; ++axis) {
          const double slope =
              (slope_of_face(depth, at, axis) + slope_of_face(depth, beyond(D - 1), axis)) / 2;
          square += slope * slope;
        }
        put(at, row_over_j, 1 / j);
        put(at, row_stretch, std::sqrt(square) / j);
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
