// The inner loops of slip, compiled once for each instruction set as kernels_level.cpp is, under the same
// rules.
#include "solver/slip_tables.hpp"

namespace slipwave::solver {
namespace {

using slip::greater;
using slip::lesser;

/// s_n or tau of planes from the components s0.. of stress, `half` for the diagonal of shear.
template <int D, class Real>
[[gnu::always_inline]] inline Real projected(const Real* weights, Real diagonal, Real s0, Real s1, Real s2,
                                             Real s3, Real s4, Real s5) {
  if constexpr (D == 2)
    return diagonal * (weights[0] * s0 + weights[1] * s1) + weights[2] * s2;
  else
    return diagonal * (weights[0] * s0 + weights[1] * s1 + weights[2] * s2) +
           (weights[3] * s3 + weights[4] * s4 + weights[5] * s5);
}

/// Length of a traction with two components; squares neither overflow nor vanish.
template <class Real>
[[gnu::always_inline]] inline Real length(Real a, Real b) {
  const Real x = a < 0 ? -a : a, y = b < 0 ? -b : b, large = greater(x, y), small = lesser(x, y);
  const Real ratio = small / greater(large, slip::least<Real>);
  return large * Real(__builtin_sqrt(1 + ratio * ratio));
}
[[gnu::always_inline]] inline float length(float a, float b) {
  const float x = a < 0 ? -a : a, y = b < 0 ? -b : b, large = greater(x, y), small = lesser(x, y);
  const float ratio = small / greater(large, slip::least<float>);
  return large * __builtin_sqrtf(1 + ratio * ratio);
}

template <int D, SlipCorrection Correction, bool Extended, class Real>
void slip_one(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr int tangents = D - 1, last = D == 2 ? 2 : 5;
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch;
  Real* __restrict const r2 = r1 + rows.pitch, * __restrict const r3 = D == 2 ? r2 : r2 + rows.pitch;
  Real* __restrict const r4 = D == 2 ? r2 : r3 + rows.pitch, * __restrict const r5 =
                                                                 D == 2 ? r2 : r4 + rows.pitch;
  const Real* __restrict const creeps = rows.creep[0];
  Real* __restrict const ahead1 = rows.kept, * __restrict const ahead2 =
                                                 rows.kept + (tangents - 1) * rows.kept_pitch;
  // Second order: theta c less c/2. Exponential: tau and S that the step began with.
  Real* __restrict const more = rows.kept + tangents * rows.kept_pitch;
  Real* __restrict const more2 = more + (tangents - 1) * rows.kept_pitch;
  Real* __restrict const began = more + tangents * rows.kept_pitch;
  const Real* __restrict const still_n = rows.still, * __restrict const still1 =
                                                         rows.still + rows.still_pitch;
  const Real* __restrict const still2 = rows.still + tangents * rows.still_pitch;
  const Real* __restrict const gaps = rows.gap[0];
  const bool has_gap = gaps != nullptr;
  Real normal[last + 1], m1[last + 1], m2[last + 1];
  for (int c = 0; c <= last; ++c) {
    normal[c] = planes.normal[0][c];
    m1[c] = planes.shear[0][c];
    m2[c] = planes.shear[tangents - 1][c];
  }
  const Real friction = planes.friction[0], cohesion = planes.cohesion_pa[0];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real creep = creeps[i];
    Real s_n = projected<D>(normal, Real(1), s0, s1, s2, s3, s4, s5);
    Real t1 = projected<D>(m1, Real(0.5), s0, s1, s2, s3, s4, s5), t2 = 0;
    if constexpr (D == 3) t2 = projected<D>(m2, Real(0.5), s0, s1, s2, s3, s4, s5);
    if constexpr (Extended) {
      s_n += still_n[i];
      t1 += still1[i];
      if constexpr (D == 3) t2 += still2[i];
    }
    Real strength = friction * greater(-s_n, Real(0)) + cohesion;
    if constexpr (Extended) strength = has_gap && gaps[has_gap ? i : 0] > 0 ? Real(0) : strength;
    const Real size = D == 2 ? (t1 < 0 ? -t1 : t1) : length(t1, t2);
    const Real reciprocal = 1 / greater(size, slip::least<Real>);
    Real now = size, take = 0, kept_more = 0;
    if constexpr (Correction == SlipCorrection::first) {
      Real over;
      now = slip::relaxed(size, strength, creep, over);
    } else if constexpr (Correction == SlipCorrection::second) {
      Real over;
      now = slip::relaxed(size, strength, creep * Real(0.5) + more[i], over);
      const Real beginning = slip::creep_of_beginning(creep, strength, 1);
      kept_more = creep * Real(0.5) - beginning;
      take = beginning * over;
    } else {
      const Real u1 = t1 * reciprocal, u2 = t2 * reciprocal, old = began[i];
      Real start = u1 * more[i], from = u1 * (more[i] - ahead1[i]);
      if constexpr (D == 3) {
        start += u2 * more2[i];
        from += u2 * (more2[i] - ahead2[i]);
      }
      const bool stuck = !(start > old);
      const Real before = (stuck ? from : start) - old;
      const Real excess =
          slip::excess_after(before, (size - from) - (strength - old), Real(0.5) * (strength + old), creep);
      now = creep > 0 && size > strength ? greater(lesser(strength + excess, size), Real(0)) : size;
      take = slip::crept(now, strength, creep * Real(0.5));
    }
    const bool slips = now < size;
    const Real left = slips ? now * reciprocal : Real(1);
    const Real d1 = t1 * left - t1, d2 = D == 3 ? t2 * left - t2 : Real(0);
    if constexpr (Correction != SlipCorrection::first) {
      ahead1[i] = take * (t1 * reciprocal);
      if constexpr (D == 3) ahead2[i] = take * (t2 * reciprocal);
    }
    if constexpr (Correction == SlipCorrection::second) more[i] = kept_more;
    if constexpr (Correction == SlipCorrection::exponential) {
      more[i] = t1 + d1;
      if constexpr (D == 3) more2[i] = t2 + d2;
      began[i] = strength;
    }
    r0[i] = s0 + (m1[0] * d1 + (D == 3 ? m2[0] * d2 : Real(0)));
    r1[i] = s1 + (m1[1] * d1 + (D == 3 ? m2[1] * d2 : Real(0)));
    r2[i] = s2 + (m1[2] * d1 + (D == 3 ? m2[2] * d2 : Real(0)));
    if constexpr (D == 3) {
      r3[i] = s3 + (m1[3] * d1 + m2[3] * d2);
      r4[i] = s4 + (m1[4] * d1 + m2[4] * d2);
      r5[i] = s5 + (m1[5] * d1 + m2[5] * d2);
    }
  }
}

/// Two systems at right angles in 2-D: one shear stress, two strengths.
template <SlipCorrection Correction, bool Extended, class Real>
void slip_two(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch, * __restrict const r2 = r1 + rows.pitch;
  const Real* __restrict const creeps_a = rows.creep[0], * __restrict const creeps_b = rows.creep[1];
  Real* __restrict const ahead = rows.kept, * __restrict const more_a = rows.kept + rows.kept_pitch;
  Real* __restrict const more_b = more_a + rows.kept_pitch;
  const Real* __restrict const still_a = rows.still, * __restrict const still_b =
                                                         rows.still + rows.still_pitch;
  const Real* __restrict const still_t = rows.still + 2 * rows.still_pitch;
  const Real* __restrict const gaps_a = rows.gap[0], * __restrict const gaps_b = rows.gap[1];
  const bool has_a = gaps_a != nullptr, has_b = gaps_b != nullptr;
  const Real na0 = planes.normal[0][0], na1 = planes.normal[0][1], na2 = planes.normal[0][2];
  const Real m0 = planes.shear[0][0], m1 = planes.shear[0][1], m2 = planes.shear[0][2];
  const Real friction_a = planes.friction[0], cohesion_a = planes.cohesion_pa[0];
  const Real friction_b = planes.friction[1], cohesion_b = planes.cohesion_pa[1];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], creep_a = creeps_a[i], creep_b = creeps_b[i];
    Real n_a = na0 * s0 + na1 * s1 + na2 * s2, n_b = s0 + s1 - n_a;
    Real t = Real(0.5) * (m0 * s0 + m1 * s1) + m2 * s2;
    if constexpr (Extended) {
      n_a += still_a[i];
      n_b += still_b[i];
      t += still_t[i];
    }
    Real strength_a = friction_a * greater(-n_a, Real(0)) + cohesion_a;
    Real strength_b = friction_b * greater(-n_b, Real(0)) + cohesion_b;
    if constexpr (Extended) {
      strength_a = has_a && gaps_a[has_a ? i : 0] > 0 ? Real(0) : strength_a;
      strength_b = has_b && gaps_b[has_b ? i : 0] > 0 ? Real(0) : strength_b;
    }
    const Real size = t < 0 ? -t : t, reciprocal = 1 / greater(size, slip::least<Real>);
    Real now, take = 0;
    if constexpr (Correction == SlipCorrection::first) {
      Real over_a, over_b;
      now = slip::relaxed_by_two(size, strength_a, strength_b, creep_a, creep_b, over_a, over_b);
    } else if constexpr (Correction == SlipCorrection::second) {
      Real over_a, over_b;
      now = slip::relaxed_by_two(size, strength_a, strength_b, creep_a * Real(0.5) + more_a[i],
                                 creep_b * Real(0.5) + more_b[i], over_a, over_b);
      const Real begin_a = slip::creep_of_beginning(creep_a, strength_a, 2);
      const Real begin_b = slip::creep_of_beginning(creep_b, strength_b, 2);
      more_a[i] = creep_a * Real(0.5) - begin_a;
      more_b[i] = creep_b * Real(0.5) - begin_b;
      take = begin_a * over_a + begin_b * over_b;
    } else {
      const Real half_a = creep_a * Real(0.5), half_b = creep_b * Real(0.5);
      const Real left = size - slip::crept(size, strength_b, half_b);
      now = left - slip::crept(left, strength_a, half_a);
      const Real rest = now - slip::crept(now, strength_a, half_a);
      take = now - (rest - slip::crept(rest, strength_b, half_b));
    }
    const Real d = now < size ? t * (now * reciprocal) - t : Real(0);
    if constexpr (Correction != SlipCorrection::first) ahead[i] = take * (t * reciprocal);
    r0[i] = s0 + m0 * d;
    r1[i] = s1 + m1 * d;
    r2[i] = s2 + m2 * d;
  }
}

