// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of slip, compiled once for each instruction set as kernels_level.cpp is, under the same
// rules.
#include "fracture/friction_laws.hpp"
#include "solver/kernels/linear_slip_rows.hpp"
#include "solver/kernels/resolved_traction.hpp"
#include "solver/kernels/slip_tables.hpp"

namespace slipwave::solver {
namespace {

/// Which half: that of the end of a step or the explicit half of the next one.
enum class Half { end, beginning };

/// What rules retain from the beginning of a step: tau, S, and the decrease of tau (exponential) or half of
/// what slip of the last step took off (centred).
template <int D, class Real>
struct Beginning {
  Real* __restrict const tau1;
  Real* __restrict const tau2;
  Real* __restrict const strengths;
  Real* __restrict const losses;
  Real* __restrict const losses2;
  [[gnu::always_inline]] explicit Beginning(const SlipRows<Real>& rows)
      : tau1(rows.retained),
        tau2(rows.retained + (D - 2) * rows.retained_pitch),
        strengths(rows.retained + (D - 1) * rows.retained_pitch),
        losses(rows.retained + D * rows.retained_pitch),
        losses2(rows.retained + (2 * D - 2) * rows.retained_pitch) {}
  /// What the second component of a list is, which 2-D has not.
  [[gnu::always_inline]] static Real second(const Real* list, std::int64_t i) {
    return D == 3 ? list[i] : Real(0);
  }
};

/// theta c.
template <SlipCorrection Correction, class Real>
[[gnu::always_inline]] inline Real weighted(Real relaxation, Real strength, int sharing) {
  if constexpr (Correction == SlipCorrection::first) return relaxation;
  if constexpr (Correction == SlipCorrection::exponential || Correction == SlipCorrection::centred)
    return Real(0.5) * relaxation;
  return slip::relaxation_of_end(relaxation, strength, sharing);
}

/// |tau| at the end of a step, which ends along (u1, u2) with |tau_e| = size, by the exponential rule.
template <int D, class Real>
[[gnu::always_inline]] inline Real exponential_end(const Beginning<D, Real>& began, std::int64_t i, Real u1,
                                                   Real u2, Real size, Real strength, Real relaxation) {
  // Along the traction of the end: its start, and that less the decrease at the beginning.
  const Real old = began.strengths[i], b1 = began.tau1[i], b2 = began.second(began.tau2, i);
  const Real start = u1 * b1 + u2 * b2;
  const Real from = D == 2 ? start - (start < 0 ? -began.losses[i] : began.losses[i])
                           : start * (1 - began.losses[i] / greater(length(b1, b2), slip::least<Real>));
  const Real before = (start > old ? start : from) - old;
  const Real excess =
      slip::excess_after(before, (size - from) - (strength - old), Real(0.5) * (strength + old), relaxation);
  return relaxation > 0 && size > strength ? greater(lesser(strength + excess, size), Real(0)) : size;
}

/// |tau| at the end of a step by the centred rule: (u1, u2) is along the traction that welded planes would
/// carry.
template <int D, class Real>
[[gnu::always_inline]] inline Real centred_end(const Beginning<D, Real>& began, std::int64_t i, Real u1,
                                               Real u2, Real size, Real strength, Real relaxation) {
  const Real old = began.strengths[i], b2 = began.second(began.tau2, i);
  const Real start = u1 * began.tau1[i] + u2 * b2;
  const Real excess = slip::excess_after(start - old, (size - start) - (strength - old),
                                         Real(0.5) * (strength + old), relaxation);
  const bool slips = relaxation > 0 && greater(size - strength, start - old) > 0;
  return slips ? greater(lesser(strength + excess, size), Real(0)) : size;
}

/// |tau| after the explicit half of a step, and what the rule retains for the end of it.
template <int D, SlipCorrection Correction, class Real>
[[gnu::always_inline]] inline Real size_after_beginning(const Beginning<D, Real>& began, std::int64_t i,
                                                        const ResolvedTraction<Real>& of, Real relaxation) {
  if constexpr (Correction == SlipCorrection::exponential || Correction == SlipCorrection::centred) {
    began.tau1[i] = of.t1;
    if constexpr (D == 3) began.tau2[i] = of.t2;
    began.strengths[i] = of.strength;
    if constexpr (Correction == SlipCorrection::centred) return of.size;
    const Real loss = slip::unloaded_loss(of.size, of.strength, relaxation * Real(0.5));
    began.losses[i] = loss;
    return of.size - loss;
  } else {
    return of.size - slip::explicit_half(of.size, of.strength, relaxation, 1);
  }
}

/// |tau| at the end of a step along (u1, u2), at the strength `end` of then.
template <int D, SlipCorrection Correction, class Real>
[[gnu::always_inline]] inline Real size_at_end(const Beginning<D, Real>& began, std::int64_t i, Real u1,
                                               Real u2, Real size, Real end, Real relaxation) {
  if constexpr (Correction == SlipCorrection::exponential) {
    return exponential_end<D>(began, i, u1, u2, size, end, relaxation);
  } else if constexpr (Correction == SlipCorrection::centred) {
    return centred_end<D>(began, i, u1, u2, size, end, relaxation);
  } else {
    Real over;
    return slip::relaxed(size, end, weighted<Correction>(relaxation, end, 1), over);
  }
}

/// The change (d1, d2) of a traction (t1, t2) that turned from (b1, b2) while welded planes carried it, where
/// slip leaves `now` of |t| = size. Planes slip along the traction as it turns, on average along that in the
/// middle of the step: along that of its end alone the rule would be of first order (S27a).
template <class Real>
[[gnu::always_inline]] inline void change_of_turning(Real b1, Real b2, Real t1, Real t2, Real size, Real now,
                                                     Real& d1, Real& d2) {
  const Real m1 = b1 + t1, m2 = b2 + t2, share = (size - now) / greater(length(m1, m2), slip::least<Real>);
  const Real w1 = t1 - share * m1, w2 = t2 - share * m2;
  const Real along = now / greater(length(w1, w2), slip::least<Real>);
  // Where nothing slips nothing changes, to the bit.
  d1 = now < size ? along * w1 - t1 : Real(0);
  d2 = now < size ? along * w2 - t2 : Real(0);
}

/// Makes of the change of the traction by slip, (d1, d2), that of the stress by the centred rule: half of
/// what slip took off the last time goes ahead, and comes back at the end.
template <int D, Half Now, class Real>
[[gnu::always_inline]] inline void change_ahead(const Beginning<D, Real>& began, std::int64_t i, Real& d1,
                                                Real& d2) {
  const Real ahead1 = began.losses[i], ahead2 = began.second(began.losses2, i);
  if constexpr (Now == Half::beginning) {
    d1 = -ahead1;
    d2 = -ahead2;
  } else {
    began.losses[i] = Real(-0.5) * d1;
    if constexpr (D == 3) began.losses2[i] = Real(-0.5) * d2;
    d1 += ahead1;
    d2 += ahead2;
  }
}

/// The correction of stress by one system.
template <int D, SlipCorrection Correction, class Law, bool Extended, Half Now, class Real>
[[gnu::noinline]] void slip_one(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr bool centred = Correction == SlipCorrection::centred;
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch;
  Real* __restrict const r2 = r1 + rows.pitch, * __restrict const r3 = D == 2 ? r2 : r2 + rows.pitch;
  Real* __restrict const r4 = D == 2 ? r2 : r3 + rows.pitch, * __restrict const r5 =
                                                                 D == 2 ? r2 : r4 + rows.pitch;
  const Real* __restrict const relaxations = rows.relaxation[0];
  const Beginning<D, Real> began(rows);
  Real* __restrict const slips = rows.slip_m[0];
  const Real* __restrict const slips_per_pa = rows.slip_per_pa;
  const OneSystem<D, Real> one(planes);
  const OnSystem<Real> on(rows, D - 1);
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real relaxation = relaxations[i], slip_m = Law::has_state ? slips[i] : Real(0),
               slip_per_pa = Law::has_state ? slips_per_pa[i] : Real(0);
    const auto of = resolved_traction<D, Law, Extended>(one, s0, s1, s2, s3, s4, s5, on, slip_m, i);
    // At the end of a step of the centred rule what was taken off ahead is put back. (In scalars: GCC makes
    // no vectors of a structure that is put together anew.)
    constexpr bool ahead = centred && Now == Half::end;
    const Real t1 = ahead ? of.t1 + began.losses[i] : of.t1,
               t2 = ahead ? of.t2 + began.second(began.losses2, i) : of.t2, strength = of.strength;
    const Real size = !ahead ? of.size : D == 2 ? (t1 < 0 ? -t1 : t1) : length(t1, t2);
    // Unit vector along tau.
    const Real reciprocal = D == 2 ? Real(1) : 1 / greater(size, slip::least<Real>);
    const Real u1 = D == 2 ? (t1 < 0 ? Real(-1) : Real(1)) : t1 * reciprocal,
               u2 = D == 2 ? Real(0) : t2 * reciprocal;
    Real now = size;
    if constexpr (Now == Half::beginning) {
      now = size_after_beginning<D, Correction>(began, i, of, relaxation);
    } else {
      Real over, end = strength;
      if constexpr (Law::has_state) {
        const Real theta_c = weighted<Correction>(relaxation, strength, 1);
        const Real loss = size - slip::relaxed(size, strength, theta_c, over);
        end = strength_at_end<Law, Extended>(one.law, of.s_n, slip_m, slip_per_pa,
                                             Extended ? on.gaps[i] : Real(0), strength, theta_c, loss);
      }
      now = size_at_end<D, Correction>(began, i, u1, u2, size, end, relaxation);
    }
    if constexpr (Law::has_state) slips[i] = Law::slip_after(slip_m, slip_per_pa, size - now);
    Real d1 = u1 * (now - size), d2 = u2 * (now - size);
    if constexpr (ahead && D == 3) change_of_turning(began.tau1[i], began.tau2[i], t1, t2, size, now, d1, d2);
    if constexpr (centred) change_ahead<D, Now>(began, i, d1, d2);
    r0[i] = s0 + along_planes(one, 0, d1, d2);
    r1[i] = s1 + along_planes(one, 1, d1, d2);
    r2[i] = s2 + along_planes(one, 2, d1, d2);
    if constexpr (D == 3) {
      r3[i] = s3 + along_planes(one, 3, d1, d2);
      r4[i] = s4 + along_planes(one, 4, d1, d2);
      r5[i] = s5 + along_planes(one, 5, d1, d2);
    }
  }
}

/// Whether any of these cells has more shear traction than strength, or, by the centred rule, did slip in the
/// last step.
template <int D, SlipCorrection Correction, class Law, bool Extended, class Real>
bool slips(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  const Real *const r0 = rows.stress, *const r1 = r0 + rows.pitch, *const r2 = r1 + rows.pitch;
  const Real *const r3 = D == 2 ? r2 : r2 + rows.pitch, *const r4 = D == 2 ? r2 : r3 + rows.pitch,
                    *const r5 = D == 2 ? r2 : r4 + rows.pitch;
  const Real* const slips_m = rows.slip_m[0];
  const OneSystem<D, Real> one(planes);
  const OnSystem<Real> on(rows, D - 1);
  const Beginning<D, Real> began(rows);
  using Whole = typename smooth::Bits<Real>::Whole;
  Whole any = 0;
#pragma omp simd reduction(| : any)
  for (std::int64_t i = 0; i < n; ++i) {
    const auto [s_n, t1, t2, size, strength] = resolved_traction<D, Law, Extended>(
        one, r0[i], r1[i], r2[i], D == 2 ? Real(0) : r3[i], D == 2 ? Real(0) : r4[i],
        D == 2 ? Real(0) : r5[i], on, Law::has_state ? slips_m[i] : Real(0), i);
    any |= size > strength ? Whole(1) : Whole(0);
    if constexpr (Correction == SlipCorrection::centred) {
      any |= began.losses[i] != 0 ? Whole(1) : Whole(0);
      if constexpr (D == 3) any |= began.losses2[i] != 0 ? Whole(1) : Whole(0);
    }
  }
  return any != 0;
}

/// slip_one() where it has anything to do: it is left out for pieces of a line in which nothing slips.
template <int D, SlipCorrection Correction, class Law, bool Extended, class Real>
void slip_where_needed(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr std::int64_t piece = 64;
  for (std::int64_t first = 0; first < n; first += piece) {
    SlipRows<Real> here = rows;
    here.stress += first;
    here.relaxation[0] += first;
    if (rows.retained) here.retained += first;
    if (rows.prestress) here.prestress += first;
    if (rows.gap[0]) here.gap[0] += first;
    if (Law::has_state) here.slip_m[0] += first, here.slip_per_pa += first;
    const std::int64_t count = n - first < piece ? n - first : piece;
    if (slips<D, Correction, Law, Extended>(count, planes, here))
      slip_one<D, Correction, Law, Extended, Half::end>(count, planes, here);
  }
}

/// Two systems that share |tau| = size, and what each takes off it.
template <class Real>
struct Pair {
  Real size, strength_a, strength_b, relaxation_a, relaxation_b;
  // For strengths that change.
  Real s_n_a, s_n_b, slip_a, slip_b, slip_per_pa, gap_a, gap_b;
};
template <class Real>
struct PairLoss {
  Real now, a, b;
};

/// What is left after one and the other; losses as differences, so that both laws round alike.
template <class Real>
[[gnu::always_inline]] inline PairLoss<Real> pair_left(Real size, Real rest, Real now) {
  return {now, size - rest, rest - now};
}

template <SlipCorrection Correction, class Real>
[[gnu::always_inline]] inline PairLoss<Real> pair_begins(const Pair<Real>& of) {
  if constexpr (Correction == SlipCorrection::exponential) {
    const Real rest = of.size - slip::unloaded_loss(of.size, of.strength_a, of.relaxation_a * Real(0.5));
    return pair_left(of.size, rest,
                     rest - slip::unloaded_loss(rest, of.strength_b, of.relaxation_b * Real(0.5)));
  } else {
    const Real rest = of.size - slip::explicit_half(of.size, of.strength_a, of.relaxation_a, 2);
    return pair_left(of.size, rest, rest - slip::explicit_half(of.size, of.strength_b, of.relaxation_b, 2));
  }
}

/// Both at the rates of the end, at these strengths.
template <SlipCorrection Correction, class Real>
[[gnu::always_inline]] inline PairLoss<Real> pair_relaxed(const Pair<Real>& of, Real strength_a,
                                                          Real strength_b) {
  Real b;
  const Real now = slip::relaxed_by_two(of.size, strength_a, strength_b,
                                        weighted<Correction>(of.relaxation_a, strength_a, 2),
                                        weighted<Correction>(of.relaxation_b, strength_b, 2), b);
  return {now, (of.size - now) - b, b};
}

/// Strength of the end where slip at the strength of now takes `loss` off the traction.
template <SlipCorrection Correction, class Law, bool Extended, class Real>
[[gnu::always_inline]] inline Real end_of_a(const FrictionConstants<Real>& law, const Pair<Real>& of,
                                            Real loss) {
  return strength_at_end<Law, Extended>(law, of.s_n_a, of.slip_a, of.slip_per_pa, of.gap_a, of.strength_a,
                                        weighted<Correction>(of.relaxation_a, of.strength_a, 2), loss);
}
template <SlipCorrection Correction, class Law, bool Extended, class Real>
[[gnu::always_inline]] inline Real end_of_b(const FrictionConstants<Real>& law, const Pair<Real>& of,
                                            Real loss) {
  return strength_at_end<Law, Extended>(law, of.s_n_b, of.slip_b, of.slip_per_pa, of.gap_b, of.strength_b,
                                        weighted<Correction>(of.relaxation_b, of.strength_b, 2), loss);
}

template <SlipCorrection Correction, class Law, bool Extended, class Real>
[[gnu::always_inline]] inline PairLoss<Real> pair_ends(const FrictionConstants<Real>& law_a,
                                                       const FrictionConstants<Real>& law_b,
                                                       const Pair<Real>& of) {
  if constexpr (Correction == SlipCorrection::exponential) {
    // One system after the other, in the opposite order of the beginning.
    const Real half_a = of.relaxation_a * Real(0.5), half_b = of.relaxation_b * Real(0.5);
    Real strength_a = of.strength_a, strength_b = of.strength_b;
    if constexpr (Law::has_state)
      strength_b =
          end_of_b<Correction, Law, Extended>(law_b, of, slip::unloaded_loss(of.size, strength_b, half_b));
    const Real rest = of.size - slip::unloaded_loss(of.size, strength_b, half_b);
    if constexpr (Law::has_state)
      strength_a =
          end_of_a<Correction, Law, Extended>(law_a, of, slip::unloaded_loss(rest, strength_a, half_a));
    const Real now = rest - slip::unloaded_loss(rest, strength_a, half_a);
    return {now, rest - now, of.size - rest};
  } else if constexpr (Law::has_state) {
    const auto [now, a, b] = pair_relaxed<Correction>(of, of.strength_a, of.strength_b);
    return pair_relaxed<Correction>(of, end_of_a<Correction, Law, Extended>(law_a, of, a),
                                    end_of_b<Correction, Law, Extended>(law_b, of, b));
  } else {
    return pair_relaxed<Correction>(of, of.strength_a, of.strength_b);
  }
}

template <SlipCorrection Correction, class Law, bool Extended, Half Now, class Real>
[[gnu::always_inline]] inline PairLoss<Real> pair_loss(const FrictionConstants<Real>& law_a,
                                                       const FrictionConstants<Real>& law_b,
                                                       const Pair<Real>& of) {
  if constexpr (Now == Half::beginning)
    return pair_begins<Correction>(of);
  else
    return pair_ends<Correction, Law, Extended>(law_a, law_b, of);
}

/// Two systems at right angles in 2-D: one shear stress, two strengths.
template <SlipCorrection Correction, class Law, bool Extended, Half Now, class Real>
void slip_two(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows) {
  constexpr bool centred = Correction == SlipCorrection::centred;
  // By the centred rule slip follows the law as by the second-order one; only the waves feel it otherwise.
  constexpr SlipCorrection rule = centred ? SlipCorrection::second : Correction;
  Real* __restrict const halves = rows.retained, * __restrict const explicit_halves =
                                                     rows.retained + rows.retained_pitch;
  Real* __restrict const r0 = rows.stress, * __restrict const r1 = r0 + rows.pitch, * __restrict const r2 = r1 + rows.pitch;
  const Real* __restrict const relaxations_a = rows.relaxation[0], * __restrict const relaxations_b =
                                                                       rows.relaxation[1];
  const Real* __restrict const prestress_a = rows.prestress, * __restrict const prestress_b =
                                                                 rows.prestress + rows.prestress_pitch;
  const Real* __restrict const prestress_t = rows.prestress + 2 * rows.prestress_pitch;
  const Real* __restrict const gaps_a = rows.gap[0], * __restrict const gaps_b = rows.gap[1];
  Real* __restrict const slips_a = rows.slip_m[0], * __restrict const slips_b = rows.slip_m[1];
  const Real* __restrict const slips_per_pa = rows.slip_per_pa;
  const Real na0 = planes.normal[0][0], na1 = planes.normal[0][1], na2 = planes.normal[0][2];
  const Real m0 = planes.shear[0][0], m1 = planes.shear[0][1], m2 = planes.shear[0][2];
  const FrictionConstants<Real> law_a = planes.law[0], law_b = planes.law[1];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i];
    Real n_a = na0 * s0 + na1 * s1 + na2 * s2, n_b = s0 + s1 - n_a;
    Real t = Real(0.5) * (m0 * s0 + m1 * s1) + m2 * s2;
    constexpr bool ahead = centred && Now == Half::end;
    const Real half = centred ? halves[i] : Real(0), gone = ahead ? explicit_halves[i] : Real(0);
    if constexpr (ahead) t += half - gone;
    if constexpr (Extended) {
      n_a += prestress_a[i];
      n_b += prestress_b[i];
      t += prestress_t[i];
    }
    const Real slip_a = Law::has_state ? slips_a[i] : Real(0), slip_b = Law::has_state ? slips_b[i] : Real(0),
               slip_per_pa = Law::has_state ? slips_per_pa[i] : Real(0);
    const Real gap_a = Extended ? gaps_a[i] : Real(0), gap_b = Extended ? gaps_b[i] : Real(0);
    // Before |tau|: GCC otherwise makes the choice for open planes in differences of both, at 15 % more time.
    const Real strength_a = strength_of<Law, Extended>(law_a, n_a, slip_a, gap_a),
               strength_b = strength_of<Law, Extended>(law_b, n_b, slip_b, gap_b);
    const Pair<Real> pair = {t < 0 ? -t : t,   strength_a,  strength_b, relaxations_a[i],
                             relaxations_b[i], n_a,         n_b,        slip_a,
                             slip_b,           slip_per_pa, gap_a,      gap_b};
    const auto loss = pair_loss<rule, Law, Extended, Now>(law_a, law_b, pair);
    if constexpr (Law::has_state) {
      slips_a[i] = Law::slip_after(slip_a, slip_per_pa, loss.a);
      slips_b[i] = Law::slip_after(slip_b, slip_per_pa, loss.b);
    }
    Real d = t < 0 ? pair.size - loss.now : loss.now - pair.size;
    if constexpr (ahead) {
      halves[i] = Real(0.5) * (gone - d);
      d += half - gone;
    } else if constexpr (centred) {
      explicit_halves[i] = -d;
      d = -half;
    }
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
  const Real* __restrict const lambdas = rows.lambda, * __restrict const moduli = rows.modulus, * __restrict const prestress = rows.prestress;
  Real normal[last + 1];
  for (int c = 0; c <= last; ++c) normal[c] = planes.normal[system][c];
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real s0 = r0[i], s1 = r1[i], s2 = r2[i], s3 = D == 2 ? Real(0) : r3[i],
               s4 = D == 2 ? Real(0) : r4[i], s5 = D == 2 ? Real(0) : r5[i];
    const Real lambda = lambdas[i], modulus = moduli[i], was = gap[i];
    const Real s_n = projected<D>(normal, Real(1), s0, s1, s2, s3, s4, s5) + prestress[i];
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

template <int D, SlipCorrection Correction, class Law, bool Extended, class Real>
SlipKernels<Real> one() {
  constexpr auto begin = slip_one<D, Correction, Law, Extended, Half::beginning, Real>;
  if constexpr (Correction == SlipCorrection::first)
    return {slip_one<D, Correction, Law, Extended, Half::end, Real>, nothing<Real>, 0};
  else if constexpr (Correction == SlipCorrection::second)
    return {slip_one<D, Correction, Law, Extended, Half::end, Real>, begin, 0};
  else  // divisions and roots: not where nothing slips
    return {slip_where_needed<D, Correction, Law, Extended, Real>, begin,
            Correction == SlipCorrection::centred ? 2 * D - 1 : D + 1};
}
template <SlipCorrection Correction, class Law, bool Extended, class Real>
SlipKernels<Real> two() {
  if constexpr (Correction == SlipCorrection::first)
    return {slip_two<Correction, Law, Extended, Half::end, Real>, nothing<Real>, 0};
  else
    return {slip_two<Correction, Law, Extended, Half::end, Real>,
            slip_two<Correction, Law, Extended, Half::beginning, Real>,
            Correction == SlipCorrection::centred ? 2 : 0};
}

template <SlipCorrection Correction, class Law, bool Extended, class Real>
SlipKernels<Real> of_case(const SlipCase& of) {
  if (of.dimensions == 3) return one<3, Correction, Law, Extended, Real>();
  return of.systems == 2 ? two<Correction, Law, Extended, Real>() : one<2, Correction, Law, Extended, Real>();
}

template <class Law, bool Extended, class Real>
SlipKernels<Real> of_correction(const SlipCase& of) {
  if (of.correction == SlipCorrection::first) return of_case<SlipCorrection::first, Law, Extended, Real>(of);
  if (of.correction == SlipCorrection::second)
    return of_case<SlipCorrection::second, Law, Extended, Real>(of);
  if (of.correction == SlipCorrection::centred)
    return of_case<SlipCorrection::centred, Law, Extended, Real>(of);
  return of_case<SlipCorrection::exponential, Law, Extended, Real>(of);
}

template <class Law, class Real>
SlipKernels<Real> of_law(const SlipCase& of) {
  return of.prestress_or_gap ? of_correction<Law, true, Real>(of) : of_correction<Law, false, Real>(of);
}

template <class Real>
SlipKernels<Real> of(const SlipCase& of) {
  return with_friction_law(of.law, [&](auto law) { return of_law<decltype(law), Real>(of); });
}

template <class Real>
constexpr SlipTables<Real> tables = {of<Real>, open<2, Real>, open<3, Real>, linear_of<Real>};

}  // namespace

const SlipTables<float>& SLIPWAVE_SLIP_LEVEL(float) { return tables<float>; }
const SlipTables<double>& SLIPWAVE_SLIP_LEVEL(double) { return tables<double>; }

}  // namespace slipwave::solver
