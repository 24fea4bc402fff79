#include <algorithm>

#include "solver/sweeps.hpp"

// What stencils read beyond the edges of the grid (theory.md (E11)).
namespace slipwave::solver {

template <int D, class Real>
void Sweeps<D, Real>::measure_free_edges(int axis) {
  for (auto& edge : free_edges_[axis]) edge.measure(state_);
}

/// The values a stencil finds beyond both ends of a row.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_cells(std::int64_t line, Real* v, Real* s, int pair, Wave wave,
                                       Real scale) const {
  const std::int64_t n = state_.layout.shape()[0];
  for (const int side : {0, 1}) {
    const Continuation law = continuation(edges_[0][side], wave);
    const Real v_sign = law == Continuation::motionless ? -1 : 1,
               s_sign = law == Continuation::traction_free ? -1 : 1;
    for (std::int64_t j = 0; j < reach_; ++j) {
      const std::int64_t from = law == Continuation::level ? 0 : std::min(j, n - 1);
      const std::int64_t ghost = side ? n + j : -1 - j, cell = side ? n - 1 - from : from;
      v[ghost] = v_sign * v[cell];
      s[ghost] = s_sign * s[cell];
      if (const auto& edge = free_edges_[0][side]; !edge.empty()) {
        v[ghost] += Real(2 * j + 1) * edge.bend(pair)[line];
        s[ghost] += scale * edge.jump(pair)[line];
      }
    }
  }
}

template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_lines(int axis, const Index<D>& first, std::int64_t width, int number,
                                       const Pair& pair, Real scale) {
  const std::int64_t n = state_.layout.shape()[axis];
  for (const int side : {0, 1}) {
    const Continuation law = continuation(edges_[axis][side], pair.wave);
    const Real v_sign = law == Continuation::motionless ? -1 : 1,
               s_sign = law == Continuation::traction_free ? -1 : 1;
    for (std::int64_t j = 0; j < reach_; ++j) {
      const std::int64_t from = law == Continuation::level ? 0 : std::min(j, n - 1);
      Index<D> ghost = first, cell = first;
      ghost[axis] = side ? n + j : -1 - j;
      cell[axis] = side ? n - 1 - from : from;
      for (const auto& [row, sign] : {std::pair(pair.v, v_sign), std::pair(pair.s, s_sign)}) {
        Real* to = state_.field_row(ghost, row) + first[0];
        const Real* source = state_.field_row(cell, row) + first[0];
        for (std::int64_t i = 0; i < width; ++i) to[i] = sign * source[i];
        const auto& edge = free_edges_[axis][side];
        if (edge.empty()) continue;
        const bool is_v = row == pair.v;
        const Real* gain = (is_v ? edge.bend(number) : edge.jump(number)) + edge.number(first);
        const Real share = is_v ? Real(2 * j + 1) : scale;
        for (std::int64_t i = 0; i < width; ++i) to[i] += share * gain[i];
      }
    }
  }
}

template void Sweeps<2, float>::measure_free_edges(int);
template void Sweeps<2, double>::measure_free_edges(int);
template void Sweeps<2, float>::fill_ghost_cells(std::int64_t, float*, float*, int, Wave, float) const;
template void Sweeps<2, double>::fill_ghost_cells(std::int64_t, double*, double*, int, Wave, double) const;
template void Sweeps<2, float>::fill_ghost_lines(int, const Index<2>&, std::int64_t, int, const Pair&, float);
template void Sweeps<2, double>::fill_ghost_lines(int, const Index<2>&, std::int64_t, int, const Pair&,
                                                  double);

}  // namespace slipwave::solver
