#pragma once

#include "solver/kernels/linear_slip_kernels.hpp"
#include "solver/kernels/resolved_traction.hpp"

/// Row loops of linear slip (docs/theory.md (S20), (S22)). For slip_level.cpp only: compiled once for each
/// instruction set.
namespace slipwave::solver {
namespace {

/// Traction on the planes of one family, normal and tangential, and what stress a change of it belongs to.
template <int D, class Real>
struct Family {
  static constexpr int components = D == 2 ? 3 : 6;
  Real normal[components], m1[components], m2[components];
  [[gnu::always_inline]] explicit Family(const SlipPlanes<Real>& planes) {
    for (int c = 0; c < components; ++c) {
      normal[c] = planes.normal[0][c];
      m1[c] = planes.shear[0][c];
      m2[c] = planes.shear[D - 2][c];
    }
  }
  [[gnu::always_inline]] void traction(const Real* s, Real* t) const {
    const Real s3 = D == 2 ? Real(0) : s[3 % components], s4 = D == 2 ? Real(0) : s[4 % components],
               s5 = D == 2 ? Real(0) : s[5 % components];
    t[0] = projected<D>(normal, Real(1), s[0], s[1], s[2], s3, s4, s5);
    t[1] = projected<D>(m1, Real(0.5), s[0], s[1], s[2], s3, s4, s5);
    if constexpr (D == 3) t[2] = projected<D>(m2, Real(0.5), s[0], s[1], s[2], s3, s4, s5);
  }
  /// What strain that takes `off` the traction takes off component c of the stress; `normal` counts
  /// off-diagonal components twice.
  [[gnu::always_inline]] Real of_stress(int c, const Real* off, Real even) const {
    const Real across = even * off[0] + (1 - even) * off[0] * normal[c];
    const Real along = Real(0.5) * ((1 - even) * off[0] * normal[c]);
    const Real shear = D == 3 ? m1[c] * off[1] + m2[c] * off[D - 1] : m1[c] * off[1];
    return (c < D ? across : along) + shear;
  }
};

template <int D, bool Damped, bool Slides, class Real>
[[gnu::noinline]] void family_ends(std::int64_t n, const SlipPlanes<Real>& planes,
                                   const LinearSlipRows<Real>& rows) {
  constexpr int components = Family<D, Real>::components;
  const Family<D, Real> family(planes);
  const std::int64_t pitch = rows.pitch, next = rows.pitch_of_rows;
  Real* const stress = rows.stress;
  Real* const memory = rows.memory;
  const Real* const coefficients = rows.coefficients;
  const Real ahead = rows.ahead;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real s[components], t[D], off[D];
    for (int c = 0; c < components; ++c) s[c] = stress[c * pitch + i];
    family.traction(s, t);
    for (int k = 0; k < D; ++k) {
      const Real r = memory[k * next + i], of_end = coefficients[(k == 0 ? 1 : 2) * next + i];
      const Real welded = t[k] + r;
      Real now = of_end * welded;
      if constexpr (Damped) now += memory[(2 * D + k) * next + i];
      off[k] = now - r;
      memory[(D + k) * next + i] = off[k] + ahead * memory[(D + k) * next + i];
      memory[k * next + i] = now;
      if constexpr (Slides)
        if (k > 0) memory[((Damped ? 3 : 2) * D + k - 1) * next + i] = welded - now;
    }
    const Real even = coefficients[i];
    for (int c = 0; c < components; ++c) stress[c * pitch + i] = s[c] - family.of_stress(c, off, even);
  }
}

template <int D, bool Damped, bool Slides, class Real>
[[gnu::noinline]] void family_begins(std::int64_t n, const SlipPlanes<Real>& planes,
                                     const LinearSlipRows<Real>& rows) {
  constexpr int components = Family<D, Real>::components;
  const Family<D, Real> family(planes);
  const std::int64_t pitch = rows.pitch, next = rows.pitch_of_rows;
  Real* const stress = rows.stress;
  Real* const memory = rows.memory;
  const Real* const coefficients = rows.coefficients;
  const Real ahead = rows.ahead;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real s[components], t[D], off[D];
    for (int c = 0; c < components; ++c) s[c] = stress[c * pitch + i];
    if constexpr (Damped || Slides) family.traction(s, t);
    for (int k = 0; k < D; ++k) {
      Real r = memory[k * next + i];
      if constexpr (Slides)
        if (k > 0)
          r += coefficients[(Damped ? 7 : 3) * next + i] *
               (t[k] - memory[((Damped ? 3 : 2) * D + k - 1) * next + i]);
      if constexpr (Damped) {
        const Real left = coefficients[(k == 0 ? 3 : 5) * next + i],
                   of_start = coefficients[(k == 0 ? 4 : 6) * next + i];
        memory[(2 * D + k) * next + i] = left * r + of_start * (t[k] + r);
      }
      off[k] = ahead * memory[(D + k) * next + i];
      memory[k * next + i] = r + off[k];
    }
    const Real even = coefficients[i];
    for (int c = 0; c < components; ++c) stress[c * pitch + i] = s[c] - family.of_stress(c, off, even);
  }
}

