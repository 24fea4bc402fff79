#pragma once

#include "solver/kernels/bent_formulas.hpp"
#include "solver/kernels/cell_formulas.hpp"
#include "solver/kernels/kernels.hpp"

/// Row loops of sweeps through bent rows of a fitted grid (theory.md (F2)-(F6)), made of the same
/// reconstruction and Riemann solution as those of regular rows. Compiled once for each instruction set: no
/// standard header here.
namespace slipwave::solver {
namespace {

/// Along a horizontal axis: the pair is (v, J s), and a face has the impedance Z times its own J (F2).
template <int Order, class Real>
void reconstruct_bent_along(std::int64_t n, std::int64_t stride, const Real* __restrict v,
                            const Real* __restrict s, const Real* __restrict impedance,
                            const Real* __restrict b, Real scale, const BentAlong<Real>& metric,
                            Real* __restrict up, Real* __restrict down) {
  constexpr int reach = reach_of(Order);
  const Real sign = scale < 0 ? Real(-1) : Real(1), size = sign * scale;
  const Real* __restrict j = metric.j, * __restrict j_lo = metric.j_lo, * __restrict j_hi = metric.j_hi;
  const std::int64_t j_stride = metric.stride;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real t[2 * reach + 1];
    for (int k = -reach; k <= reach; ++k) t[k + reach] = j[i + k * j_stride] * s[i + k * stride];
    Real e0, e1, e2, e3, o1, o2, o3, v_even, v_odd, t_even, t_odd;
    weights<Order>(size * (impedance[i] * b[i]), e0, e1, e2, e3, o1, o2, o3);
    even_odd<Order>(v + i, stride, e0, e1, e2, e3, o1, o2, o3, v_even, v_odd);
    even_odd<Order>(t + reach, 1, e0, e1, e2, e3, o1, o2, o3, t_even, t_odd);
    const Real z = sign * impedance[i];
    up[i] = z * j_hi[i] * (v_even + v_odd) - (t_even + t_odd);
    down[i] = z * j_lo[i] * (v_even - v_odd) + (t_even - t_odd);
  }
}

/// (E8) at faces of impedances Z J: of all pairs.
template <int Pairs, class Real>
void solve_bent_along(std::int64_t n, OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                      const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                      const Real* __restrict j_face, InterfaceStates<Real> faces) {
  const Real* __restrict zp_lo = lo.zp, * __restrict zp_hi = hi.zp, * __restrict zs_lo = lo.zs, * __restrict zs_hi = hi.zs;
  for (int p = 0; p < Pairs; ++p) {
    const Real* __restrict up = below.up(p), * __restrict down = above.down(p);
    const Real* __restrict z_lo = p == 0 ? zp_lo : zs_lo, * __restrict z_hi = p == 0 ? zp_hi : zs_hi;
    Real* __restrict v = faces.v(p), * __restrict s = faces.s(p);
#pragma omp simd
    for (std::int64_t i = 0; i < n; ++i) {
      riemann(up[i], down[i], z_lo[i], z_hi[i], 1 / (z_lo[i] + z_hi[i] + Real(none)), v[i], s[i]);
      v[i] /= j_face[i];
    }
  }
}

/// (E9) with rho J instead of rho.
template <int D, class Real>
void update_bent_along(std::int64_t n, Real scale, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                       const MaterialRows<Real>& material, const Real* __restrict j,
                       const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v(0), * __restrict s_lo = lo.s(0), * __restrict w_lo = lo.v(1), * __restrict t_lo = lo.s(1);
  const Real* __restrict v_hi = hi.v(0), * __restrict s_hi = hi.s(0), * __restrict w_hi = hi.v(1), * __restrict t_hi = hi.s(1);
  const Real* __restrict w2_lo = lo.v(2), * __restrict t2_lo = lo.s(2), * __restrict w2_hi = hi.v(2), * __restrict t2_hi = hi.s(2);
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict passive2 = rows.passive2;
  Real* __restrict vt = rows.vt, * __restrict st = rows.st, * __restrict vt2 = rows.vt2, * __restrict st2 = rows.st2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real moved, p_modulus, s_modulus, along;
    update_coefficients<true>(scale, size, b[i], zp[i], zs[i], moved, p_modulus, s_modulus);
    moved /= j[i];
    update_p<true>(v_hi[i] - v_lo[i], s_hi[i] - s_lo[i], moved, p_modulus, s_modulus, v[i], s[i], along);
    passive[i] += along;
    if constexpr (D == 3) passive2[i] += along;
    update_s(w_hi[i] - w_lo[i], t_hi[i] - t_lo[i], moved, s_modulus, vt[i], st[i]);
    if constexpr (D == 3)
      update_s(w2_hi[i] - w2_lo[i], t2_hi[i] - t2_lo[i], moved, s_modulus, vt2[i], st2[i]);
  }
}

