// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/cell_formulas.hpp"
#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/kernels/kernels.hpp"

/// Row loops of sweeps through curvilinear rows of a fitted grid (theory.md (F2)-(F6)), made of the same
/// reconstruction and Riemann solution as those of regular rows. Compiled once for each instruction set: no
/// standard header here.
namespace slipwave::solver {
namespace {

/// The outgoing waves of a pair (v, J s) of a cell; js(k) is J s k cells further along the sweep.
template <int Order, class Real, class At>
[[gnu::always_inline]] inline void reconstruct_curvilinear_pair(const Real* v, std::int64_t stride,
                                                                const At& js, Real courant, Real z_lo,
                                                                Real z_hi, Real& up, Real& down) {
  Weights<Order, Real> w;
  Real v_even, v_odd, t_even, t_odd;
  weights(courant, w);
  even_odd(v, stride, w, v_even, v_odd);
  even_odd_of(js, w, t_even, t_odd);
  up = z_hi * (v_even + v_odd) - (t_even + t_odd);
  down = z_lo * (v_even - v_odd) + (t_even - t_odd);
}

/// The row loop along a horizontal axis: the pairs are (v, J s), and a face has the impedance Z times its own
/// J (F2). js(p, i, k) is J s of pair p, k cells further along the sweep than cell i, one of these cells.
template <int Order, int Pairs, class Real, class At>
[[gnu::always_inline]] inline void reconstruct_curvilinear_pairs(
    std::int64_t first, std::int64_t last, std::int64_t stride, const CurvilinearPairs<Real>& pairs,
    const At& js, const MaterialRows<Real>& material, Real scale, const CurvilinearAlong<Real>& metric,
    OutgoingWaves<Real> outgoing) {
  const Real sign = scale < 0 ? Real(-1) : Real(1), size = sign * scale, twice = 2 * sign;
  const Real* __restrict half_lo = metric.half_lo, * __restrict half_hi = metric.half_hi;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  const Real* __restrict v = pairs.v[0], * __restrict w = pairs.v[1], * __restrict w2 = pairs.v[2];
  Real* __restrict up_p = outgoing.up(0), * __restrict down_p = outgoing.down(0);
  Real* __restrict up_s = outgoing.up(1), * __restrict down_s = outgoing.down(1);
  Real* __restrict up_s2 = outgoing.up(2), * __restrict down_s2 = outgoing.down(2);
#pragma omp simd
  for (std::int64_t i = first; i < last; ++i) {
    const Real moved = size * b[i], lo = twice * half_lo[i], hi = twice * half_hi[i];
    const Real p = zp[i], z = zs[i];
    const auto of_p = [=](long k) __attribute__((always_inline)) { return js(0, i, k); };
    const auto of_s = [=](long k) __attribute__((always_inline)) { return js(1, i, k); };
    reconstruct_curvilinear_pair<Order>(v + i, stride, of_p, moved * p, lo * p, hi * p, up_p[i], down_p[i]);
    reconstruct_curvilinear_pair<Order>(w + i, stride, of_s, moved * z, lo * z, hi * z, up_s[i], down_s[i]);
    if constexpr (Pairs == 3) {
      const auto of_s2 = [=](long k) __attribute__((always_inline)) { return js(2, i, k); };
      reconstruct_curvilinear_pair<Order>(w2 + i, stride, of_s2, moved * z, lo * z, hi * z, up_s2[i],
                                          down_s2[i]);
    }
  }
}

/// Along y: all that is read of a row is read once.
template <int Order, class Real>
[[gnu::always_inline]] inline void reconstruct_curvilinear_along_y(std::int64_t n, std::int64_t stride,
                                                                   const CurvilinearPairs<Real>& pairs,
                                                                   const MaterialRows<Real>& material,
                                                                   Real scale,
                                                                   const CurvilinearAlong<Real>& metric,
                                                                   OutgoingWaves<Real> outgoing) {
  const Real* half = metric.half_x;
  const Real *s = pairs.s[0], *t = pairs.s[1], *t2 = pairs.s[2];
  const std::int64_t j_stride = metric.stride;
  const auto js = [=](int pair, std::int64_t i, long k) __attribute__((always_inline)) {
    const Real* const of = pair == 0 ? s : pair == 1 ? t : t2;
    return (half[i + k * j_stride] + half[i + k * j_stride + 1]) * of[i + k * stride];
  };
  reconstruct_curvilinear_pairs<Order, 3>(0, n, stride, pairs, js, material, scale, metric, outgoing);
}

/// Writes J s of cells; those of the next pair follow a pitch further.
template <int Pairs, class Real>
[[gnu::always_inline]] inline void put_js(std::int64_t first, std::int64_t last, const Real* __restrict half,
                                          const CurvilinearPairs<Real>& pairs, Real* __restrict to,
                                          std::int64_t pitch) {
  const Real* __restrict s = pairs.s[0], * __restrict t = pairs.s[1], * __restrict t2 = pairs.s[2];
  Real* __restrict to_t = to + pitch, * __restrict to_t2 = to + 2 * pitch;
#pragma omp simd
  for (std::int64_t i = first; i < last; ++i) {
    const Real j = half[i] + half[i + 1];
    to[i - first] = j * s[i];
    to_t[i - first] = j * t[i];
    if constexpr (Pairs == 3) to_t2[i - first] = j * t2[i];
  }
}

/// Along x each value of J s is read by all cells within reach: it is computed once for all of them, of as
/// many cells at a time as leave room in the first-level cache.
template <int Order, int Pairs, class Real>
[[gnu::always_inline]] inline void reconstruct_curvilinear_along_x(
    std::int64_t n, const CurvilinearPairs<Real>& pairs, const MaterialRows<Real>& material, Real scale,
    const CurvilinearAlong<Real>& metric, OutgoingWaves<Real> outgoing) {
  // Each row begins with a cache line.
  constexpr std::int64_t reach = Weights<Order, Real>::reach, most = 256, pitch = most + 16;
  static_assert(2 * reach <= pitch - most);
  alignas(64) Real computed[Pairs * pitch];
  for (std::int64_t from = 0; from < n; from += most) {
    const std::int64_t last = n - from < most ? n : from + most;
    put_js<Pairs>(from - reach, last + reach, metric.half_x, pairs, computed, pitch);
    const Real* const of = computed;
    const auto js = [=](int pair, std::int64_t i, long k) __attribute__((always_inline)) {
      return of[pair * pitch + reach + (i - from) + k];
    };
    reconstruct_curvilinear_pairs<Order, Pairs>(from, last, 1, pairs, js, material, scale, metric, outgoing);
  }
}

template <int Order, int Pairs, class Real>
void reconstruct_curvilinear_along(std::int64_t n, std::int64_t stride, const CurvilinearPairs<Real>& pairs,
                                   const MaterialRows<Real>& material, Real scale,
                                   const CurvilinearAlong<Real>& metric, OutgoingWaves<Real> outgoing) {
  if constexpr (Pairs == 3)
    if (stride != 1)
      return reconstruct_curvilinear_along_y<Order>(n, stride, pairs, material, scale, metric, outgoing);
  reconstruct_curvilinear_along_x<Order, Pairs>(n, pairs, material, scale, metric, outgoing);
}

/// The Riemann solution where waves of a face of size J carry J times the traction and `up` and `down` are
/// those of J s: share = 1/((Z_lo + Z_hi) J), of_traction = 1/(Z_lo + Z_hi).
template <class Real>
[[gnu::always_inline]] inline void riemann_of_size(Real up, Real down, Real z_lo, Real z_hi, Real share,
                                                   Real of_traction, Real& v, Real& s) {
  v = (up + down) * share;
  s = (z_lo * down - z_hi * up) * of_traction;
}

/// (E8) at faces of impedances Z J, of all pairs, with one division.
template <int Pairs, class Real>
void solve_curvilinear_along(std::int64_t n, OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                             const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                             const Real* __restrict half_face, InterfaceStates<Real> faces) {
  const Real* __restrict zp_lo = lo.zp, * __restrict zp_hi = hi.zp, * __restrict zs_lo = lo.zs, * __restrict zs_hi = hi.zs;
  const Real* __restrict up_p = below.up(0), * __restrict down_p = above.down(0), * __restrict up_s = below.up(1), * __restrict down_s = above.down(1);
  const Real* __restrict up_s2 = below.up(2), * __restrict down_s2 = above.down(2);
  Real* __restrict v_p = faces.v(0), * __restrict s_p = faces.s(0), * __restrict v_s = faces.v(1), * __restrict s_s = faces.s(1);
  Real* __restrict v_s2 = faces.v(2), * __restrict s_s2 = faces.s(2);
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real p_lo = zp_lo[i], p_hi = zp_hi[i], s_lo = zs_lo[i], s_hi = zs_hi[i],
               j = half_face[i] + half_face[i];
    const Real sum_p = p_lo + p_hi + Real(none), sum_s = s_lo + s_hi + Real(none);
    const Real both = 1 / (sum_p * sum_s * j), share_p = both * sum_s, share_s = both * sum_p;
    const Real traction_p = j * share_p, traction_s = j * share_s;
    riemann_of_size(up_p[i], down_p[i], p_lo, p_hi, share_p, traction_p, v_p[i], s_p[i]);
    riemann_of_size(up_s[i], down_s[i], s_lo, s_hi, share_s, traction_s, v_s[i], s_s[i]);
    if constexpr (Pairs == 3)
      riemann_of_size(up_s2[i], down_s2[i], s_lo, s_hi, share_s, traction_s, v_s2[i], s_s2[i]);
  }
}

/// (E9) with rho J instead of rho.
template <int D, class Real>
void update_curvilinear_along(std::int64_t n, Real scale, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                              const MaterialRows<Real>& material, const Real* __restrict over_j,
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
    moved *= over_j[i];
    update_p<true>(v_hi[i] - v_lo[i], s_hi[i] - s_lo[i], moved, p_modulus, s_modulus, v[i], s[i], along);
    passive[i] += along;
    if constexpr (D == 3) passive2[i] += along;
    update_s(w_hi[i] - w_lo[i], t_hi[i] - t_lo[i], moved, s_modulus, vt[i], st[i]);
    if constexpr (D == 3)
      update_s(w2_hi[i] - w2_lo[i], t2_hi[i] - t2_lo[i], moved, s_modulus, vt2[i], st2[i]);
  }
}