template <int D, class Real>
void begin(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch;
  Real* __restrict const r2 = r1 + rows.pitch, * __restrict const r3 = D == 2 ? r2 : r2 + rows.pitch;
  Real* __restrict const r4 = D == 2 ? r2 : r3 + rows.pitch, * __restrict const r5 =
                                                                 D == 2 ? r2 : r4 + rows.pitch;
  const Real* __restrict const ahead1 = rows.kept, * __restrict const ahead2 =
                                                       D == 2 ? rows.kept : rows.kept + rows.kept_pitch;
  const Real *m1 = planes.shear[0], *m2 = planes.shear[D - 2];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real a = ahead1[i], b = D == 2 ? Real(0) : ahead2[i];
    r0[i] -= m1[0] * a + (D == 3 ? m2[0] * b : Real(0));
    r1[i] -= m1[1] * a + (D == 3 ? m2[1] * b : Real(0));
    r2[i] -= m1[2] * a + (D == 3 ? m2[2] * b : Real(0));
    if constexpr (D == 3) {
      r3[i] -= m1[3] * a + m2[3] * b;
      r4[i] -= m1[4] * a + m2[4] * b;
      r5[i] -= m1[5] * a + m2[5] * b;
    }
  }
}

template <class Real>
void nothing(std::int64_t, const SlipPlanes<Real>&, const SlipRows<Real>&) {}

