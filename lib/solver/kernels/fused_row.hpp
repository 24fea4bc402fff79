// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/cell_formulas.hpp"
#include "solver/kernels/kernels.hpp"

// No standard header here: this is compiled once for each instruction set, and the linker could keep one copy
// for everybody.
namespace slipwave::solver {

namespace {

/// The face of a pair between the wave upwards from the row before and that downwards of this one; stores it
/// and the wave upwards for later rows.
template <class Real>
[[gnu::always_inline]] inline void meet(Real from, Real up, Real down, Real z_lo, Real z_hi, Real share,
                                        Real& up_to, Real& face_v, Real& face_s, Real& v, Real& s) {
  up_to = up;
  riemann(from, down, z_lo, z_hi, share, v, s);
  face_v = v;
  face_s = s;
}

/// Reconstruction, Riemann solution and update of a row of a sweep across the rows in one loop: the same bits
/// as the three loops (Kernels.OfAFusedRowGiveTheSameBits). Outgoing waves downwards and half of the new
/// values stay in registers, and while one part waits for memory or the division the others continue. In
/// space each pair of an anisotropic medium has an impedance of its own.
template <int Order, int Sign, int Shears, bool Coupled, class Real>
[[gnu::always_inline]] inline void fused_row_in(std::int64_t n, Real scale, const FusedRow<Real>& rows) {
  constexpr bool Shear = Shears > 0, Shear2 = Shears > 1, In3D = Shear2 && Coupled;
  const Real size = Sign < 0 ? -scale : scale;
  const std::int64_t stride = rows.stride, m = rows.material_pitch, ups = rows.up_pitch, f = rows.face_pitch;
  // The row that is advanced is one that the reconstruction reads: a field has one pointer for both.
  constexpr int behind = Order < 3 ? 1 : (Order - 1) / 2;
  Real* __restrict v = rows.fields.v, * __restrict s = rows.fields.s, * __restrict passive = rows.fields.passive;
  Real* __restrict vt = rows.fields.vt, * __restrict st = rows.fields.st;
  Real* __restrict vt2 = rows.fields.vt2, * __restrict st2 = rows.fields.st2, * __restrict passive2 = rows.fields.passive2;
  const std::int64_t to_p = In3D ? rows.zp : m, to_s = In3D ? rows.zs : 2 * m, to_s2 = rows.zs2;
  const Real *below = rows.below, *here = rows.here, *done = rows.done, *lo = rows.lo, *hi = rows.hi;
  const Real *coupling = rows.coupling, *coupling2 = rows.coupling2;
  const Real* __restrict up_from = rows.up_from;
  Real* __restrict up_to = rows.up_to, * __restrict faces = rows.faces;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real b = here[i], p_hi = here[i + to_p], s_hi = Shear ? here[i + to_s] : Real(0);
    const Real p_lo = below[i + to_p], s_lo = Shear ? below[i + to_s] : Real(0);
    const Real s2_hi = In3D ? here[i + to_s2] : s_hi, s2_lo = In3D ? below[i + to_s2] : s_lo;
    Real up_p, down_p, up_s, down_s, up_s2, down_s2;
    reconstruct_cell<Order>(v + i, s + i, stride, Sign * p_hi, size * (p_hi * b), up_p, down_p);
    if constexpr (Shear)
      reconstruct_cell<Order>(vt + i, st + i, stride, Sign * s_hi, size * (s_hi * b), up_s, down_s);
    if constexpr (Shear2)
      reconstruct_cell<Order>(vt2 + i, st2 + i, stride, Sign * s2_hi, size * (s2_hi * b), up_s2, down_s2);
    Real share_p, share_s, v_p, s_p, v_s, s_s, v_s2, s_s2;
    riemann_shares<Shear>(p_lo, p_hi, s_lo, s_hi, share_p, share_s);
    meet(up_from[i], up_p, down_p, p_lo, p_hi, share_p, up_to[i], faces[i], faces[i + f], v_p, s_p);
    if constexpr (Shear)
      meet(up_from[i + ups], up_s, down_s, s_lo, s_hi, share_s, up_to[i + ups], faces[i + 2 * f],
           faces[i + 3 * f], v_s, s_s);
    if constexpr (Shear2)
      meet(up_from[i + 2 * ups], up_s2, down_s2, s2_lo, s2_hi,
           In3D ? 1 / (s2_lo + s2_hi + Real(none)) : share_s, up_to[i + 2 * ups], faces[i + 4 * f],
           faces[i + 5 * f], v_s2, s_s2);
    // At order 1, just one row behind, these are the faces behind the cell.
    const Real v_hi = behind == 1 ? v_p : hi[i], n_hi = behind == 1 ? s_p : hi[i + f];
    Real moved, p_modulus, s_modulus, along;
    update_coefficients<Shear>(scale, size, done[i], done[i + to_p], Shear ? done[i + to_s] : Real(0), moved,
                               p_modulus, s_modulus);
    const std::int64_t at = i - behind * stride;
    if constexpr (Coupled)
      update_coupled_p(v_hi - lo[i], n_hi - lo[i + f], moved, p_modulus, size * done[i] * coupling[i], v[at],
                       s[at], along);
    else
      update_p<Shear>(v_hi - lo[i], n_hi - lo[i + f], moved, p_modulus, s_modulus, v[at], s[at], along);
    if constexpr (Shear) {
      const Real w_hi = behind == 1 ? v_s : hi[i + 2 * f], t_hi = behind == 1 ? s_s : hi[i + 3 * f];
      passive[at] += along;
      update_s(w_hi - lo[i + 2 * f], t_hi - lo[i + 3 * f], moved, s_modulus, vt[at], st[at]);
    }
    if constexpr (Shear2) {
      const Real w_hi = behind == 1 ? v_s2 : hi[i + 4 * f], t_hi = behind == 1 ? s_s2 : hi[i + 5 * f];
      if constexpr (In3D)
        second_pair(size * done[i], done[i + to_s2], coupling2[i], v_hi - lo[i], s_modulus, along);
      passive2[at] += along;
      update_s(w_hi - lo[i + 4 * f], t_hi - lo[i + 5 * f], moved, s_modulus, vt2[at], st2[at]);
    }
  }
}

template <int Order, int Shears, bool Coupled, class Real>
void fused_row(std::int64_t n, Real scale, const FusedRow<Real>& rows) {
  if (scale < 0)
    fused_row_in<Order, -1, Shears, Coupled>(n, scale, rows);
  else
    fused_row_in<Order, 1, Shears, Coupled>(n, scale, rows);
}

}  // namespace
}  // namespace slipwave::solver