/// Writes a vector to the rows of a pair's first or second value.
template <class Real>
[[gnu::always_inline]] inline void put(const RowVector<2, Real>& from, Real* to, std::int64_t pitch) {
  to[0] = from.z;
  to[pitch] = from.x;
}
template <class Real>
[[gnu::always_inline]] inline void put(const RowVector<3, Real>& from, Real* to, std::int64_t pitch) {
  to[0] = from.z;
  to[pitch] = from.x;
  to[2 * pitch] = from.y;
}
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> take(const Real* from, std::int64_t pitch) {
  if constexpr (D == 2)
    return {from[0], from[pitch]};
  else
    return {from[0], from[pitch], from[2 * pitch]};
}

// Bodies of loops stand in functions of their own: a vector that a loop itself declares would not be kept in
// registers.

/// The outgoing waves of one cell; pointers as in CurvilinearFields and CurvilinearAcross, at the cell.
template <int Order, int D, class Real>
[[gnu::always_inline]] inline void reconstruct_curvilinear_at(const Real* field, std::int64_t pitch,
                                                              std::int64_t stride, const Real* half_n,
                                                              const Real* over_face, std::int64_t of_metric,
                                                              std::int64_t next, Real courant, Real sign,
                                                              Real zp, Real zs, Real* out,
                                                              std::int64_t out_pitch) {
  RowVector<D, Real> up, down;
  reconstruct_between<Order, D>(
      [=](long k) __attribute__((always_inline)) { return row_velocity<D>(field + k * stride, pitch); },
      [=](long k) __attribute__((always_inline)) {
        return row_traction<D>(field + k * stride, pitch, cell_normal<D>(half_n + k * next, of_metric, next));
      },
      CurvilinearFace<D, Real>{face_normal<D>(half_n, of_metric), over_face[0]},
      CurvilinearFace<D, Real>{face_normal<D>(half_n + next, of_metric), over_face[next]}, courant * zp,
      courant * zs, sign * zp, sign * zs, zs > 0, up, down);
  put(up, out, 2 * out_pitch);
  put(down, out + out_pitch, 2 * out_pitch);
}