template <int D, class Real>
void open(std::int64_t n, const SlipPlanes<Real>& planes, int system, const GapRows<Real>& rows) {
  constexpr int last = D == 2 ? 2 : 5;
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch;
  Real* __restrict const r2 = r1 + rows.pitch, * __restrict const r3 = D == 2 ? r2 : r2 + rows.pitch;
  Real* __restrict const r4 = D == 2 ? r2 : r3 + rows.pitch, * __restrict const r5 =
                                                                 D == 2 ? r2 : r4 + rows.pitch;
  Real* __restrict const gap = rows.gap;
  const Real* __restrict const lambdas = rows.lambda, * __restrict const moduli = rows.modulus, * __restrict const still = rows.still;
  const bool has_still = still != nullptr;
  Real normal[last + 1];
  for (int c = 0; c <= last; ++c) normal[c] = planes.normal[system][c];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real lambda = lambdas[i], modulus = moduli[i], was = gap[i];
    Real s_n = projected<D>(normal, Real(1), s0, s1, s2, s3, s4, s5);
    s_n += has_still ? still[has_still ? i : 0] : Real(0);
    // What s_n would be were the planes shut.
    const Real shut = s_n + modulus * was;
    const Real now = modulus > 0 ? greater(shut, Real(0)) / greater(modulus, slip::least<Real>) : Real(0);
    const Real change = now - was, even = lambda * change, along = (modulus - lambda) * change;
    gap[i] = now;
    // `normal` counts off-diagonal components twice.
    r0[i] = s0 - (even + along * normal[0]);
    r1[i] = s1 - (even + along * normal[1]);
    if constexpr (D == 2) {
      r2[i] = s2 - along * (Real(0.5) * normal[2]);
    } else {
      r2[i] = s2 - (even + along * normal[2]);
      r3[i] = s3 - along * (Real(0.5) * normal[3]);
      r4[i] = s4 - along * (Real(0.5) * normal[4]);
      r5[i] = s5 - along * (Real(0.5) * normal[5]);
    }
  }
}

