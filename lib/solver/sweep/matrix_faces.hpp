// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "solver/sweep/anisotropic_cells.hpp"

namespace slipwave::solver {

/// The P impedance of the ghost beyond a mirror, as a factor: nothing moves across it, whatever the shear of
/// the rock does there.
inline constexpr double mirror_impedance = 1e6;

/// What comes in at n faces and their states, by component.
template <int D, class Real>
struct FaceRows {
  const Real *up[D], *down[D];
  Real *v[D], *s[D];
};

/// Z of both sides times v* is the sum of what comes in (theory.md (T5)).
template <class Real>
void solve_faces(std::int64_t n, const RunOfImpedances<2, Real>& lo, const RunOfImpedances<2, Real>& hi,
                 const FaceRows<2, Real>& rows) {
  const auto &l = lo.values, &h = hi.values;
  const Real* __restrict const up_0 = rows.up[0], * __restrict const up_1 = rows.up[1];
  const Real* __restrict const down_0 = rows.down[0], * __restrict const down_1 = rows.down[1];
  Real* __restrict const to_v0 = rows.v[0], * __restrict const to_v1 = rows.v[1];
  Real* __restrict const to_s0 = rows.s[0], * __restrict const to_s1 = rows.s[1];
  for (std::int64_t k = 0; k < n; ++k) {
    const Real a = l[0][k] + h[0][k], b = l[1][k] + h[1][k], c = l[2][k] + h[2][k];
    const Real u0 = up_0[k], u1 = up_1[k], r0 = u0 + down_0[k], r1 = u1 + down_1[k];
    const Real share = 1 / (a * c - b * b), v0 = (c * r0 - b * r1) * share, v1 = (a * r1 - b * r0) * share;
    to_v0[k] = v0, to_v1[k] = v1;
    to_s0[k] = l[0][k] * v0 + l[1][k] * v1 - u0, to_s1[k] = l[1][k] * v0 + l[2][k] * v1 - u1;
  }
}
template <class Real>
void solve_faces(std::int64_t n, const RunOfImpedances<3, Real>& lo, const RunOfImpedances<3, Real>& hi,
                 const FaceRows<3, Real>& rows) {
  const auto &l = lo.values, &h = hi.values;
  const Real* __restrict const up_0 = rows.up[0], * __restrict const up_1 = rows.up[1], * __restrict const up_2 = rows.up[2];
  const Real* __restrict const down_0 = rows.down[0], * __restrict const down_1 = rows.down[1], * __restrict const down_2 = rows.down[2];
  Real* __restrict const to_v0 = rows.v[0], * __restrict const to_v1 = rows.v[1], * __restrict const to_v2 = rows.v[2];
  Real* __restrict const to_s0 = rows.s[0], * __restrict const to_s1 = rows.s[1], * __restrict const to_s2 = rows.s[2];
  for (std::int64_t k = 0; k < n; ++k) {
    const Real m00 = l[0][k] + h[0][k], m01 = l[1][k] + h[1][k], m02 = l[2][k] + h[2][k],
               m11 = l[3][k] + h[3][k], m12 = l[4][k] + h[4][k], m22 = l[5][k] + h[5][k];
    const Real a = m11 * m22 - m12 * m12, b = m02 * m12 - m01 * m22, c = m01 * m12 - m02 * m11,
               d = m00 * m22 - m02 * m02, e = m01 * m02 - m00 * m12, f = m00 * m11 - m01 * m01;
    const Real share = 1 / (m00 * a + m01 * b + m02 * c);
    const Real u0 = up_0[k], u1 = up_1[k], u2 = up_2[k];
    const Real r0 = u0 + down_0[k], r1 = u1 + down_1[k], r2 = u2 + down_2[k];
    const Real v0 = (a * r0 + b * r1 + c * r2) * share, v1 = (b * r0 + d * r1 + e * r2) * share,
               v2 = (c * r0 + e * r1 + f * r2) * share;
    to_v0[k] = v0, to_v1[k] = v1, to_v2[k] = v2;
    to_s0[k] = l[0][k] * v0 + l[1][k] * v1 + l[2][k] * v2 - u0;
    to_s1[k] = l[1][k] * v0 + l[3][k] * v1 + l[4][k] * v2 - u1;
    to_s2[k] = l[2][k] * v0 + l[4][k] * v1 + l[5][k] * v2 - u2;
  }
}

/// Returns the place of component (i, k) of a symmetric matrix of D rows.
template <int D>
constexpr std::size_t place_in(std::size_t i, std::size_t k) {
  return i <= k ? i * (2 * D - 1 - i) / 2 + k : place_in<D>(k, i);
}

template <class Real, std::size_t Count>
using RowsOf = std::array<const Real*, Count>;
/// Rows of values that follow each other.
template <std::size_t Count, class Real>
RowsOf<Real, Count> rows_from(const Real (*block)[cells_at_once]) {
  RowsOf<Real, Count> rows;
  for (std::size_t k = 0; k < Count; ++k) rows[k] = block[k];
  return rows;
}
/// to = the sum of weights times rows of n values each.
template <class Real, std::size_t Count, std::size_t... K>
void weighted_sum(std::int64_t n, const RowsOf<Real, Count> weights, const RowsOf<Real, Count> rows,
                  Real* __restrict const to, std::index_sequence<K...>) {
  for (std::int64_t i = 0; i < n; ++i) to[i] = (... + (weights[K][i] * rows[K][i]));
}
template <class Real, std::size_t Count>
void weighted_sum(std::int64_t n, const RowsOf<Real, Count>& weights, const RowsOf<Real, Count>& rows,
                  Real* to) {
  weighted_sum(n, weights, rows, to, std::make_index_sequence<Count>());
}

/// The waves of a run of cells, each as one pair of numbers v, s at the places of its stencil (WavePair), and
/// what leaves the cells.
template <int D, class Real>
struct WavesOfRun {
  Real pairs[D][2][most_places][cells_at_once];  // [wave][v, s][place]
  Real up[D][cells_at_once], down[D][cells_at_once];

  /// z_of(wave) is the row of its impedances.
  template <class ZOf>
  void reconstruct(std::int64_t n, int reach, const Kernels<Real>& kernels, const ZOf& z_of, const Real* b,
                   Real scale) {
    for (std::size_t wave = 0; wave < D; ++wave)
      kernels.reconstruct(n, cells_at_once, pairs[wave][0][reach], pairs[wave][1][reach], z_of(wave), b,
                          scale, up[wave], down[wave]);
  }
};
/// The components of n waves of these sizes; motion_of(wave, component) is a row, and so is to(component).
template <int D, class Real, class MotionOf, class To>
void put_components(std::int64_t n, const MotionOf& motion_of, const Real (&sizes)[D][cells_at_once],
                    const To& to) {
  for (std::size_t c = 0; c < D; ++c) {
    RowsOf<Real, D> weights;
    for (std::size_t wave = 0; wave < D; ++wave) weights[wave] = motion_of(wave, c);
    weighted_sum<Real, D>(n, weights, rows_from<D>(sizes), to(int(c)));
  }
}

}  // namespace slipwave::solver