template <int Order, int D, class Real>
void reconstruct_curvilinear_across(std::int64_t n, Real scale, const CurvilinearFields<const Real>& fields,
                                    const MaterialRows<Real>& material, const CurvilinearAcross<Real>& metric,
                                    OutgoingWaves<Real> outgoing) {
  const Real sign = scale < 0 ? Real(-1) : Real(1), size = sign * scale;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  const Real* __restrict field = fields.first, * __restrict stretch = metric.stretch;
  const Real* __restrict half_n = metric.half_n, * __restrict over_face = metric.over_face;
  const std::int64_t pitch = fields.pitch, stride = fields.stride;
  const std::int64_t of_metric = metric.pitch, next = metric.stride, out_pitch = outgoing.pitch;
  Real* __restrict out = outgoing.first;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i)
    reconstruct_curvilinear_at<Order, D>(field + i, pitch, stride, half_n + i, over_face + i, of_metric, next,
                                         size * b[i] * stretch[i], sign, zp[i], zs[i], out + i, out_pitch);
}

/// Whether a cell is fluid, as a factor.
template <class Real>
[[gnu::always_inline]] inline Real is_fluid(Real zp, Real zs) {
  return (zs > 0 ? Real(0) : Real(1)) * (zp > 0 ? Real(1) : Real(0));
}

