// SPDX-License-Identifier: BSD-3-Clause
// The inner loops, compiled once for each instruction set: CMake sets SLIPWAVE_LEVEL to its name. Nothing
// from the standard library may be instantiated here: the linker could keep this copy for everybody.
#include "solver/kernels/cell_formulas.hpp"
#include "solver/kernels/curvilinear_rows.hpp"
#include "solver/kernels/fused_row.hpp"
#include "solver/kernels/kernel_tables.hpp"

namespace slipwave::solver {

// Of the same level, in slip_level.cpp.
const SlipTables<float>& SLIPWAVE_SLIP_LEVEL(float);
const SlipTables<double>& SLIPWAVE_SLIP_LEVEL(double);
// In relaxation_level.cpp.
const RelaxationTables<float>& SLIPWAVE_RELAXATION_LEVEL(float);
const RelaxationTables<double>& SLIPWAVE_RELAXATION_LEVEL(double);
// In series_level.cpp.
const SeriesKernels<float>& SLIPWAVE_SERIES_LEVEL(float);
const SeriesKernels<double>& SLIPWAVE_SERIES_LEVEL(double);

namespace {

// In a uniform run (Uniform) only the material of the first cell is read, before the loop: what depends on it
// alone is then computed there, too. Elsewhere that value is read in vain.

template <int Order, bool Uniform, int Sign, class Real>
void reconstruct_in(std::int64_t n, std::int64_t stride, const Real* __restrict v, const Real* __restrict s,
                    const Real* __restrict impedance, const Real* __restrict b, Real size,
                    Real* __restrict up, Real* __restrict down) {
  const Real z0 = impedance[0], b0 = b[0];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real z = Uniform ? z0 : impedance[i], b_i = Uniform ? b0 : b[i];
    reconstruct_cell<Order>(v + i, s + i, stride, Sign * z, size * (z * b_i), up[i], down[i]);
  }
}

template <int Order, bool Uniform, class Real>
void reconstruct(std::int64_t n, std::int64_t stride, const Real* v, const Real* s, const Real* impedance,
                 const Real* b, Real scale, Real* up, Real* down) {
  if (scale < 0)
    reconstruct_in<Order, Uniform, -1>(n, stride, v, s, impedance, b, -scale, up, down);
  else
    reconstruct_in<Order, Uniform, 1>(n, stride, v, s, impedance, b, scale, up, down);
}

template <class Real>
void limit(std::int64_t n, std::int64_t stride, const Real* __restrict v, const Real* __restrict s,
           std::int64_t z_stride, const Real* __restrict impedance, const Real* __restrict b, Real scale,
           Real* __restrict up, Real* __restrict down) {
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i)
    limit_cell(v + i, s + i, stride, impedance + i, z_stride, scale * (impedance[i] * b[i]), up[i], down[i]);
}

/// For the P pair and so many S pairs; Split: the second has an impedance of its own.
template <bool Uniform, int Shears, bool Split, class Real>
void solve_riemann(std::int64_t n, OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                   const MaterialRows<Real>& lo, const MaterialRows<Real>& hi, InterfaceStates<Real> faces) {
  const Real *zp_lo = lo.zp, *zp_hi = hi.zp, *zs_lo = lo.zs, *zs_hi = hi.zs;
  const Real zp_lo0 = zp_lo[0], zp_hi0 = zp_hi[0], zs_lo0 = zs_lo[0], zs_hi0 = zs_hi[0];
  const Real *zs2_lo = Split ? lo.zs2 : zs_lo, *zs2_hi = Split ? hi.zs2 : zs_hi;
  const Real zs2_lo0 = zs2_lo[0], zs2_hi0 = zs2_hi[0];
  const Real* __restrict up_p = below.up(0), * __restrict down_p = above.down(0);
  const Real* __restrict up_s = below.up(1), * __restrict down_s = above.down(1);
  const Real* __restrict up_s2 = below.up(2), * __restrict down_s2 = above.down(2);
  Real* __restrict v_p = faces.v(0), * __restrict s_p = faces.s(0);
  Real* __restrict v_s = faces.v(1), * __restrict s_s = faces.s(1);
  Real* __restrict v_s2 = faces.v(2), * __restrict s_s2 = faces.s(2);
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real p_lo = Uniform ? zp_lo0 : zp_lo[i], p_hi = Uniform ? zp_hi0 : zp_hi[i];
    const Real s_lo = Uniform ? zs_lo0 : zs_lo[i], s_hi = Uniform ? zs_hi0 : zs_hi[i];
    Real share_p, share_s;
    riemann_shares<(Shears > 0)>(p_lo, p_hi, s_lo, s_hi, share_p, share_s);
    riemann(up_p[i], down_p[i], p_lo, p_hi, share_p, v_p[i], s_p[i]);
    if constexpr (Shears > 0) riemann(up_s[i], down_s[i], s_lo, s_hi, share_s, v_s[i], s_s[i]);
    if constexpr (Shears > 1 && !Split) riemann(up_s2[i], down_s2[i], s_lo, s_hi, share_s, v_s2[i], s_s2[i]);
    if constexpr (Shears > 1 && Split) {
      const Real s2_lo = Uniform ? zs2_lo0 : zs2_lo[i], s2_hi = Uniform ? zs2_hi0 : zs2_hi[i];
      riemann(up_s2[i], down_s2[i], s2_lo, s2_hi, 1 / (s2_lo + s2_hi + Real(none)), v_s2[i], s_s2[i]);
    }
  }
}

