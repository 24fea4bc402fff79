// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fracture/smooth.hpp"

/// Slip with a small viscosity, and what it takes off the shear traction of a cell within a time step
/// (docs/theory/slip.md; Nikitin & Golubev 2021, J. Sib. Fed. Univ. 14(6)).
///
///   tau    shear traction on the planes                    Pa   (S1)
///   S      strength, by a friction law (friction_policy.hpp)   Pa   (S2)
///   g      slip strain rate, |tau| = S (1 + eta |g|) while slipping   1/s   (S3)
///   tau_e  shear traction after the elastic step           Pa
///   c      mu dt/eta, "relaxation stress": what slip takes off the traction in a step at |tau| = 2 S   Pa
///   G      mu dt g = c (|tau|/S - 1)_+, what slip at rate g takes off in a step            Pa
///
/// Magnitudes only: directions are the caller's (slip_kernels, joint_slip). Made for the inner loop: plain
/// scalars, no branch, nothing from the standard library, no division by anything that may be zero. Finite
/// stress gives finite stress for every c and S from 0 to 1e30, and c = 0 changes no bit of it: intact cells
/// may stand among the others.
namespace slipwave {

/// Largest c: the reciprocal is still a normal float. Dry friction (eta = 0) has it.
inline constexpr double most_relaxation_pa = 1e30;

/// Rule of the slip correction of a step (theory/slip.md).
enum class SlipCorrection { first, second, exponential, centred };

namespace slip {

template <class Real>
[[gnu::always_inline]] inline Real greater(Real a, Real b) {
  return a > b ? a : b;
}
template <class Real>
[[gnu::always_inline]] inline Real lesser(Real a, Real b) {
  return a < b ? a : b;
}
/// In place of a divisor that is zero.
template <class Real>
constexpr Real least = sizeof(Real) == 4 ? Real(1e-37) : Real(1e-300);

/// c of planes of that viscosity in rock of that shear modulus, computed in double and held within what the
/// law takes: dry friction (eta = 0) has the most, mu = 0 none. Planes without strength slip however large
/// eta.
inline double relaxation_pa(double viscosity_s, double mu_pa, double dt_s) {
  if (!(viscosity_s > 0)) return most_relaxation_pa;
  if (!(mu_pa > 0) || !(dt_s > 0)) return 0;
  return greater(1 / most_relaxation_pa, lesser(mu_pa / viscosity_s * dt_s, most_relaxation_pa));
}

/// |tau|/S - 1 where slip of the step's end, of weight theta, carries what is above the strength:
/// |tau| + theta G = size.
template <class Real>
[[gnu::always_inline]] inline Real overload(Real size, Real strength, Real weighted_relaxation) {
  return (size - strength) / greater(strength + weighted_relaxation, least<Real>);
}

/// What slip of one system at the rates of both ends of a step makes of |tau_e| = size (S5), (S6).
/// `weighted_relaxation` is theta c, `over` becomes |tau|/S - 1 or 0.
template <class Real>
[[gnu::always_inline]] inline Real relaxed(Real size, Real strength, Real weighted_relaxation, Real& over) {
  const bool slips = weighted_relaxation > 0 && size > strength;
  over = slips ? overload(size, strength, weighted_relaxation) : Real(0);
  return slips ? lesser(strength + strength * over, size) : size;
}

/// What slip of two systems that share a shear stress makes of |tau_e| = size: |tau| + theta_a G_a + theta_b
/// G_b = size. The left side grows with |tau| in straight pieces: up to the lower strength, up to the higher
/// one, beyond. `loss_b` becomes what the second one takes off (of dry systems of equal strength the first
/// takes all).
template <class Real>
[[gnu::always_inline]] inline Real relaxed_by_two(Real size, Real strength_a, Real strength_b,
                                                  Real relaxation_a, Real relaxation_b, Real& loss_b) {
  const bool swap = strength_b < strength_a;
  const Real s1 = swap ? strength_b : strength_a, s2 = swap ? strength_a : strength_b;
  const Real c1 = swap ? relaxation_b : relaxation_a, c2 = swap ? relaxation_a : relaxation_b;
  Real over1, over2;
  const Real one = relaxed(size, s1, c1, over1);
  // How much of a change of load the weaker system leaves to the stronger one.
  const Real passed = c1 > 0 ? s1 / greater(s1 + c1, least<Real>) : Real(1);
  const Real now = relaxed(one, s2, c2 * passed, over2);
  const Real loss = size - now, of_stronger = lesser(c2 * over2, loss);
  loss_b = swap ? loss - of_stronger : of_stronger;
  return now;
}

/// theta c at strength S (S7), where `sharing` systems take off the same stress.
template <class Real>
[[gnu::always_inline]] inline Real relaxation_of_end(Real relaxation, Real strength, int sharing) {
  return greater(relaxation * Real(0.5), relaxation - strength * Real(2. / sharing));
}

/// (1 - theta) G, what the explicit half of a step takes off |tau| = size at its beginning (S6).
template <class Real>
[[gnu::always_inline]] inline Real explicit_half(Real size, Real strength, Real relaxation, int sharing) {
  const Real share = lesser(relaxation * Real(0.5) / greater(strength, least<Real>), Real(2. / sharing));
  return share * greater(size - strength, Real(0));
}

/// What slip takes off |tau| = size within a fraction of a step in which nothing loads it; `relaxation` is
/// for that fraction. Exactly 0 where nothing slips.
template <class Real>
[[gnu::always_inline]] inline Real unloaded_loss(Real size, Real strength, Real relaxation) {
  const Real excess = greater(size - strength, Real(0));
  // Written without a choice between results, which compilers do not vectorise.
  return excess * smooth::decay(relaxation / greater(strength, least<Real>)).lost;
}

/// The law solved over a step in which load and strength grow steadily (S10): `before` is |tau| - S at its
/// beginning (below zero: stuck), `grown` what load less strength add to it, `strength` the mean. Returns
/// |tau| - S at the end, slip beginning or stopping on the way where it does.
template <class Real>
[[gnu::always_inline]] inline Real excess_after(Real before, Real grown, Real strength, Real relaxation) {
  constexpr Real most = Real(most_relaxation_pa);
  // Divisions are most of the work: each is made once. x is c/S.
  const Real x = lesser(relaxation / greater(strength, least<Real>), most);
  const Real of_x = lesser(strength / greater(relaxation, least<Real>), 1 / least<Real>);
  const Real elastic = before + grown, pace = grown < 0 ? -grown : grown;
  const Real of_pace = 1 / greater(pace, least<Real>);
  // Stuck at the beginning: slip in the last fraction of the step only.
  const bool begins = !(before > 0);
  const Real fraction = begins ? lesser(elastic * of_pace, Real(1)) : Real(1);
  const Real slipping = greater(x * fraction, Real(0));
  const auto decay = smooth::decay(slipping);
  // The fraction cancels where the decay is divided by what slips in it.
  const Real added = grown * (slipping < smooth::near_zero<Real> ? fraction * decay.mean : decay.lost * of_x);
  const Real end = (begins ? Real(0) : before * decay.left) + added;
  // Slipping at the beginning, stuck at the end: e^(-x w) = rho/(before + rho) at the instant w, rho =
  // -grown/x.
  const Real until = smooth::logarithm_of_one_more(lesser(greater(before, Real(0)) * of_pace * x, most));
  const Real stopped = grown * (1 - lesser(until * of_x, Real(1)));
  const Real started = elastic > 0 ? end : elastic, went_on = grown < 0 ? (end > 0 ? end : stopped) : end;
  return begins ? started : went_on;
}

}  // namespace slip

}  // namespace slipwave