template <int Order, int D, class Real>
void reconstruct_bent_across(std::int64_t n, Real scale, const BentFields<const Real>& fields,
                             const MaterialRows<Real>& material, const BentAcross<Real>& metric,
                             OutgoingWaves<Real> outgoing) {
  constexpr int reach = reach_of(Order);
  const Real sign = scale < 0 ? Real(-1) : Real(1), size = sign * scale;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  Real* const out = outgoing.first;
  const std::int64_t out_pitch = outgoing.pitch;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real v[D][2 * reach + 1], t[D][2 * reach + 1];
    for (int k = -reach; k <= reach; ++k) {
      Real traction[D];
      row_traction<D>(fields, i + k * fields.stride, metric.n_cell + i + k * metric.stride, metric.pitch,
                      traction);
      for (int c = 0; c < D; ++c) {
        v[c][k + reach] = fields.first[i + k * fields.stride + AcrossOrder<D>::axis(c) * fields.pitch];
        t[c][k + reach] = traction[c];
      }
    }
    Real normal_lo[D], normal_hi[D];
    normal_lo[0] = normal_hi[0] = 1;
    Real square = 1;
    for (int c = 1; c < D; ++c) {
      normal_lo[c] = metric.n_face[i + (c - 1) * metric.pitch];
      normal_hi[c] = metric.n_face[i + (c - 1) * metric.pitch + metric.stride];
      const Real own = metric.n_cell[i + (c - 1) * metric.pitch];
      square += own * own;
    }
    const Real stretched = size * b[i] * __builtin_sqrt(square) / metric.j[i];
    Real up[D], down[D];
    reconstruct_bent_cell<Order, D>(v, t, normal_lo, normal_hi, sign, stretched, zp[i], zs[i], up, down);
    for (int c = 0; c < D; ++c) {
      out[2 * c * out_pitch + i] = up[c];
      out[(2 * c + 1) * out_pitch + i] = down[c];
    }
  }
}

/// The Riemann solution (E8) along and across the normal of a bent face. In fluid the velocity along the face
/// is that of the cells: faces holds what the cell below the face sees, seen_above what the cell above does.
template <int D, class Real>
void solve_bent_across(std::int64_t n, Real sign, OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                       const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                       const BentFields<const Real>& fields_lo, const BentFields<const Real>& fields_hi,
                       const BentAcross<Real>& metric, InterfaceStates<Real> faces, Real* seen_above,
                       std::int64_t seen_pitch) {
  const Real* __restrict zp_lo = lo.zp, * __restrict zp_hi = hi.zp, * __restrict zs_lo = lo.zs, * __restrict zs_hi = hi.zs;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real normal[D], up[D], down[D], own_lo[D], own_hi[D];
    normal[0] = 1;
    for (int c = 1; c < D; ++c) normal[c] = metric.n_face[i + (c - 1) * metric.pitch];
    Real square = 0, p_up = 0, p_down = 0, p_lo = 0, p_hi = 0;
    for (int c = 0; c < D; ++c) {
      up[c] = below.first[2 * c * below.pitch + i];
      down[c] = above.first[(2 * c + 1) * above.pitch + i];
      own_lo[c] = sign * fields_lo.first[AcrossOrder<D>::axis(c) * fields_lo.pitch + i];
      own_hi[c] = sign * fields_hi.first[AcrossOrder<D>::axis(c) * fields_hi.pitch + i];
      square += normal[c] * normal[c];
      p_up += normal[c] * up[c];
      p_down += normal[c] * down[c];
      p_lo += normal[c] * own_lo[c];
      p_hi += normal[c] * own_hi[c];
    }
    const Real inverse = 1 / square, length = square * __builtin_sqrt(inverse);
    p_up *= inverse, p_down *= inverse, p_lo *= inverse, p_hi *= inverse;
    Real share_p, share_s, v_p, t_p;
    riemann_shares<true>(zp_lo[i], zp_hi[i], zs_lo[i], zs_hi[i], share_p, share_s);
    riemann(p_up, p_down, zp_lo[i], zp_hi[i], share_p, v_p, t_p);
    const Real over = inverse * length;  // 1/|N|
    v_p *= over;
    const bool solid_lo = zs_lo[i] > 0, solid_hi = zs_hi[i] > 0;
    const bool fluid_lo = zp_lo[i] > 0 && !solid_lo, fluid_hi = zp_hi[i] > 0 && !solid_hi;
    const Real half_hi = fluid_lo && fluid_hi ? Real(0.5) : Real(0);
    for (int c = 0; c < D; ++c) {
      Real v_s, t_s;
      riemann(up[c] - p_up * normal[c], down[c] - p_down * normal[c], zs_lo[i], zs_hi[i], share_s, v_s, t_s);
      v_s *= over;
      const Real along_lo = own_lo[c] - p_lo * normal[c], along_hi = own_hi[c] - p_hi * normal[c];
      const Real mixed = half_hi * (along_hi - along_lo);
      const Real of_p = v_p * normal[c];
      faces.first[2 * c * faces.pitch + i] = of_p + (fluid_lo ? along_lo + mixed : v_s);
      seen_above[c * seen_pitch + i] = of_p + (fluid_hi ? along_hi - mixed : v_s);
      faces.first[(2 * c + 1) * faces.pitch + i] = t_p * normal[c] + t_s;
    }
  }
}