template <int D, SlipCorrection Correction, bool Extended, class Real>
SlipKernels<Real> one() {
  const int rows = Correction == SlipCorrection::first    ? 0
                   : Correction == SlipCorrection::second ? D
                                                          : 2 * (D - 1) + 1;
  return {slip_one<D, Correction, Extended, Real>,
          Correction == SlipCorrection::first ? nothing<Real> : begin<D, Real>, rows};
}
template <SlipCorrection Correction, bool Extended, class Real>
SlipKernels<Real> two() {
  const int rows = Correction == SlipCorrection::first ? 0 : Correction == SlipCorrection::second ? 3 : 1;
  return {slip_two<Correction, Extended, Real>,
          Correction == SlipCorrection::first ? nothing<Real> : begin<2, Real>, rows};
}

template <SlipCorrection Correction, bool Extended, class Real>
SlipKernels<Real> of_case(const SlipCase& of) {
  if (of.dimensions == 3) return one<3, Correction, Extended, Real>();
  return of.systems == 2 ? two<Correction, Extended, Real>() : one<2, Correction, Extended, Real>();
}

template <bool Extended, class Real>
SlipKernels<Real> of_correction(const SlipCase& of) {
  if (of.correction == SlipCorrection::first) return of_case<SlipCorrection::first, Extended, Real>(of);
  if (of.correction == SlipCorrection::second) return of_case<SlipCorrection::second, Extended, Real>(of);
  return of_case<SlipCorrection::exponential, Extended, Real>(of);
}

template <class Real>
SlipKernels<Real> of(const SlipCase& of) {
  return of.still_or_gap ? of_correction<true, Real>(of) : of_correction<false, Real>(of);
}

template <class Real>
constexpr SlipTables<Real> tables = {of<Real>, open<2, Real>, open<3, Real>};

}  // namespace

const SlipTables<float>& SLIPWAVE_SLIP_LEVEL(float) { return tables<float>; }
const SlipTables<double>& SLIPWAVE_SLIP_LEVEL(double) { return tables<double>; }

}  // namespace slipwave::solver
