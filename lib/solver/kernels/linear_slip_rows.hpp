// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/linear_slip_kernels.hpp"
#include "solver/kernels/resolved_traction.hpp"

/// Row loops of linear slip (docs/theory.md (S20), (S22)). For slip_level.cpp only: compiled once for each
/// instruction set.
namespace slipwave::solver {
namespace {

// Components have names instead of numbers: compilers make no vectors of loops that hold arrays.

/// Stress of a cell; in 2-D its last three components are 0.
template <class Real>
struct CellStress {
  Real s0, s1, s2, s3, s4, s5;
};

template <int D, class Real>
struct StressRows {
  Real* __restrict const r0;
  Real* __restrict const r1;
  Real* __restrict const r2;
  Real* __restrict const r3;
  Real* __restrict const r4;
  Real* __restrict const r5;
  [[gnu::always_inline]] explicit StressRows(const LinearSlipRows<Real>& rows)
      : r0(rows.stress),
        r1(r0 + rows.pitch),
        r2(r1 + rows.pitch),
        r3(D == 2 ? r2 : r2 + rows.pitch),
        r4(D == 2 ? r2 : r3 + rows.pitch),
        r5(D == 2 ? r2 : r4 + rows.pitch) {}
  [[gnu::always_inline]] CellStress<Real> of(std::int64_t i) const {
    if constexpr (D == 2)
      return {r0[i], r1[i], r2[i], 0, 0, 0};
    else
      return {r0[i], r1[i], r2[i], r3[i], r4[i], r5[i]};
  }
  [[gnu::always_inline]] void set(std::int64_t i, const CellStress<Real>& s) const {
    r0[i] = s.s0, r1[i] = s.s1, r2[i] = s.s2;
    if constexpr (D == 3) r3[i] = s.s3, r4[i] = s.s4, r5[i] = s.s5;
  }
};

template <int D, class Real>
[[gnu::always_inline]] inline Real resolved(const Real* weights, Real diagonal, const CellStress<Real>& s) {
  return projected<D>(weights, diagonal, s.s0, s.s1, s.s2, s.s3, s.s4, s.s5);
}

/// What strain of one family that takes off0, off1 and off2 off its traction leaves of the stress s.
template <int D, class Real>
[[gnu::always_inline]] inline CellStress<Real> stress_left(const OneSystem<D, Real>& family,
                                                           const CellStress<Real>& s, Real lambda_share,
                                                           Real off0, Real off1, Real off2) {
  const Real even = lambda_share * off0, across = off0 - even;
  // `normal` counts off-diagonal components twice.
  const Real along = Real(0.5) * across, *const normal = family.normal;
  const Real s0 = s.s0 - (even + across * normal[0] + along_planes(family, 0, off1, off2));
  const Real s1 = s.s1 - (even + across * normal[1] + along_planes(family, 1, off1, off2));
  if constexpr (D == 2)
    return {s0, s1, s.s2 - (along * normal[2] + along_planes(family, 2, off1, off2)), 0, 0, 0};
  else
    return {s0,
            s1,
            s.s2 - (even + across * normal[2] + along_planes(family, 2, off1, off2)),
            s.s3 - (along * normal[3] + along_planes(family, 3, off1, off2)),
            s.s4 - (along * normal[4] + along_planes(family, 4, off1, off2)),
            s.s5 - (along * normal[5] + along_planes(family, 5, off1, off2))};
}

/// Memory and coefficients of component k of the traction of one family.
template <int D, bool Damped, bool Slides, class Real>
struct TractionRows {
  Real* __restrict const taken;
  Real* __restrict const change;
  Real* __restrict const of_dashpot;
  Real* __restrict const at_end;  // the traction along planes that slide
  const Real* __restrict const of_end;
  const Real* __restrict const left;
  const Real* __restrict const of_start;
  const Real* __restrict const follows;
  Real ahead;
  [[gnu::always_inline]] TractionRows(const LinearSlipRows<Real>& rows, int k)
      : taken(rows.memory + k * rows.pitch_of_rows),
        change(taken + D * rows.pitch_of_rows),
        of_dashpot(Damped ? change + D * rows.pitch_of_rows : taken),
        at_end(Slides && k > 0 ? taken + ((Damped ? 3 : 2) * D - 1) * rows.pitch_of_rows : taken),
        of_end(rows.coefficients + (k == 0 ? 1 : 2) * rows.pitch_of_rows),
        left(Damped ? rows.coefficients + (k == 0 ? 3 : 5) * rows.pitch_of_rows : of_end),
        of_start(Damped ? left + rows.pitch_of_rows : of_end),
        follows(Slides ? rows.coefficients + (Damped ? 7 : 3) * rows.pitch_of_rows : of_end),
        ahead(rows.ahead) {}