/// (F5): rho J v += dt/h [T*], s += C : sym(N [v*]) dt/(h J). `lo` holds tractions, v_lo what this cell sees.
template <int D, class Real>
void update_bent_across(std::int64_t n, Real scale, InterfaceStates<Real> lo, const Real* __restrict v_lo,
                        std::int64_t v_lo_pitch, InterfaceStates<Real> hi, const MaterialRows<Real>& material,
                        const BentAcross<Real>& metric, const BentFields<Real>& fields) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real moved, p_modulus, mu;
    const Real over = 1 / metric.j[i];
    update_coefficients<true>(scale, size, b[i], zp[i], zs[i], moved, p_modulus, mu);
    moved *= over, p_modulus *= over, mu *= over;
    const Real lambda = p_modulus - 2 * mu;
    Real d[D];
    for (int c = 0; c < D; ++c) {
      d[c] = hi.first[2 * c * hi.pitch + i] - v_lo[c * v_lo_pitch + i];
      fields.first[AcrossOrder<D>::axis(c) * fields.pitch + i] +=
          moved * (hi.first[(2 * c + 1) * hi.pitch + i] - lo.first[(2 * c + 1) * lo.pitch + i]);
    }
    Real* const f = fields.first + i;
    const std::int64_t p = fields.pitch;
    const Real nx = metric.n_cell[i];
    if constexpr (D == 2) {
      const Real trace = lambda * (nx * d[1] + d[0]);
      f[2 * p] += trace + 2 * mu * (nx * d[1]);
      f[3 * p] += trace + 2 * mu * d[0];
      f[4 * p] += mu * (nx * d[0] + d[1]);
    } else {
      const Real ny = metric.n_cell[i + metric.pitch];
      const Real trace = lambda * (nx * d[1] + ny * d[2] + d[0]);
      f[3 * p] += trace + 2 * mu * (nx * d[1]);
      f[4 * p] += trace + 2 * mu * (ny * d[2]);
      f[5 * p] += trace + 2 * mu * d[0];
      f[6 * p] += mu * (nx * d[2] + ny * d[1]);
      f[7 * p] += mu * (nx * d[0] + d[1]);
      f[8 * p] += mu * (ny * d[0] + d[2]);
    }
  }
}

template <int Order, int D, class Real>
constexpr BentKernels<Real> bent_kernels = {
    reconstruct_bent_along<Order, Real>,     solve_bent_along<D, Real>,  update_bent_along<D, Real>,
    reconstruct_bent_across<Order, D, Real>, solve_bent_across<D, Real>, update_bent_across<D, Real>};

}  // namespace
}  // namespace slipwave::solver