/// Coupled: passive stresses take what MaterialRows says instead of lambda. Without shear there is none:
/// all normal stresses are one.
template <bool Uniform, int D, bool Shear, bool Coupled, class Real>
void update(std::int64_t n, Real scale, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
            const MaterialRows<Real>& material, const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v(0), * __restrict s_lo = lo.s(0), * __restrict w_lo = lo.v(1), * __restrict t_lo = lo.s(1);
  const Real* __restrict v_hi = hi.v(0), * __restrict s_hi = hi.s(0), * __restrict w_hi = hi.v(1), * __restrict t_hi = hi.s(1);
  const Real* __restrict w2_lo = lo.v(2), * __restrict t2_lo = lo.s(2), * __restrict w2_hi = hi.v(2), * __restrict t2_hi = hi.s(2);
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  const Real b0 = b[0], zp0 = zp[0], zs0 = zs[0];
  const Real* __restrict coupling = material.coupling;
  const Real coupling0 = Coupled ? coupling[0] : Real(0);
  constexpr bool In3D = Coupled && D == 3;
  const Real* __restrict zs2 = material.zs2, * __restrict coupling2 = material.coupling2;
  const Real zs20 = In3D ? zs2[0] : Real(0), coupling20 = In3D ? coupling2[0] : Real(0);
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict passive2 = rows.passive2;
  Real* __restrict vt = rows.vt, * __restrict st = rows.st, * __restrict vt2 = rows.vt2, * __restrict st2 = rows.st2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real b_i = Uniform ? b0 : b[i], zp_i = Uniform ? zp0 : zp[i], zs_i = Uniform ? zs0 : zs[i];
    Real moved, p_modulus, s_modulus, along;
    update_coefficients<Shear>(scale, size, b_i, zp_i, zs_i, moved, p_modulus, s_modulus);
    if constexpr (Coupled)
      update_coupled_p(v_hi[i] - v_lo[i], s_hi[i] - s_lo[i], moved, p_modulus,
                       size * b_i * (Uniform ? coupling0 : coupling[i]), v[i], s[i], along);
    else
      update_p<Shear>(v_hi[i] - v_lo[i], s_hi[i] - s_lo[i], moved, p_modulus, s_modulus, v[i], s[i], along);
    if constexpr (Shear) passive[i] += along;
    if constexpr (Shear) update_s(w_hi[i] - w_lo[i], t_hi[i] - t_lo[i], moved, s_modulus, vt[i], st[i]);
    if constexpr (In3D)
      second_pair(size * b_i, Uniform ? zs20 : zs2[i], Uniform ? coupling20 : coupling2[i], v_hi[i] - v_lo[i],
                  s_modulus, along);
    if constexpr (Shear && D == 3) {
      passive2[i] += along;
      update_s(w2_hi[i] - w2_lo[i], t2_hi[i] - t2_lo[i], moved, s_modulus, vt2[i], st2[i]);
    }
  }
}