/// The Riemann solution (E8) along and across the normal of a curvilinear face from waves that
/// outgoing_wave() resolved: velocities as the cell below the face sees them and tractions. In fluid the
/// velocity along the face is that of the cells (F7), and other for the cell above it.
template <bool Fluid, class Real>
[[gnu::always_inline]] inline void solve_curvilinear_at(CurvilinearFace<2, Real> face, RowVector<2, Real> up,
                                                        RowVector<2, Real> down, Real sign,
                                                        const Real* cell_lo, const Real* cell_hi,
                                                        std::int64_t pitch, Real p_lo, Real p_hi, Real s_lo,
                                                        Real s_hi, Real* first, std::int64_t first_pitch,
                                                        Real* seen_above, std::int64_t seen_pitch) {
  const Real nx = face.normal.x, over = face.over;
  // 1/|N| times 1/(Z_lo + Z_hi), with one division for both.
  const Real sum_p = p_lo + p_hi + Real(none), sum_s = s_lo + s_hi + Real(none),
             both = over / (sum_p * sum_s);
  Real v_n, t_n, v_t, t_t;
  riemann(up.z, down.z, p_lo, p_hi, both * sum_s, v_n, t_n);
  riemann(up.x, down.x, s_lo, s_hi, both * sum_p, v_t, t_t);
  v_n *= over, v_t *= over;
  Real t_lo = v_t;
  if constexpr (Fluid) {
    const auto own_lo = row_velocity<2>(cell_lo, pitch), own_hi = row_velocity<2>(cell_hi, pitch);
    const Real turned = sign * (over * over);
    const Real along_lo = turned * (own_lo.x - nx * own_lo.z), along_hi = turned * (own_hi.x - nx * own_hi.z);
    const Real fluid_lo = is_fluid(p_lo, s_lo), fluid_hi = is_fluid(p_hi, s_hi);
    const Real mixed = Real(0.5) * fluid_lo * fluid_hi * (along_hi - along_lo);
    t_lo = (1 - fluid_lo) * v_t + fluid_lo * (along_lo + mixed);
    const Real t_hi = (1 - fluid_hi) * v_t + fluid_hi * (along_hi - mixed);
    seen_above[0] = v_n - nx * t_hi;
    seen_above[seen_pitch] = nx * v_n + t_hi;
  }
  first[0] = v_n - nx * t_lo;
  first[first_pitch] = t_n - nx * t_t;
  first[2 * first_pitch] = nx * v_n + t_lo;
  first[3 * first_pitch] = nx * t_n + t_t;
}
template <bool Fluid, class Real>
[[gnu::always_inline]] inline void solve_curvilinear_at(CurvilinearFace<3, Real> face, RowVector<3, Real> up,
                                                        RowVector<3, Real> down, Real sign,
                                                        const Real* cell_lo, const Real* cell_hi,
                                                        std::int64_t pitch, Real p_lo, Real p_hi, Real s_lo,
                                                        Real s_hi, Real* first, std::int64_t first_pitch,
                                                        Real* seen_above, std::int64_t seen_pitch) {
  const auto normal = face.normal;
  const Real over = face.over, inverse = over * over;
  Real share_p, share_s, v_p, t_p;
  riemann_shares<true>(p_lo, p_hi, s_lo, s_hi, share_p, share_s);
  const Real p_up = inverse * dot(normal, up), p_down = inverse * dot(normal, down);
  riemann(p_up, p_down, p_lo, p_hi, share_p, v_p, t_p);
  const auto up_s = up - p_up * normal, down_s = down - p_down * normal;
  const auto v_s = (over * share_s) * (up_s + down_s);
  const auto of_p = (over * v_p) * normal;
  put(t_p * normal + share_s * (s_lo * down_s - s_hi * up_s), first + first_pitch, 2 * first_pitch);
  if constexpr (Fluid) {
    const auto own_lo = sign * row_velocity<3>(cell_lo, pitch),
               own_hi = sign * row_velocity<3>(cell_hi, pitch);
    const auto along_lo = own_lo - (inverse * dot(normal, own_lo)) * normal;
    const auto along_hi = own_hi - (inverse * dot(normal, own_hi)) * normal;
    const Real fluid_lo = is_fluid(p_lo, s_lo), fluid_hi = is_fluid(p_hi, s_hi);
    const auto mixed = (Real(0.5) * fluid_lo * fluid_hi) * (along_hi - along_lo);
    put(of_p + ((1 - fluid_lo) * v_s + fluid_lo * (along_lo + mixed)), first, 2 * first_pitch);
    put(of_p + ((1 - fluid_hi) * v_s + fluid_hi * (along_hi - mixed)), seen_above, seen_pitch);
  } else {
    put(of_p + v_s, first, 2 * first_pitch);
  }
}

