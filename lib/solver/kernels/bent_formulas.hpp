#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/reconstruction.hpp"

/// The formulas of a cell of a bent row of a fitted grid (theory.md (F3), (F4)), each written once: the loops
/// of bent_rows.hpp and the stencils at interfaces are made of these. No standard header here, as in
/// cell_formulas.hpp.
namespace slipwave::solver {

/// A vector in the order of the pairs of a sweep along z: z, x, in 3-D y. The normal of a row is (1, N_x,
/// N_y)/|N|, so that at a level face the components are those of the pairs.
template <int D>
struct AcrossOrder {
  /// Place of the component `c` of such a vector among the axes.
  static constexpr int axis(int c) { return c == 0 ? D - 1 : c - 1; }
};

/// The traction times |N| on the row at a cell (F3): T = s N.
template <int D, class Real>
[[gnu::always_inline]] inline void row_traction(const BentFields<const Real>& fields, std::int64_t at,
                                                const Real* normal, std::int64_t normal_pitch,
                                                Real traction[D]) {
  const Real* const f = fields.first + at;
  const std::int64_t p = fields.pitch;
  if constexpr (D == 2) {
    const Real nx = normal[0], sxx = f[2 * p], szz = f[3 * p], sxz = f[4 * p];
    traction[0] = szz + nx * sxz;
    traction[1] = sxz + nx * sxx;
  } else {
    const Real nx = normal[0], ny = normal[normal_pitch];
    const Real sxx = f[3 * p], syy = f[4 * p], szz = f[5 * p], sxy = f[6 * p], sxz = f[7 * p], syz = f[8 * p];
    traction[0] = szz + nx * sxz + ny * syz;
    traction[1] = sxz + nx * sxx + ny * sxy;
    traction[2] = syz + nx * sxy + ny * syy;
  }
}

/// What leaves a cell through one of its faces, as a vector (F4): along the normal of the face with the
/// reconstruction of P, across it with that of S. side: +1 upwards, -1 downwards.
template <int D, class Real>
[[gnu::always_inline]] inline void outgoing_wave(const Real v_p[D], const Real t_p[D], const Real v_s[D],
                                                 const Real t_s[D], const Real normal[D], Real side, Real zp,
                                                 Real zs, Real carries_s, Real out[D]) {
  Real square = 0;
  for (int c = 0; c < D; ++c) square += normal[c] * normal[c];
  const Real inverse = 1 / square, length = square * __builtin_sqrt(inverse);
  Real p = 0, s = 0, shear[D];
  for (int c = 0; c < D; ++c) {
    p += normal[c] * (zp * length * v_p[c] - side * t_p[c]);
    shear[c] = carries_s * (zs * length * v_s[c] - side * t_s[c]);
    s += normal[c] * shear[c];
  }
  const Real along = (p - s) * inverse;
  for (int c = 0; c < D; ++c) out[c] = shear[c] + along * normal[c];
}

/// The outgoing waves of a cell up and down (F4) from velocities and tractions round it, [component][cell],
/// and the normals of the faces before and behind it.
template <int Order, int D, class Real>
[[gnu::always_inline]] inline void reconstruct_bent_cell(const Real (&v)[D][2 * reach_of(Order) + 1],
                                                         const Real (&t)[D][2 * reach_of(Order) + 1],
                                                         const Real normal_lo[D], const Real normal_hi[D],
                                                         Real sign, Real stretched, Real zp, Real zs,
                                                         Real up[D], Real down[D]) {
  constexpr int reach = reach_of(Order);
  Real v_up[2][D], v_down[2][D], t_up[2][D], t_down[2][D];
  for (int wave = 0; wave < 2; ++wave) {
    Real e0, e1, e2, e3, o1, o2, o3;
    weights<Order>(stretched * (wave ? zs : zp), e0, e1, e2, e3, o1, o2, o3);
    for (int c = 0; c < D; ++c) {
      Real even, odd;
      even_odd<Order>(v[c] + reach, 1, e0, e1, e2, e3, o1, o2, o3, even, odd);
      v_up[wave][c] = even + odd;
      v_down[wave][c] = even - odd;
      even_odd<Order>(t[c] + reach, 1, e0, e1, e2, e3, o1, o2, o3, even, odd);
      t_up[wave][c] = even + odd;
      t_down[wave][c] = even - odd;
    }
  }
  const Real carries_s = zs > 0 ? Real(1) : Real(0);
  outgoing_wave<D>(v_up[0], t_up[0], v_up[1], t_up[1], normal_hi, Real(1), sign * zp, sign * zs, carries_s,
                   up);
  outgoing_wave<D>(v_down[0], t_down[0], v_down[1], t_down[1], normal_lo, Real(-1), sign * zp, sign * zs,
                   carries_s, down);
}

}  // namespace slipwave::solver