  /// What the end of a step takes off the traction t.
  template <bool Along>
  [[gnu::always_inline]] Real ends(Real t, std::int64_t i) const {
    const Real r = taken[i], welded = t + r;
    Real now = of_end[i] * welded;
    if constexpr (Damped) now += of_dashpot[i];
    const Real off = now - r;
    change[i] = off + ahead * change[i];
    taken[i] = now;
    if constexpr (Along && Slides) at_end[i] = welded - now;
    return off;
  }
  /// What the beginning of the next one does.
  template <bool Along>
  [[gnu::always_inline]] Real begins(Real t, std::int64_t i) const {
    Real r = taken[i];
    if constexpr (Along && Slides) r += follows[i] * (t - at_end[i]);
    if constexpr (Damped) of_dashpot[i] = left[i] * r + of_start[i] * (t + r);
    const Real off = ahead * change[i];
    taken[i] = r + off;
    return off;
  }
  template <bool Ends, bool Along>
  [[gnu::always_inline]] Real acts(Real t, std::int64_t i) const {
    if constexpr (Ends)
      return ends<Along>(t, i);
    else
      return begins<Along>(t, i);
  }
};

/// One family, at the end of a step or at the beginning of the next.
template <bool Ends, int D, bool Damped, bool Slides, class Real>
[[gnu::noinline]] void family_acts(std::int64_t n, const SlipPlanes<Real>& planes,
                                   const LinearSlipRows<Real>& rows) {
  using Rows = TractionRows<D, Damped, Slides, Real>;
  const OneSystem<D, Real> family(planes);
  const StressRows<D, Real> stress(rows);
  const Rows normal(rows, 0), along1(rows, 1), along2(rows, D - 1);
  const Real* __restrict const lambda_shares = rows.coefficients;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const auto s = stress.of(i);
    const Real off0 = normal.template acts<Ends, false>(resolved<D>(family.normal, Real(1), s), i);
    const Real off1 = along1.template acts<Ends, true>(resolved<D>(family.m1, Real(0.5), s), i);
    Real off2 = 0;
    if constexpr (D == 3) off2 = along2.template acts<Ends, true>(resolved<D>(family.m2, Real(0.5), s), i);
    stress.set(i, stress_left(family, s, lambda_shares[i], off0, off1, off2));
  }
}

/// Memory of component c of the stress, where several families cross, and its row of the matrices.
template <int D, class Real>
struct CrossingRows {
  Real* __restrict const taken;
  Real* __restrict const change;
  const Real* __restrict const of_welded;
  const Real* __restrict const of_stress;
  std::int64_t next;
  Real ahead;
  [[gnu::always_inline]] CrossingRows(const LinearSlipRows<Real>& rows, int c)
      : taken(rows.memory + c * rows.pitch_of_rows),
        change(taken + components * rows.pitch_of_rows),
        of_welded(rows.coefficients + c * components * rows.pitch_of_rows),
        of_stress(of_welded + components * components * rows.pitch_of_rows),
        next(rows.pitch_of_rows),
        ahead(rows.ahead) {}