template <bool Fluid, int D, class Real>
void solve_curvilinear_across(std::int64_t n, Real sign, const CurvilinearSolve<Real>& at) {
  const Real* __restrict p_lo = at.lo.zp, * __restrict p_hi = at.hi.zp, * __restrict s_lo = at.lo.zs, * __restrict s_hi = at.hi.zs;
  const Real* __restrict up = at.below.first, * __restrict down = at.above.first + at.above.pitch;
  const Real* __restrict cell_lo = at.fields_lo.first, * __restrict cell_hi = at.fields_hi.first;
  const Real* __restrict half_n = at.metric.half_n, * __restrict over_face = at.metric.over_face;
  const std::int64_t up_pitch = 2 * at.below.pitch, down_pitch = 2 * at.above.pitch,
                     cells = at.fields_lo.pitch;
  const std::int64_t of_metric = at.metric.pitch, face_pitch = at.faces.pitch, seen_pitch = at.seen_pitch;
  Real* __restrict face = at.faces.first, * __restrict seen_above = at.seen_above;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i)
    solve_curvilinear_at<Fluid>(CurvilinearFace<D, Real>{face_normal<D>(half_n + i, of_metric), over_face[i]},
                                take<D>(up + i, up_pitch), take<D>(down + i, down_pitch), sign, cell_lo + i,
                                cell_hi + i, cells, p_lo[i], p_hi[i], s_lo[i], s_hi[i], face + i, face_pitch,
                                seen_above + i, seen_pitch);
}

/// (F5) of one cell: rho J v += dt/h [T*], s += C : sym(N [v*]) dt/(h J), from velocities and tractions
/// before and behind it; v_lo is what this cell sees.
template <int D, class Real>
[[gnu::always_inline]] inline void update_curvilinear_at(Real scale, Real size, Real b, Real zp, Real zs,
                                                         RowVector<D, Real> normal, RowVector<D, Real> v_lo,
                                                         RowVector<D, Real> v_hi, RowVector<D, Real> t_lo,
                                                         RowVector<D, Real> t_hi, Real* f, std::int64_t p) {
  Real moved, p_modulus, mu;
  update_coefficients<true>(scale, size, b, zp, zs, moved, p_modulus, mu);
  const Real lambda = p_modulus - 2 * mu;
  const auto d = v_hi - v_lo;
  const auto dt = moved * (t_hi - t_lo);
  const Real nx = normal.x;
  if constexpr (D == 2) {
    f[0] += dt.x;
    f[p] += dt.z;
    const Real along = nx * d.x;
    // One product after the other: each is added in one instruction.
    f[2 * p] = f[2 * p] + lambda * d.z + p_modulus * along;
    f[3 * p] = f[3 * p] + p_modulus * d.z + lambda * along;
    f[4 * p] += mu * (nx * d.z + d.x);
  } else {
    const Real ny = normal.y;
    f[0] += dt.x;
    f[p] += dt.y;
    f[2 * p] += dt.z;
    const Real trace = lambda * (nx * d.x + ny * d.y + d.z);
    f[3 * p] += trace + 2 * mu * (nx * d.x);
    f[4 * p] += trace + 2 * mu * (ny * d.y);
    f[5 * p] += trace + 2 * mu * d.z;
    f[6 * p] += mu * (nx * d.y + ny * d.x);
    f[7 * p] += mu * (nx * d.z + d.x);
    f[8 * p] += mu * (ny * d.z + d.y);
  }
}

