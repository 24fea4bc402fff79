// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace slipwave::solver {

/// Of the ghost beyond a mirror: nothing moves across it, whatever the shear of the rock does there.
inline constexpr double mirror_impedance = 1e6;
/// Values of a symmetric matrix in space, of the order 00, 01, 02, 11, 12, 22.
inline constexpr std::size_t symmetric = 6;

/// Both sides of n faces in 3-D: impedances as symmetric matrices, what comes in, and the states.
template <class Real>
struct FaceRows {
  const Real *lo[symmetric], *hi[symmetric], *up[3], *down[3];
  Real *v[3], *s[3];
};

/// Z of both sides times v* is the sum of what comes in (theory.md (T5)).
template <class Real>
void solve_faces(std::int64_t n, const FaceRows<Real>& rows) {
  const Real* __restrict const l0 = rows.lo[0];
  const Real* __restrict const l1 = rows.lo[1];
  const Real* __restrict const l2 = rows.lo[2];
  const Real* __restrict const l3 = rows.lo[3];
  const Real* __restrict const l4 = rows.lo[4];
  const Real* __restrict const l5 = rows.lo[5];
  const Real* __restrict const h0 = rows.hi[0];
  const Real* __restrict const h1 = rows.hi[1];
  const Real* __restrict const h2 = rows.hi[2];
  const Real* __restrict const h3 = rows.hi[3];
  const Real* __restrict const h4 = rows.hi[4];
  const Real* __restrict const h5 = rows.hi[5];
  for (std::int64_t k = 0; k < n; ++k) {
    const Real m00 = l0[k] + h0[k], m01 = l1[k] + h1[k], m02 = l2[k] + h2[k], m11 = l3[k] + h3[k],
               m12 = l4[k] + h4[k], m22 = l5[k] + h5[k];
    const Real a = m11 * m22 - m12 * m12, b = m02 * m12 - m01 * m22, c = m01 * m12 - m02 * m11,
               d = m00 * m22 - m02 * m02, e = m01 * m02 - m00 * m12, f = m00 * m11 - m01 * m01;
    const Real share = 1 / (m00 * a + m01 * b + m02 * c);
    const Real u0 = rows.up[0][k], u1 = rows.up[1][k], u2 = rows.up[2][k];
    const Real r0 = u0 + rows.down[0][k], r1 = u1 + rows.down[1][k], r2 = u2 + rows.down[2][k];
    const Real v0 = (a * r0 + b * r1 + c * r2) * share, v1 = (b * r0 + d * r1 + e * r2) * share,
               v2 = (c * r0 + e * r1 + f * r2) * share;
    rows.v[0][k] = v0, rows.v[1][k] = v1, rows.v[2][k] = v2;
    rows.s[0][k] = l0[k] * v0 + l1[k] * v1 + l2[k] * v2 - u0;
    rows.s[1][k] = l1[k] * v0 + l3[k] * v1 + l4[k] * v2 - u1;
    rows.s[2][k] = l2[k] * v0 + l4[k] * v1 + l5[k] * v2 - u2;
  }
}

}  // namespace slipwave::solver