  [[gnu::always_inline]] Real product(const Real* row, const CellStress<Real>& s, std::int64_t i) const {
    const Real three = row[i] * s.s0 + row[next + i] * s.s1 + row[2 * next + i] * s.s2;
    if constexpr (D == 2)
      return three;
    else
      return three + (row[3 * next + i] * s.s3 + row[4 * next + i] * s.s4 + row[5 * next + i] * s.s5);
  }
  /// What the end of a step takes off the stress, by that of welded planes, or the beginning of the next one,
  /// by the stress itself.
  template <bool Ends, bool Slides>
  [[gnu::always_inline]] Real acts(const CellStress<Real>& by, std::int64_t i) const {
    if constexpr (Ends) {
      const Real now = product(of_welded, by, i), off = now - taken[i];
      change[i] = off + ahead * change[i];
      taken[i] = now;
      return off;
    }
    const Real off = ahead * change[i];
    if constexpr (Slides)
      taken[i] = product(of_stress, by, i) + off;
    else
      taken[i] += off;
    return off;
  }

 private:
  static constexpr int components = D == 2 ? 3 : 6;
};

/// The rows of all components; in 2-D the last three are not used.
template <int D, class Real>
struct AllCrossingRows {
  CrossingRows<D, Real> c0, c1, c2, c3, c4, c5;
  [[gnu::always_inline]] explicit AllCrossingRows(const LinearSlipRows<Real>& rows)
      : c0(rows, 0),
        c1(rows, 1),
        c2(rows, 2),
        c3(rows, D == 2 ? 2 : 3),
        c4(rows, D == 2 ? 2 : 4),
        c5(rows, D == 2 ? 2 : 5) {}
  /// The stress by which they act: at the end of a step that of welded planes.
  template <bool Ends>
  [[gnu::always_inline]] CellStress<Real> by(const CellStress<Real>& s, std::int64_t i) const {
    const auto with = [i](Real stress, const CrossingRows<D, Real>& of) __attribute__((always_inline)) {
      return Ends ? stress + of.taken[i] : stress;
    };
    return {with(s.s0, c0), with(s.s1, c1), with(s.s2, c2), with(s.s3, c3), with(s.s4, c4), with(s.s5, c5)};
  }
};

/// Several families whose planes cross: of all of them together, by components of the stress.
template <bool Ends, int D, bool Slides, class Real>
[[gnu::noinline]] void crossing_acts(std::int64_t n, const SlipPlanes<Real>&,
                                     const LinearSlipRows<Real>& rows) {
  const StressRows<D, Real> stress(rows);
  const AllCrossingRows<D, Real> of(rows);
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const auto s = stress.of(i);
    const auto by = of.template by<Ends>(s, i);
    CellStress<Real> left = {s.s0 - of.c0.template acts<Ends, Slides>(by, i),
                             s.s1 - of.c1.template acts<Ends, Slides>(by, i),
                             s.s2 - of.c2.template acts<Ends, Slides>(by, i),
                             0,
                             0,
                             0};
    if constexpr (D == 3) {
      left.s3 = s.s3 - of.c3.template acts<Ends, Slides>(by, i);
      left.s4 = s.s4 - of.c4.template acts<Ends, Slides>(by, i);
      left.s5 = s.s5 - of.c5.template acts<Ends, Slides>(by, i);
    }
    stress.set(i, left);
  }
}

template <int D, class Real, bool Damped, bool Slides>
constexpr LinearSlipKernels<Real> of_family = {family_acts<true, D, Damped, Slides, Real>,
                                               family_acts<false, D, Damped, Slides, Real>};

template <int D, class Real>
LinearSlipKernels<Real> linear_of_family(bool damped, bool slides) {
  if (damped) return slides ? of_family<D, Real, true, true> : of_family<D, Real, true, false>;
  return slides ? of_family<D, Real, false, true> : of_family<D, Real, false, false>;
}

template <class Real>
LinearSlipKernels<Real> linear_of(const LinearSlipCase& of) {
  if (of.one_family)
    return of.dimensions == 2 ? linear_of_family<2, Real>(of.damped, of.slides)
                              : linear_of_family<3, Real>(of.damped, of.slides);
  if (of.dimensions == 3) return {crossing_acts<true, 3, false, Real>, crossing_acts<false, 3, false, Real>};
  return {crossing_acts<true, 2, false, Real>,
          of.slides ? crossing_acts<false, 2, true, Real> : crossing_acts<false, 2, false, Real>};
}

}  // namespace
}  // namespace slipwave::solver