/// (E8) and (E9) in one, (E9a): in a cell whose neighbours have its material.
template <int D, bool Shear, bool Coupled, class Real>
void update_uniform(std::int64_t n, Real scale, OutgoingWaves<Real> below, OutgoingWaves<Real> here,
                    OutgoingWaves<Real> above, const MaterialRows<Real>& material,
                    const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale, b = material.b[0], zp = material.zp[0];
  const Real zs = Shear ? material.zs[0] : Real(0), moved = Real(0.5) * (scale * b), strained = size * b;
  const Real p_modulus = strained * zp * zp, s_modulus = strained * zs * zs;
  const Real along = Coupled ? strained * material.coupling[0] : p_modulus - 2 * s_modulus;
  // Divided first, as at faces: in front of the waves velocities that are too small become zero.
  const Real over_zp = Real(0.5) / zp, over_zs = zs > 0 ? Real(0.5) / zs : Real(0);
  // A fluid carries no shear.
  const Real moved_s = zs > 0 ? moved : Real(0);
  constexpr bool In3D = Coupled && D == 3;
  const Real zs2 = In3D ? material.zs2[0] : zs, s_modulus2 = In3D ? strained * zs2 * zs2 : s_modulus,
             over_zs2 = In3D && zs2 > 0 ? Real(0.5) / zs2 : over_zs,
             along2 = In3D ? strained * material.coupling2[0] : along;
  const Real* __restrict up_lo = below.up(0), * __restrict up = here.up(0), * __restrict down = here.down(0), * __restrict down_hi = above.down(0);
  const Real* __restrict sup_lo = below.up(1), * __restrict sup = here.up(1), * __restrict sdown = here.down(1), * __restrict sdown_hi = above.down(1);
  const Real* __restrict tup_lo = below.up(2), * __restrict tup = here.up(2), * __restrict tdown = here.down(2), * __restrict tdown_hi = above.down(2);
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict passive2 = rows.passive2;
  Real* __restrict vt = rows.vt, * __restrict st = rows.st, * __restrict vt2 = rows.vt2, * __restrict st2 = rows.st2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real ups = up[i] - up_lo[i], downs = down_hi[i] - down[i], dv = (downs + ups) * over_zp;
    v[i] += moved * (downs - ups);
    s[i] += p_modulus * dv;
    if constexpr (Shear) passive[i] += along * dv;
    if constexpr (Shear && D == 3) passive2[i] += along2 * dv;
    if constexpr (Shear) {
      const Real s_ups = sup[i] - sup_lo[i], s_downs = sdown_hi[i] - sdown[i];
      vt[i] += moved_s * (s_downs - s_ups);
      st[i] += s_modulus * ((s_downs + s_ups) * over_zs);
    }
    if constexpr (Shear && D == 3) {
      const Real t_ups = tup[i] - tup_lo[i], t_downs = tdown_hi[i] - tdown[i];
      vt2[i] += moved_s * (t_downs - t_ups);
      st2[i] += s_modulus2 * ((t_downs + t_ups) * over_zs2);
    }
  }
}

template <bool Along, bool Recent, class Real>
void damp(std::int64_t n, const PmlFactors<Real>& factors, const PmlDamping<Real>& damping,
          const Real* __restrict before, Real* __restrict u, Real* __restrict phi, Real* __restrict recent) {
  const Real *after = factors.after, *of_increments = factors.of_increments, *left = factors.left,
             *of_recent = factors.of_recent, *of_newest = factors.of_newest,
             *recent_left = factors.recent_left, *in_thick_plates = factors.lost_in_thick_plates,
             *growing = factors.lost_growing;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t f = Along ? i : 0;
    const std::int64_t of = Along ? 0 : i;
    const Real old = phi[i], increment = u[i] - before[i];
    u[i] = (u[i] - after[f] * old - of_increments[f] * increment) * (1 - damping.growing[of] * growing[f]) *
           (1 - damping.in_thick_plates[of] * in_thick_plates[f]);
    if constexpr (Recent) {
      phi[i] = left[f] * old + of_recent[f] * recent[i] + of_newest[f] * increment;
      recent[i] = recent_left[f] * recent[i] + increment - 2 * after[f] * old;
    } else {
      phi[i] = left[f] * old + increment;
    }
  }
}