template <int D, class Real>
void update_curvilinear_across(std::int64_t n, Real scale, const CurvilinearUpdate<Real>& of) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict b = of.material.b, * __restrict zp = of.material.zp, * __restrict zs = of.material.zs;
  const Real* __restrict v_lo = of.v_lo, * __restrict v_hi = of.hi.first, * __restrict t_lo = of.lo.first + of.lo.pitch;
  const Real* __restrict t_hi = of.hi.first + of.hi.pitch;
  const Real* __restrict over_j = of.metric.over_j, * __restrict half_done = of.metric.half_n;
  const std::int64_t v_pitch = of.v_lo_pitch, hi = 2 * of.hi.pitch, lo = 2 * of.lo.pitch, p = of.fields.pitch;
  const std::int64_t of_metric = of.metric.pitch, next = of.metric.stride;
  Real* __restrict f = of.fields.first;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i)
    update_curvilinear_at<D>(scale, size, over_j[i] * b[i], zp[i], zs[i],
                             cell_normal<D>(half_done + i, of_metric, next), take<D>(v_lo + i, v_pitch),
                             take<D>(v_hi + i, hi), take<D>(t_lo + i, lo), take<D>(t_hi + i, hi), f + i, p);
}

/// The solution at a face and the update of another row in one loop: the same bits as both loops.
template <bool Fluid, int D, class Real>
void advance_curvilinear_across(std::int64_t n, Real scale, const CurvilinearSolve<Real>& at,
                                const CurvilinearUpdate<Real>& of) {
  const Real sign = scale < 0 ? Real(-1) : Real(1), size = sign * scale;
  const Real* __restrict p_lo = at.lo.zp, * __restrict p_hi = at.hi.zp, * __restrict s_lo = at.lo.zs, * __restrict s_hi = at.hi.zs;
  const Real* __restrict up = at.below.first, * __restrict down = at.above.first + at.above.pitch;
  const Real* __restrict cell_lo = at.fields_lo.first, * __restrict cell_hi = at.fields_hi.first;
  const Real* __restrict half_n = at.metric.half_n, * __restrict over_face = at.metric.over_face;
  const std::int64_t up_pitch = 2 * at.below.pitch, down_pitch = 2 * at.above.pitch,
                     cells = at.fields_lo.pitch;
  const std::int64_t of_metric = at.metric.pitch, next = at.metric.stride, face_pitch = at.faces.pitch,
                     seen_pitch = at.seen_pitch;
  Real* __restrict face = at.faces.first, * __restrict seen_above = at.seen_above;
  const Real* __restrict b = of.material.b, * __restrict zp = of.material.zp, * __restrict zs = of.material.zs;
  const Real* __restrict v_lo = of.v_lo, * __restrict v_hi = of.hi.first, * __restrict t_lo = of.lo.first + of.lo.pitch;
  const Real* __restrict t_hi = of.hi.first + of.hi.pitch;
  const Real* __restrict over_j = of.metric.over_j, * __restrict half_done = of.metric.half_n;
  const std::int64_t v_pitch = of.v_lo_pitch, hi = 2 * of.hi.pitch, lo = 2 * of.lo.pitch, p = of.fields.pitch;
  Real* __restrict f = of.fields.first;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    solve_curvilinear_at<Fluid>(CurvilinearFace<D, Real>{face_normal<D>(half_n + i, of_metric), over_face[i]},
                                take<D>(up + i, up_pitch), take<D>(down + i, down_pitch), sign, cell_lo + i,
                                cell_hi + i, cells, p_lo[i], p_hi[i], s_lo[i], s_hi[i], face + i, face_pitch,
                                seen_above + i, seen_pitch);
    update_curvilinear_at<D>(scale, size, over_j[i] * b[i], zp[i], zs[i],
                             cell_normal<D>(half_done + i, of_metric, next), take<D>(v_lo + i, v_pitch),
                             take<D>(v_hi + i, hi), take<D>(t_lo + i, lo), take<D>(t_hi + i, hi), f + i, p);
  }
}

template <int Order, int D, class Real>
constexpr CurvilinearKernels<Real> curvilinear_kernels = {
    reconstruct_curvilinear_along<Order, D, Real>,
    solve_curvilinear_along<D, Real>,
    update_curvilinear_along<D, Real>,
    reconstruct_curvilinear_across<Order, D, Real>,
    {solve_curvilinear_across<false, D, Real>, solve_curvilinear_across<true, D, Real>},
    update_curvilinear_across<D, Real>,
    {advance_curvilinear_across<false, D, Real>, advance_curvilinear_across<true, D, Real>}};

}  // namespace
}  // namespace slipwave::solver
