#include "solver/sweep/metric.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/threads.hpp"

namespace slipwave::solver {

template <int D, class Real>
Metric<D, Real>::Metric(const Domain<D>& domain) : bent_(domain.bent_rows) {
  for (const double height : domain.row_heights) inverse_heights_.push_back(Real(1 / height));
  if (bent_.empty()) return;
  layout_ = Layout<D>(domain.grid.shape, rows);
  lines_a_row_ = layout_.lines() / domain.grid.shape[D - 1];
  values_ = Buffer<Real>(layout_.total());
  fill(domain);
  fill_ghosts(domain);
}

template <int D, class Real>
void Metric<D, Real>::fill(const Domain<D>& domain) {
  // Padding and ghosts hold a regular grid.
  std::fill(values_.data(), values_.data() + values_.size(), Real(1));
  const auto corner = [&](const Index<D>& at) { return corner_depth(domain, at); };
  const auto& shape = layout_.shape();
  constexpr int corners = 1 << D, z = 1 << (D - 1);
  parallel_for(layout_.lines(), 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      Index<D> at = layout_.line_index(line);
      Real* const first = values_.data() + layout_.line(at);
      const auto put = [&](int row, std::int64_t x, double value) {
        first[row * layout_.row_pitch() + x] = Real(value);
      };
      // One more along x: its low face is the high face of the last cell.
      for (std::int64_t x = 0; x <= shape[0]; ++x) {
        std::array<double, std::size_t(corners)> depth{};
        for (int n = 0; n < corners; ++n) {
          Index<D> of = at;
          of[0] = x;
          for (int axis = 0; axis < D; ++axis) of[axis] += (n >> axis) & 1;
          depth[std::size_t(n)] = corner(of);
        }
        double j = 0;
        for (int n = 0; n < z; ++n) j += depth[std::size_t(n + z)] - depth[std::size_t(n)];
        if (x < shape[0]) put(row_j, x, j / z);
        for (int axis = 0; axis < D - 1; ++axis) {
          double of_face = 0, upper = 0, lower = 0;
          for (int n = 0; n < z; ++n) {
            const bool high = (n >> axis) & 1;
            if (!high) of_face += depth[std::size_t(n + z)] - depth[std::size_t(n)];
            upper -= (high ? 1 : -1) * depth[std::size_t(n)];
            lower -= (high ? 1 : -1) * depth[std::size_t(n + z)];
          }
          constexpr double faces = z / 2;
          put(row_face + axis, x, of_face / faces);
          if (x == shape[0]) continue;
          put(row_n_face + axis, x, upper / faces);
          put(row_n_cell + axis, x, (upper + lower) / (2 * faces));
        }
      }
    }
  });
}

/// Ghost rows and cells beyond the edges: J as mirrored, N as what tractions there are mirrored with.
template <int D, class Real>
void Metric<D, Real>::fill_ghosts(const Domain<D>& domain) {
  const auto& shape = layout_.shape();
  const std::int64_t pitch = layout_.row_pitch(), nx = shape[0];
  const auto image = [](std::int64_t j, std::int64_t cells, bool constant) {
    return constant ? 0 : std::min(j, cells - 1);
  };
  for (std::int64_t line = 0; line < layout_.lines(); ++line) {
    Real* const j_row = values_.data() + layout_.line(layout_.line_index(line));
    for (const int side : {0, 1})
      for (std::int64_t j = 0; j < max_reach; ++j) {
        const auto from = image(j, nx, domain.edges[0][side] == EdgeLaw::absorbing);
        j_row[side ? nx + j : -1 - j] = j_row[side ? nx - 1 - from : from];
      }
  }
  for (int axis = 1; axis < D; ++axis)
    for (std::int64_t line = 0; line < layout_.lines(); ++line) {
      const auto at = layout_.line_index(line);
      const std::int64_t count = shape[axis];
      for (const int side : {0, 1}) {
        if (at[axis] != (side ? count - 1 : 0)) continue;
        const EdgeLaw law = domain.edges[axis][side];
        // The corners beyond the last row belong to its lower face.
        Index<D> beyond = at;
        for (std::int64_t j = 0; j < max_reach; ++j) {
          Index<D> from = at;
          const auto of = image(j, count, law == EdgeLaw::absorbing);
          from[axis] = side ? count - 1 - of : of;
          beyond[axis] = side ? count + j : -1 - j;
          const Real* const source = values_.data() + layout_.line(from);
          Real* const to = values_.data() + layout_.line(beyond);
          const bool first_beyond = side && j == 0;
          for (int row = 0; row < rows; ++row) {
            // Faces before the first ghost row are faces of the grid.
            const bool faces = axis == D - 1 ? row >= row_n_face && row < row_n_cell : row == row_face + axis;
            if (faces && first_beyond) continue;
            const Real sign =
                axis == D - 1 && row >= row_n_face && law == EdgeLaw::mirror ? Real(-1) : Real(1);
            for (std::int64_t x = -max_reach; x < nx + max_reach; ++x)
              to[row * pitch + x] = sign * source[row * pitch + x];
          }
        }
      }
    }
  // N of the lower face of the last row, J of the high faces along y of the last row.
  const auto corner = [&](const Index<D>& at) { return corner_depth(domain, at); };
  for (int axis = 1; axis < D; ++axis)
    for (std::int64_t line = 0; line < layout_.lines(); ++line) {
      auto at = layout_.line_index(line);
      if (at[axis] != shape[axis] - 1) continue;
      ++at[axis];
      Real* const to = values_.data() + layout_.line(at);
      for (std::int64_t x = 0; x < nx; ++x) {
        const auto depth = [&](int dx, int dy, int dz) {
          Index<D> of = at;
          of[0] = x + dx;
          if (D == 3) of[1] += dy;
          of[D - 1] += dz;
          return corner(of);
        };
        if (axis == D - 1) {
          constexpr int others = D == 3 ? 1 : 0;
          double slope_x = 0, slope_y = 0;
          for (int other = 0; other <= others; ++other) {
            slope_x += (depth(1, other, 0) - depth(0, other, 0)) / (others + 1);
            if (D == 3) slope_y += (depth(other, 1, 0) - depth(other, 0, 0)) / (others + 1);
          }
          to[row_n_face * pitch + x] = Real(-slope_x);
          if (D == 3) to[(row_n_face + 1) * pitch + x] = Real(-slope_y);
        } else {
          double j = 0;
          for (const int dx : {0, 1}) j += (depth(dx, 0, 1) - depth(dx, 0, 0)) / 2;
          to[(row_face + axis) * pitch + x] = Real(j);
        }
      }
    }
}

template <int D, class Real>
BentAlong<Real> Metric<D, Real>::along(int axis, const Index<D>& line, std::int64_t x) const {
  const Real* const face = row(line, row_face + axis) + x;
  const std::int64_t stride = layout_.stride(axis);
  return {row(line, row_j) + x, face, face + stride, stride};
}

template <int D, class Real>
BentAcross<Real> Metric<D, Real>::across(const Index<D>& line, std::int64_t x) const {
  return {row(line, row_j) + x, row(line, row_n_cell) + x, row(line, row_n_face) + x, layout_.row_pitch(),
          layout_.stride(D - 1)};
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
