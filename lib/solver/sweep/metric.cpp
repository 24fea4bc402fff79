#include "solver/sweep/metric.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/threads.hpp"

namespace slipwave::solver {
namespace {

/// What the depth of corners gains from a cell's first corners to the next along `step`, the mean along the
/// horizontal axis other than `axis`.
template <int D>
double mean_gain(const Domain<D>& domain, const Index<D>& cell, int axis, int step) {
  double gain = 0;
  for (int other = 0; other < D - 1; ++other) {
    Index<D> from = cell;
    if (D == 3) from[1 - axis] += other;
    Index<D> to = from;
    ++to[step];
    gain += corner_depth(domain, to) - corner_depth(domain, from);
  }
  return gain / (D - 1);
}

/// Of the upper face of a cell along a horizontal axis: dz/dx or dz/dy.
template <int D>
double slope_of_face(const Domain<D>& domain, const Index<D>& cell, int axis) {
  return mean_gain(domain, cell, axis, axis);
}

/// Height in cells of the face before a cell along a horizontal axis.
template <int D>
double height_of_face(const Domain<D>& domain, const Index<D>& cell, int axis) {
  return mean_gain(domain, cell, axis, D - 1);
}

}  // namespace

template <int D, class Real>
Metric<D, Real>::Metric(const Domain<D>& domain) : bent_(domain.bent_rows) {
  for (const double height : domain.row_heights) inverse_heights_.push_back(Real(1 / height));
  if (bent_.empty()) return;
  layout_ = Layout<D>(domain.grid.shape, rows);
  lines_a_row_ = layout_.lines() / domain.grid.shape[D - 1];
  values_ = Buffer<Real>(layout_.total());
  find_fluid(domain);
  fill(domain);
  fill_ghosts(domain);
}

template <int D, class Real>
void Metric<D, Real>::find_fluid(const Domain<D>& domain) {
  const auto &z_p = domain.impedance(wave_p), &z_s = domain.impedance(wave_s);
  const std::int64_t nx = layout_.shape()[0];
  for (std::int64_t cell = 0; cell < domain.grid.size(); ++cell) {
    if (cell % nx == 0) fluid_.push_back(0);
    if (z_p[std::size_t(cell)] > 0 && z_s[std::size_t(cell)] == 0) fluid_.back() = 1;
  }
}

template <int D, class Real>
void Metric<D, Real>::fill(const Domain<D>& domain) {
  // Padding and ghosts hold a regular grid.
  std::fill(values_.data(), values_.data() + values_.size(), Real(1));
  parallel_for(layout_.lines(), 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      Index<D> at = layout_.line_index(line);
      for (at[0] = 0; at[0] < layout_.shape()[0]; ++at[0]) {
        const auto beyond = [&](int axis) {
          Index<D> next = at;
          ++next[axis];
          return next;
        };
        const double j = (height_of_face(domain, at, 0) + height_of_face(domain, beyond(0), 0)) / 2;
        double of_face = 1, of_cell = 1;  // |N| squared
        for (int axis = 0; axis < D - 1; ++axis) {
          const double upper = slope_of_face(domain, at, axis);
          const double own = (upper + slope_of_face(domain, beyond(D - 1), axis)) / 2;
          of_face += upper * upper, of_cell += own * own;
          put(at, row_face + axis, height_of_face(domain, at, axis));
          put(at, row_n_face + axis, -upper);
          put(at, row_n_cell + axis, -own);
        }
        put(at, row_j, j);
        put(at, row_over_j, 1 / j);
        put(at, row_stretch, std::sqrt(of_cell) / j);
        put(at, row_over_face, 1 / std::sqrt(of_face));
      }
    }
  });
}

template <int D, class Real>
void Metric<D, Real>::fill_ghosts(const Domain<D>& domain) {
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1})
      for (std::int64_t line = 0; line < layout_.lines(); ++line) {
        Index<D> at = layout_.line_index(line);
        const std::int64_t edge = side ? layout_.shape()[axis] - 1 : 0;
        if (axis > 0 && at[axis] != edge) continue;
        // Along x one cell, on other axes all cells of the line.
        const std::int64_t first = axis == 0 ? edge : 0, last = axis == 0 ? edge + 1 : layout_.shape()[0];
        for (at[0] = first; at[0] < last; ++at[0]) fill_ghosts_beyond(domain, at, axis, side);
      }
}

/// Beyond one cell of an edge: J as mirrored, N as what tractions there are mirrored with. The high face of
/// the last cell belongs to the first ghost.
template <int D, class Real>
void Metric<D, Real>::fill_ghosts_beyond(const Domain<D>& domain, const Index<D>& at, int axis, int side) {
  const EdgeLaw law = domain.edges[axis][side];
  const Real sign = axis == D - 1 && law == EdgeLaw::mirror ? Real(-1) : Real(1);
  const std::int64_t cells = layout_.shape()[axis];
  for (std::int64_t j = 0; j < max_reach; ++j) {
    Index<D> from = at, ghost = at;
    const std::int64_t image = law == EdgeLaw::absorbing ? 0 : std::min(j, cells - 1);
    from[axis] = side ? cells - 1 - image : image;
    ghost[axis] = side ? cells + j : -1 - j;
    for (int of = 0; of < rows; ++of)
      *place(ghost, of) = (of >= row_n_face && of < row_over_j ? sign : Real(1)) * *place(from, of);
  }
  if (!side) return;
  Index<D> beyond = at;
  ++beyond[axis];
  if (axis < D - 1) return put(beyond, row_face + axis, height_of_face(domain, beyond, axis));
  double of_face = 1;
  for (int other = 0; other < D - 1; ++other) {
    const double slope = slope_of_face(domain, beyond, other);
    of_face += slope * slope;
    put(beyond, row_n_face + other, -slope);
  }
  put(beyond, row_over_face, 1 / std::sqrt(of_face));
}

template <int D, class Real>
BentAlong<Real> Metric<D, Real>::along(int axis, const Index<D>& line, std::int64_t x) const {
  const Real* const face = row(line, row_face + axis) + x;
  const std::int64_t stride = layout_.stride(axis);
  return {row(line, row_j) + x, face, face + stride, stride, row(line, row_over_j) + x};
}

template <int D, class Real>
BentAcross<Real> Metric<D, Real>::across(const Index<D>& line, std::int64_t x) const {
  return {row(line, row_j) + x,      row(line, row_n_cell) + x,   row(line, row_n_face) + x,
          layout_.row_pitch(),       layout_.stride(D - 1),       row(line, row_stretch) + x,
          row(line, row_over_j) + x, row(line, row_over_face) + x};
}

template <int D, class Real>
Real Metric<D, Real>::volume(const Index<D>& at) const {
  if (!bent_row(at[D - 1])) return 1 / inverse_height(at[D - 1]);
  Index<D> line = at;
  line[0] = 0;
  return row(line, row_j)[at[0]];
}

template class Metric<2, float>;
template class Metric<2, double>;
template class Metric<3, float>;
template class Metric<3, double>;

}  // namespace slipwave::solver
