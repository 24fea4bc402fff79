// The inner loops of slip, compiled once for each instruction set as kernels_level.cpp is, under the same
// rules.
#include "solver/kernels/resolved_traction.hpp"
#include "solver/kernels/slip_tables.hpp"

namespace slipwave::solver {
namespace {

/// Which half of the work: the end of a step or what the next one begins with.
enum class Half { end, beginning };

/// What one system makes of the stress.
template <int D, SlipCorrection Correction, bool Extended, Half Now, class Real>
[[gnu::noinline]] void slip_one(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr int tangents = D - 1;
  constexpr bool exponential = Correction == SlipCorrection::exponential;
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch;
  Real* __restrict const r2 = r1 + rows.pitch, * __restrict const r3 = D == 2 ? r2 : r2 + rows.pitch;
  Real* __restrict const r4 = D == 2 ? r2 : r3 + rows.pitch, * __restrict const r5 =
                                                                 D == 2 ? r2 : r4 + rows.pitch;
  const Real* __restrict const creeps = rows.creep[0];
  // What the step began with: tau, S and what was taken off tau.
  Real* __restrict const tau1 = rows.kept, * __restrict const tau2 =
                                               rows.kept + (tangents - 1) * rows.kept_pitch;
  Real* __restrict const strengths = rows.kept + tangents * rows.kept_pitch;
  Real* __restrict const offs = strengths + rows.kept_pitch;
  const Real* __restrict const still_n = rows.still, * __restrict const still1 =
                                                         rows.still + rows.still_pitch;
  const Real* __restrict const still2 = rows.still + tangents * rows.still_pitch;
  const Real* __restrict const gaps = rows.gap[0];
  const OneSystem<D, Real> one(planes);
  const Real *const m1 = one.m1, *const m2 = one.m2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real creep = creeps[i];
    const auto [t1, t2, size, strength] =
        felt<D, Extended>(one, s0, s1, s2, s3, s4, s5, still_n, still1, still2, gaps, i);
    // Unit vector along tau.
    const Real reciprocal = D == 2 ? Real(1) : 1 / greater(size, slip::least<Real>);
    const Real u1 = D == 2 ? (t1 < 0 ? Real(-1) : Real(1)) : t1 * reciprocal,
               u2 = D == 2 ? Real(0) : t2 * reciprocal;
    Real now = size;
    if constexpr (Now == Half::beginning) {
      if constexpr (exponential) {
        const Real off = slip::crept(size, strength, creep * Real(0.5));
        now = size - off;
        tau1[i] = t1;
        if constexpr (D == 3) tau2[i] = t2;
        offs[i] = off;
        strengths[i] = strength;
      } else {
        now = size - slip::taken_first(size, strength, creep, 1);
      }
    } else if constexpr (exponential) {
      // Along the traction of the end: where it began, and with what the beginning took off.
      const Real old = strengths[i], b1 = tau1[i], b2 = D == 3 ? tau2[i] : Real(0);
      const Real start = u1 * b1 + u2 * b2;
      const Real from = D == 2 ? start - (start < 0 ? -offs[i] : offs[i])
                               : start * (1 - offs[i] / greater(length(b1, b2), slip::least<Real>));
      const Real before = (start > old ? start : from) - old;
      const Real excess =
          slip::excess_after(before, (size - from) - (strength - old), Real(0.5) * (strength + old), creep);
      now = creep > 0 && size > strength ? greater(lesser(strength + excess, size), Real(0)) : size;
    } else {
      Real over;
      now = slip::relaxed(
          size, strength,
          Correction == SlipCorrection::first ? creep : slip::creep_of_end(creep, strength, 1), over);
    }
    const Real d1 = u1 * (now - size), d2 = u2 * (now - size);
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

/// Whether any of these cells has more shear traction than strength.
template <int D, bool Extended, class Real>
bool slips(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr int tangents = D - 1;
  const Real *const r0 = rows.stress, *const r1 = r0 + rows.pitch, *const r2 = r1 + rows.pitch;
  const Real *const r3 = D == 2 ? r2 : r2 + rows.pitch, *const r4 = D == 2 ? r2 : r3 + rows.pitch,
                    *const r5 = D == 2 ? r2 : r4 + rows.pitch;
  const Real *const still_n = rows.still, *const still1 = still_n + rows.still_pitch,
                    *const still2 = still_n + tangents * rows.still_pitch;
  const OneSystem<D, Real> one(planes);
  using Whole = typename smooth::Bits<Real>::Whole;
  Whole any = 0;
#pragma omp simd reduction(| : any)
  for (std::int64_t i = 0; i < n; ++i) {
    const auto [t1, t2, size, strength] =
        felt<D, Extended>(one, r0[i], r1[i], r2[i], D == 2 ? Real(0) : r3[i], D == 2 ? Real(0) : r4[i],
                          D == 2 ? Real(0) : r5[i], still_n, still1, still2, rows.gap[0], i);
    any |= size > strength ? Whole(1) : Whole(0);
  }
  return any != 0;
}

/// slip_one() where it has anything to do: it is left out for pieces of a line in which nothing slips.
template <int D, SlipCorrection Correction, bool Extended, class Real>
void slip_where_needed(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr std::int64_t piece = 64;
  for (std::int64_t first = 0; first < n; first += piece) {
    SlipRows<Real> here = rows;
    here.stress += first;
    here.creep[0] += first;
    if (rows.kept) here.kept += first;
    if (rows.still) here.still += first;
    if (rows.gap[0]) here.gap[0] += first;
    const std::int64_t count = n - first < piece ? n - first : piece;
    if (slips<D, Extended>(count, planes, here))
      slip_one<D, Correction, Extended, Half::end>(count, planes, here);
  }
}

/// Two systems at right angles in 2-D: one shear stress, two strengths.
template <SlipCorrection Correction, bool Extended, Half Now, class Real>
void slip_two(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch, * __restrict const r2 = r1 + rows.pitch;
  const Real* __restrict const creeps_a = rows.creep[0], * __restrict const creeps_b = rows.creep[1];
  const Real* __restrict const still_a = rows.still, * __restrict const still_b =
                                                         rows.still + rows.still_pitch;
  const Real* __restrict const still_t = rows.still + 2 * rows.still_pitch;
  const Real* __restrict const gaps_a = rows.gap[0], * __restrict const gaps_b = rows.gap[1];
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
      strength_a = gaps_a[i] > 0 ? Real(0) : strength_a;
      strength_b = gaps_b[i] > 0 ? Real(0) : strength_b;
    }
    const Real size = t < 0 ? -t : t;
    Real now;
    if constexpr (Correction == SlipCorrection::exponential) {
      // One system after the other, in opposite orders at both ends.
      const Real half_a = creep_a * Real(0.5), half_b = creep_b * Real(0.5);
      constexpr bool a_first = Now == Half::beginning;
      const Real first = a_first ? half_a : half_b, second = a_first ? half_b : half_a;
      const Real strength_1 = a_first ? strength_a : strength_b,
                 strength_2 = a_first ? strength_b : strength_a;
      const Real rest = size - slip::crept(size, strength_1, first);
      now = rest - slip::crept(rest, strength_2, second);
    } else if constexpr (Now == Half::beginning) {
      now = size - slip::taken_first(size, strength_a, creep_a, 2) -
            slip::taken_first(size, strength_b, creep_b, 2);
    } else {
      constexpr bool first = Correction == SlipCorrection::first;
      now = slip::relaxed_by_two(size, strength_a, strength_b,
                                 first ? creep_a : slip::creep_of_end(creep_a, strength_a, 2),
                                 first ? creep_b : slip::creep_of_end(creep_b, strength_b, 2));
    }
    const Real d = t < 0 ? size - now : now - size;
    r0[i] = s0 + m0 * d;
    r1[i] = s1 + m1 * d;
    r2[i] = s2 + m2 * d;
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
  Real normal[last + 1];
  for (int c = 0; c <= last; ++c) normal[c] = planes.normal[system][c];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real lambda = lambdas[i], modulus = moduli[i], was = gap[i];
    const Real s_n = projected<D>(normal, Real(1), s0, s1, s2, s3, s4, s5) + still[i];
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
  constexpr auto begin = slip_one<D, Correction, Extended, Half::beginning, Real>;
  if constexpr (Correction == SlipCorrection::first)
    return {slip_one<D, Correction, Extended, Half::end, Real>, nothing<Real>, 0};
  else if constexpr (Correction == SlipCorrection::second)
    return {slip_one<D, Correction, Extended, Half::end, Real>, begin, 0};
  else  // divisions and roots: worth a look before
    return {slip_where_needed<D, Correction, Extended, Real>, begin, D + 1};
}
template <SlipCorrection Correction, bool Extended, class Real>
SlipKernels<Real> two() {
  if constexpr (Correction == SlipCorrection::first)
    return {slip_two<Correction, Extended, Half::end, Real>, nothing<Real>, 0};
  else
    return {slip_two<Correction, Extended, Half::end, Real>,
            slip_two<Correction, Extended, Half::beginning, Real>, 0};
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
