#include <algorithm>

#include "solver/sweep/sweeps.hpp"

// What stencils read beyond the edges of the grid (theory.md (E11)).
namespace slipwave::solver {
namespace {

/// Signs of the mirror image of a pair.
template <class Real>
struct Mirror {
  Real v, s;
  bool level;
  explicit Mirror(Extension law)
      : v(law == Extension::motionless ? -1 : 1),
        s(law == Extension::traction_free ? -1 : 1),
        level(law == Extension::level) {}
  /// The cell, counted from the edge, that stands for ghost j.
  std::int64_t image(std::int64_t j, std::int64_t cells) const { return level ? 0 : std::min(j, cells - 1); }
};

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::keep(int axis, std::int64_t line, const IndexRange& columns) {
  const IndexRange at = axis == 0 ? columns : [&] {
    const auto row = state_.layout.line_index(line)[std::size_t(axis)];
    return IndexRange{row, row + 1};
  }();
  auto& edges = free_edges_[axis];
  if (at.first == 0 && !edges[0].empty()) edges[0].keep(state_, line);
  if (at.last == state_.layout.shape()[std::size_t(axis)] && !edges[1].empty()) edges[1].keep(state_, line);
}

template <int D, class Real>
void Sweeps<D, Real>::measure_side_surfaces(std::int64_t line) {
  for (auto& edge : free_edges_[0])
    if (!edge.empty()) edge.measure(state_, line, line + 1);
}

template <int D, class Real>
void Sweeps<D, Real>::measure_flank_surfaces(std::int64_t plane) {
  const auto cells = state_.layout.padded_nx();
  for (auto& edge : free_edges_[1])
    if (!edge.empty()) edge.measure(state_, plane * cells, (plane + 1) * cells);
}

template <int D, class Real>
void Sweeps<D, Real>::measure_end_surfaces(std::int64_t step, const IndexRange& columns) {
  const auto cells = D == 2 ? 1 : state_.layout.padded_nx();
  const auto measure = [&](int side) {
    free_edges_[z_axis][side].measure(state_, columns.first * cells, columns.last * cells);
  };
  if (step == reach_) measure(0);
  if (step == state_.layout.shape()[z_axis]) measure(1);
}

/// The values a stencil finds beyond an end of a line.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_cells(std::int64_t line, int side, Real* fields, std::int64_t pitch,
                                       Real scale) const {
  const std::int64_t n = state_.layout.shape()[0];
  const auto& edge = free_edges_[0][side];
  const auto& all = pairs_[0];
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(edges_[0][side], all[p].wave));
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

/// The same beyond the first or the last row of another axis.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_rows(int axis, const Index<D>& at, int side, const IndexRange& columns,
                                      Real scale) {
  const std::int64_t n = state_.layout.shape()[axis];
  const auto& edge = free_edges_[axis][side];
  const auto& all = pairs_[axis];
  const auto first = edge.empty() ? 0 : edge.number(at);
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(edges_[axis][side], all[p].wave));
    for (std::int64_t j = 0; j < reach_; ++j) {
      const std::int64_t from = mirror.image(j, n);
      Index<D> ghost = at, cell = at;
      ghost[axis] = side ? n + j : -1 - j;
      cell[axis] = side ? n - 1 - from : from;
      const auto fill = [&](int row, Real sign, const Real* gain, Real share) {
        Real* const to = state_.field_row(ghost, row);
        const Real* const source = state_.field_row(cell, row);
        for (std::int64_t i = columns.first; i < columns.last; ++i)
          to[i] = sign * source[i] + (gain ? share * gain[i] : Real(0));
      };
      fill(all[p].v, mirror.v, edge.empty() ? nullptr : edge.bend(p) + first, Real(2 * j + 1));
      fill(all[p].s, mirror.s, edge.empty() ? nullptr : edge.jump(p) + first, scale);
    }
  }
}

template void Sweeps<2, float>::keep(int, std::int64_t, const IndexRange&);
template void Sweeps<2, float>::measure_side_surfaces(std::int64_t);
template void Sweeps<2, float>::measure_flank_surfaces(std::int64_t);
template void Sweeps<2, float>::measure_end_surfaces(std::int64_t, const IndexRange&);
template void Sweeps<2, float>::fill_ghost_cells(std::int64_t, int, float*, std::int64_t, float) const;
template void Sweeps<2, float>::fill_ghost_rows(int, const Index<2>&, int, const IndexRange&, float);
template void Sweeps<3, float>::keep(int, std::int64_t, const IndexRange&);
template void Sweeps<3, float>::measure_side_surfaces(std::int64_t);
template void Sweeps<3, float>::measure_flank_surfaces(std::int64_t);
template void Sweeps<3, float>::measure_end_surfaces(std::int64_t, const IndexRange&);
template void Sweeps<3, float>::fill_ghost_cells(std::int64_t, int, float*, std::int64_t, float) const;
template void Sweeps<3, float>::fill_ghost_rows(int, const Index<3>&, int, const IndexRange&, float);
template void Sweeps<2, double>::keep(int, std::int64_t, const IndexRange&);
template void Sweeps<2, double>::measure_side_surfaces(std::int64_t);
template void Sweeps<2, double>::measure_flank_surfaces(std::int64_t);
template void Sweeps<2, double>::measure_end_surfaces(std::int64_t, const IndexRange&);
template void Sweeps<2, double>::fill_ghost_cells(std::int64_t, int, double*, std::int64_t, double) const;
template void Sweeps<2, double>::fill_ghost_rows(int, const Index<2>&, int, const IndexRange&, double);
template void Sweeps<3, double>::keep(int, std::int64_t, const IndexRange&);
template void Sweeps<3, double>::measure_side_surfaces(std::int64_t);
template void Sweeps<3, double>::measure_flank_surfaces(std::int64_t);
template void Sweeps<3, double>::measure_end_surfaces(std::int64_t, const IndexRange&);
template void Sweeps<3, double>::fill_ghost_cells(std::int64_t, int, double*, std::int64_t, double) const;
template void Sweeps<3, double>::fill_ghost_rows(int, const Index<3>&, int, const IndexRange&, double);

}  // namespace slipwave::solver