template <bool Along, class Real>
void prepare(std::int64_t n, const PmlFactors<Real>& factors, Real* __restrict u,
             const Real* __restrict phi) {
  const Real* before = factors.before;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) u[i] -= before[Along ? i : 0] * phi[i];
}

template <class Real>
void interpolate(std::int64_t n, const float* samples, std::int64_t count, double place, double step,
                 std::int64_t first, Real* __restrict to) {
  const double last = double(count - 6);
  constexpr Real over_12 = Real(1) / 12, over_24 = Real(1) / 24, over_120 = Real(1) / 120;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    // That of the first of the six samples.
    const double from = place + double(first + i) * step - 2;
    const bool inside = from >= 0 && from < last + 1;
    const double clipped = inside ? from : 0;
    const int begin = int(clipped);
    const Real x = Real(clipped - double(begin)) + 2;
    const float* const u = samples + begin;
    const Real d0 = x, d1 = x - 1, d2 = x - 2, d3 = x - 3, d4 = x - 4, d5 = x - 5;
    const Real d01 = d0 * d1, d23 = d2 * d3, d45 = d4 * d5;
    const Real value = d23 * d45 * (d0 * Real(u[1]) * over_24 - d1 * Real(u[0]) * over_120) +
                       d01 * d45 * (d2 * Real(u[3]) - d3 * Real(u[2])) * over_12 +
                       d01 * d23 * (d4 * Real(u[5]) * over_120 - d5 * Real(u[4]) * over_24);
    to[i] = inside ? value : 0;
  }
}

template <bool Uniform, int D, bool Shear, bool Coupled, class Real>
constexpr InterfaceKernels<Real> face = {solve_riemann<Uniform, Shear ? D - 1 : 0, Coupled && D == 3, Real>,
                                         update<Uniform, D, Shear, Coupled, Real>,
                                         update_uniform<D, Shear, Coupled, Real>};

template <int Order, bool Uniform, class Real>
constexpr Kernels<Real> table = {reconstruct<Order, Uniform, Real>,
                                 limit<Real>,
                                 {face<Uniform, 2, true, false, Real>, face<Uniform, 3, true, false, Real>},
                                 face<Uniform, 2, false, false, Real>,
                                 {face<Uniform, 2, true, true, Real>, face<Uniform, 3, true, true, Real>},
                                 {Uniform ? nullptr : fused_row<Order, 1, false, Real>,
                                  Uniform ? nullptr : fused_row<Order, 2, false, Real>},
                                 {Uniform ? nullptr : fused_row<Order, 1, true, Real>,
                                  Uniform ? nullptr : fused_row<Order, 2, true, Real>},
                                 Uniform ? nullptr : fused_row<Order, 0, false, Real>,
                                 {curvilinear_kernels<Order, 2, Real>, curvilinear_kernels<Order, 3, Real>}};

/// Returns the kernels of that order, searched from the N-th order of the list on; null where it has none.
template <bool Uniform, class Real, int N = 0>
const Kernels<Real>* of_order(int order) {
  if constexpr (N < order_count)
    return order == orders[N] ? &table<orders[N], Uniform, Real> : of_order<Uniform, Real, N + 1>(order);
  else
    return nullptr;
}

template <class Real>
constexpr KernelTables<Real> tables = {of_order<false, Real>,
                                       of_order<true, Real>,
                                       {{damp<true, false, Real>, damp<true, true, Real>},
                                        {damp<false, false, Real>, damp<false, true, Real>},
                                        prepare<true, Real>,
                                        prepare<false, Real>},
                                       interpolate<Real>,
                                       SLIPWAVE_SLIP_LEVEL,
                                       SLIPWAVE_RELAXATION_LEVEL,
                                       SLIPWAVE_SERIES_LEVEL};

}  // namespace

// SLIPWAVE_LEVEL is the name of this instruction set's entry points: kernels_x86_64_v3 and so on.
const KernelTables<float>& SLIPWAVE_LEVEL(float) { return tables<float>; }
const KernelTables<double>& SLIPWAVE_LEVEL(double) { return tables<double>; }

}  // namespace slipwave::solver