/// Several families whose planes cross: of all of them together, by components of the stress.
template <int D, class Real>
[[gnu::noinline]] void crossing_end(std::int64_t n, const SlipPlanes<Real>&,
                                    const LinearSlipRows<Real>& rows) {
  constexpr int components = Family<D, Real>::components;
  const std::int64_t pitch = rows.pitch, next = rows.pitch_of_rows;
  Real* const stress = rows.stress;
  Real* const memory = rows.memory;
  const Real* const matrix = rows.coefficients;
  const Real ahead = rows.ahead;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real welded[components];
    for (int c = 0; c < components; ++c) welded[c] = stress[c * pitch + i] + memory[c * next + i];
    for (int c = 0; c < components; ++c) {
      Real now = 0;
      for (int k = 0; k < components; ++k) now += matrix[(c * components + k) * next + i] * welded[k];
      const Real off = now - memory[c * next + i];
      memory[(components + c) * next + i] = off + ahead * memory[(components + c) * next + i];
      memory[c * next + i] = now;
      stress[c * pitch + i] -= off;
    }
  }
}

template <int D, bool Slides, class Real>
[[gnu::noinline]] void crossing_begin(std::int64_t n, const SlipPlanes<Real>&,
                                      const LinearSlipRows<Real>& rows) {
  constexpr int components = Family<D, Real>::components;
  const std::int64_t pitch = rows.pitch, next = rows.pitch_of_rows;
  Real* const stress = rows.stress;
  Real* const memory = rows.memory;
  const Real* const matrix = rows.coefficients + components * components * next;
  const Real ahead = rows.ahead;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    Real s[components];
    for (int c = 0; c < components; ++c) s[c] = stress[c * pitch + i];
    for (int c = 0; c < components; ++c) {
      Real r = memory[c * next + i];
      if constexpr (Slides) {
        r = 0;
        for (int k = 0; k < components; ++k) r += matrix[(c * components + k) * next + i] * s[k];
      }
      const Real off = ahead * memory[(components + c) * next + i];
      memory[c * next + i] = r + off;
      stress[c * pitch + i] = s[c] - off;
    }
  }
}

template <int D, class Real>
LinearSlipKernels<Real> linear_of_family(bool damped, bool slides) {
  if (damped)
    return slides
               ? LinearSlipKernels<Real>{family_ends<D, true, true, Real>, family_begins<D, true, true, Real>}
               : LinearSlipKernels<Real>{family_ends<D, true, false, Real>,
                                         family_begins<D, true, false, Real>};
  return slides
             ? LinearSlipKernels<Real>{family_ends<D, false, true, Real>, family_begins<D, false, true, Real>}
             : LinearSlipKernels<Real>{family_ends<D, false, false, Real>,
                                       family_begins<D, false, false, Real>};
}

template <class Real>
LinearSlipKernels<Real> linear_of(const LinearSlipCase& of) {
  if (of.one_family)
    return of.dimensions == 2 ? linear_of_family<2, Real>(of.damped, of.slides)
                              : linear_of_family<3, Real>(of.damped, of.slides);
  if (of.dimensions == 3) return {crossing_end<3, Real>, crossing_begin<3, false, Real>};
  return {crossing_end<2, Real>, of.slides ? crossing_begin<2, true, Real> : crossing_begin<2, false, Real>};
}

}  // namespace
}  // namespace slipwave::solver
