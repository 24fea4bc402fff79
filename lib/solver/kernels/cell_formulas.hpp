// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/reconstruction.hpp"

/// The formulas of a sweep for one cell or one face between two cells, after the reconstruction: the Riemann
/// solution (theory.md (E8)) and the update (E9), each written once. The row loops of kernels_level.cpp and
/// fused_row.hpp are made of these. Plain scalars by reference: both compilers vectorise that. No standard
/// header here: this is compiled once for each instruction set, and the linker could keep one copy for
/// everybody.
namespace slipwave::solver {

/// This term of a divisor gives 0/none instead of 0/0 where neither side carries a wave (up = down = 0). Its
/// square is finite and normal.
inline constexpr double none = 1e-15;

/// The criterion of monotonicity for one outgoing wave (theory.md (C1)): `wave` within what keeps the new
/// invariant between its old value and that of the cell it comes from. own, from, to: the invariant in this
/// cell, in the one before it on its way and in the next. Where own is an extremum the wave is own.
template <class Real>
[[gnu::always_inline]] inline Real limited(Real wave, Real own, Real from, Real to, Real over_courant) {
  const Real gained = own - from, left = to - own, most = from + gained * over_courant;
  const Real rising = gained > 0 ? Real(1) : Real(-1);
  // Times `rising` the bounds lie above own.
  const Real bound = rising * most < rising * to ? most : to;
  const Real below_bound = rising * wave < rising * bound ? wave : bound;
  const Real within = rising * below_bound > rising * own ? below_bound : own;
  return gained * left > 0 ? within : own;
}
/// The wave that would enter a cell from its neighbour if both were uniform: the Riemann solution of the
/// neighbour's outgoing wave and the cell's own, in the impedance of the cell.
template <class Real>
[[gnu::always_inline]] inline Real entering(Real z, Real z_from, Real outgoing_from, Real own_outgoing) {
  return (2 * z * outgoing_from + (z - z_from) * own_outgoing) / (z + z_from + Real(none));
}
/// Both outgoing waves of a cell; v, s and z, its impedance, with those of its neighbours a stride away.
template <class Real>
[[gnu::always_inline]] inline void limit_cell(const Real* v, const Real* s, long stride, const Real* z,
                                              long z_stride, Real courant, Real& up, Real& down) {
  const Real over_courant = 1 / (courant + Real(none));
  const Real own = z[0], z_lo = z[-z_stride], z_hi = z[z_stride];
  const Real v_lo = v[-stride], v_hi = v[stride], s_lo = s[-stride], s_hi = s[stride];
  const Real own_up = own * v[0] - s[0], own_down = own * v[0] + s[0];
  up =
      limited(up, own_up, entering(own, z_lo, z_lo * v_lo - s_lo, own_down), own * v_hi - s_hi, over_courant);
  down = limited(down, own_down, entering(own, z_hi, z_hi * v_hi + s_hi, own_up), own * v_lo + s_lo,
                 over_courant);
}

/// 1/(Z_lo + Z_hi) of P and S waves, with one division for both. Without shear that of P alone.
template <bool Shear, class Real>
[[gnu::always_inline]] inline void riemann_shares(Real p_lo, Real p_hi, Real s_lo, Real s_hi, Real& share_p,
                                                  Real& share_s) {
  const Real sum_p = p_lo + p_hi + Real(none), sum_s = s_lo + s_hi + Real(none);
  const Real both = 1 / (Shear ? sum_p * sum_s : sum_p);
  share_p = Shear ? both * sum_s : both;
  share_s = both * sum_p;
}

/// The exact Riemann solution v*, s* at a face between the outgoing wave `up` of the cell below and `down` of
/// the cell above (E8); share = 1/(Z_lo + Z_hi).
template <class Real>
[[gnu::always_inline]] inline void riemann(Real up, Real down, Real z_lo, Real z_hi, Real share, Real& v,
                                           Real& s) {
  v = (up + down) * share;
  s = (z_lo * down - z_hi * up) * share;
}

/// Coefficients of the update of a cell: b times the fraction of the step, lambda + 2 mu and mu times dt/h
/// and the size of that fraction.
template <bool Shear, class Real>
[[gnu::always_inline]] inline void update_coefficients(Real scale, Real size, Real b, Real zp, Real zs,
                                                       Real& moved, Real& p_modulus, Real& s_modulus) {
  moved = scale * b;
  const Real strained = size * b;
  // Times dt/h; multiplied first, so that the smallest velocities do not underflow.
  p_modulus = strained * zp * zp;
  s_modulus = Shear ? strained * zs * zs : Real(0);
}

/// The update of a cell by the P pair of both faces (E9); `along` is the increment of its passive normal
/// stresses.
template <bool Shear, class Real>
[[gnu::always_inline]] inline void update_p(Real dv, Real ds, Real moved, Real p_modulus, Real s_modulus,
                                            Real& v, Real& s, Real& along) {
  along = (Shear ? p_modulus - 2 * s_modulus : p_modulus) * dv;
  v += moved * ds;
  s += p_modulus * dv;
}
/// The update of a cell of an anisotropic medium by the P pair, whose passive stress takes c13 of the strain
/// (V1): `coupled` is that times dt/h and the size of the fraction.
template <class Real>
[[gnu::always_inline]] inline void update_coupled_p(Real dv, Real ds, Real moved, Real p_modulus,
                                                    Real coupled, Real& v, Real& s, Real& along) {
  along = coupled * dv;
  v += moved * ds;
  s += p_modulus * dv;
}
/// What the second S pair and passive stress of such a medium have of their own in 3-D: the shear modulus
/// and the increment (theory.md (O1)). `strained` is b times the size of the fraction.
template <class Real>
[[gnu::always_inline]] inline void second_pair(Real strained, Real z, Real coupling, Real dv, Real& s_modulus,
                                               Real& along) {
  s_modulus = strained * z * z;
  along = strained * coupling * dv;
}
/// The update of a cell by an S pair of both faces.
template <class Real>
[[gnu::always_inline]] inline void update_s(Real dv, Real ds, Real moved, Real s_modulus, Real& v, Real& s) {
  v += moved * ds;
  s += s_modulus * dv;
}

}  // namespace slipwave::solver
