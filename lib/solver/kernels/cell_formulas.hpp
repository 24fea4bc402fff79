#pragma once

#include "solver/kernels/reconstruction.hpp"

/// The formulas of a sweep for one cell or one face between two cells, after the reconstruction: the Riemann
/// solution (theory.md (E8)) and the update (E9), each written once. The row loops of kernels_level.cpp and
/// fused_row.hpp are made of these. Plain scalars by reference: both compilers vectorise that. No standard
/// header here: this is compiled once for each instruction set, and the linker could keep one copy for
/// everybody.
namespace slipwave::solver {

/// Where neither side carries a wave up = down = 0: this gives 0/none instead of 0/0. Its square is finite
/// and normal.
inline constexpr double none = 1e-15;

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
/// The same in an anisotropic medium, whose passive stress takes c13 of the strain (V1): `coupled` is that
/// times dt/h and the size of the fraction.
template <class Real>
[[gnu::always_inline]] inline void update_coupled_p(Real dv, Real ds, Real moved, Real p_modulus,
                                                    Real coupled, Real& v, Real& s, Real& along) {
  along = coupled * dv;
  v += moved * ds;
  s += p_modulus * dv;
}
/// The same of an S pair.
template <class Real>
[[gnu::always_inline]] inline void update_s(Real dv, Real ds, Real moved, Real s_modulus, Real& v, Real& s) {
  v += moved * ds;
  s += s_modulus * dv;
}

}  // namespace slipwave::solver
