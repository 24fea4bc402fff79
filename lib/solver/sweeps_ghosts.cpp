#include <algorithm>

#include "solver/sweeps.hpp"

// What stencils read beyond the edges of the grid (theory.md (E11)).
namespace slipwave::solver {
namespace {

/// Signs of the mirror image of a pair.
template <class Real>
struct Mirror {
  Real v, s;
  bool level;
  explicit Mirror(Continuation law)
      : v(law == Continuation::motionless ? -1 : 1),
        s(law == Continuation::traction_free ? -1 : 1),
        level(law == Continuation::level) {}
  /// The cell, counted from the edge, that stands for ghost j.
  std::int64_t image(std::int64_t j, std::int64_t cells) const { return level ? 0 : std::min(j, cells - 1); }
};

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::keep_sides(std::int64_t line, const Columns& columns) {
  if (columns.first == 0 && !free_edges_[0][0].empty()) free_edges_[0][0].keep(state_, line);
  if (columns.last == state_.layout.shape()[0] && !free_edges_[0][1].empty())
    free_edges_[0][1].keep(state_, line);
}

template <int D, class Real>
void Sweeps<D, Real>::measure_sides(std::int64_t line) {
  for (auto& edge : free_edges_[0])
    if (!edge.empty()) edge.measure(state_, line, line + 1);
}

template <int D, class Real>
void Sweeps<D, Real>::measure_ends(std::int64_t step, const Columns& columns) {
  if (step == reach_) free_edges_[z_axis][0].measure(state_, columns.first, columns.last);
  if (step == state_.layout.shape()[z_axis])
    free_edges_[z_axis][1].measure(state_, columns.first, columns.last);
}

/// The values a stencil finds beyond an end of a line.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_cells(std::int64_t line, int side, Real* fields, std::int64_t pitch,
                                       Real scale) const {
  const std::int64_t n = state_.layout.shape()[0];
  const auto& edge = free_edges_[0][side];
  const auto& all = pairs_[0];
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(continuation(edges_[0][side], all[p].wave));
    Real* const v = fields + all[p].v * pitch;
    Real* const s = fields + all[p].s * pitch;
    for (std::int64_t j = 0; j < reach_; ++j) {
      const std::int64_t from = mirror.image(j, n);
      const std::int64_t ghost = side ? n + j : -1 - j, cell = side ? n - 1 - from : from;
      v[ghost] = mirror.v * v[cell];
      s[ghost] = mirror.s * s[cell];
      if (edge.empty()) continue;
      v[ghost] += Real(2 * j + 1) * edge.bend(p)[line];
      s[ghost] += scale * edge.jump(p)[line];
    }
  }
}

/// The same beyond the first or the last row.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_rows(int side, const Columns& columns, Real scale) {
  const std::int64_t n = state_.layout.shape()[z_axis];
  const auto& edge = free_edges_[z_axis][side];
  const auto& all = pairs_[z_axis];
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(continuation(edges_[z_axis][side], all[p].wave));
    for (std::int64_t j = 0; j < reach_; ++j) {
      const std::int64_t from = mirror.image(j, n);
      Index<D> ghost{}, cell{};
      ghost[z_axis] = side ? n + j : -1 - j;
      cell[z_axis] = side ? n - 1 - from : from;
      const auto fill = [&](int row, Real sign, const Real* gain, Real share) {
        Real* const to = state_.field_row(ghost, row);
        const Real* const source = state_.field_row(cell, row);
        for (std::int64_t i = columns.first; i < columns.last; ++i)
          to[i] = sign * source[i] + (gain ? share * gain[i] : Real(0));
      };
      fill(all[p].v, mirror.v, edge.empty() ? nullptr : edge.bend(p), Real(2 * j + 1));
      fill(all[p].s, mirror.s, edge.empty() ? nullptr : edge.jump(p), scale);
    }
  }
}

template void Sweeps<2, float>::keep_sides(std::int64_t, const Columns&);
template void Sweeps<2, double>::keep_sides(std::int64_t, const Columns&);
template void Sweeps<2, float>::measure_sides(std::int64_t);
template void Sweeps<2, double>::measure_sides(std::int64_t);
template void Sweeps<2, float>::measure_ends(std::int64_t, const Columns&);
template void Sweeps<2, double>::measure_ends(std::int64_t, const Columns&);
template void Sweeps<2, float>::fill_ghost_cells(std::int64_t, int, float*, std::int64_t, float) const;
template void Sweeps<2, double>::fill_ghost_cells(std::int64_t, int, double*, std::int64_t, double) const;
template void Sweeps<2, float>::fill_ghost_rows(int, const Columns&, float);
template void Sweeps<2, double>::fill_ghost_rows(int, const Columns&, double);

}  // namespace slipwave::solver
