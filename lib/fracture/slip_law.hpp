#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "grid/tensor.hpp"

/// Coulomb slip with a small viscosity on planes of one orientation, and what it does to the stress of a cell
/// after an elastic step (docs/theory.md, section 2; Nikitin & Golubev 2021, J. Sib. Fed. Univ. 14(6)).
///
///   s      stress, tension positive                        Pa
///   n      unit normal of the slip planes                  1
///   s_n    n.s.n, normal stress                            Pa   (S1)
///   tau    s.n - s_n n, shear traction, D components       Pa   (S1)
///   S      q max(-s_n, 0) + cohesion, strength             Pa   (S2)
///   q      friction, cohesion: strength of an unloaded plane   1, Pa
///   eta    viscosity of the planes                         s
///   g      slip strain rate, |tau| = S (1 + eta |g|) while slipping   1/s   (S3)
///   mu     shear modulus of the rock between the planes    Pa
///   d      eta/(mu dt)                                     1/Pa
///   tau_e  shear traction after the elastic step           Pa
///   G      mu dt g, what a step of slip at rate g takes off the shear traction   Pa
///
/// Everything here is meant for the inner loop over fracture cells: no allocation, nothing virtual, no
/// division by a quantity that may be zero. Finite stress gives finite stress for every eta >= 0, mu >= 0,
/// dt >= 0, q >= 0 and cohesion >= 0, zero and enormous values included.
namespace slipwave {

template <int D, class Real>
using Stress = SymmetricTensor<D, Real>;
template <int D, class Real>
using Traction = std::array<Real, std::size_t(D)>;

/// What of a slip system the strength needs; S = friction max(-s_n, 0) + cohesion_pa.
template <class Real>
struct SlipStrength {
  Real friction = 0;
  Real cohesion_pa = 0;
};

/// d S above this means: no slip. Its reciprocal is still a normal float.
inline constexpr double slip_d_limit = 1e30;

/// d = eta/(mu dt) in 1/Pa, for every slip system and cell (of that mu) once before the time loop. Computed
/// in double and held within 0 .. 1e30, so that it is finite in Real whatever the arguments: dry friction
/// (eta = 0) gives 0, mu = 0 or dt = 0 (nothing for slip to relax) the upper end.
template <class Real>
Real slip_d(double eta_s, double mu_pa, double dt_s) {
  if (!(eta_s > 0)) return Real(0);
  const double d = eta_s / mu_pa / dt_s;  // in this order: mu dt may underflow
  return d < slip_d_limit ? Real(d) : Real(slip_d_limit);
}

namespace slip {

template <std::size_t N, class Real>
Real dot(const std::array<Real, N>& a, const std::array<Real, N>& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

/// Length of a vector; its squares neither overflow nor vanish, whatever the unit its amplitude amounts to.
template <std::size_t N, class Real>
Real length(const std::array<Real, N>& a) {
  Real largest = 0;
  for (const Real component : a) largest = std::max(largest, std::abs(component));
  if (!(largest > 0)) return largest;
  Real sum = 0;
  for (const Real component : a) sum += (component / largest) * (component / largest);
  return largest * std::sqrt(sum);
}

/// The share of `magnitude` that is left when slip of the step's end, weighted by theta, has been taken off:
/// |tau| + theta G = magnitude with G = (|tau|/S - 1)/d, that is |tau| = S (theta + d magnitude)/(theta + d
/// S), in a form that takes S = 0, d = 0 and an overflowing d S. `excess` becomes |tau| - S, or 0 below S.
template <class Real>
Real share_left(Real magnitude, Real strength, Real ds, Real theta, Real& excess) {
  excess = 0;
  if (!(magnitude >= strength)) return Real(1);
  // Both are zero where the plane has no strength and no load; then nothing is left of nothing.
  const Real reciprocal = Real(1) / std::max(magnitude, std::numeric_limits<Real>::min());
  excess = (magnitude - strength) * (ds / (ds + theta));
  return std::min(Real(1), (strength + excess) * reciprocal);
}

/// d S, finite.
template <class Real>
Real bounded_ds(Real d, Real strength) {
  return std::min(d * strength, Real(slip_d_limit));
}

}  // namespace slip

/// A correction is a policy: the memory it keeps for a slip system in a cell (value-initialised before the
/// first step), and the shear traction at the end of the step from that after the elastic step, the strength
/// S at the end of the step and d. What slip at the rate of that instant takes off the shear traction before
/// the next elastic step it leaves in `ahead` of its memory (begin() applies it); a correction without such a
/// part has none.

/// Implicit Euler, first order in time (theory.md (S5); Nikitin & Golubev 2021 eq. 15-17).
struct FirstOrder {
  static constexpr const char* name = "first";

  template <int D, class Real>
  struct Memory {};

  template <int D, class Real>
  static Traction<D, Real> shear(Traction<D, Real> tau_e, Real strength, Real d, Memory<D, Real>&) {
    const Real magnitude = slip::length(tau_e);
    Real excess;
    const Real left = slip::share_left(magnitude, strength, slip::bounded_ds(d, strength), Real(1), excess);
    for (auto& component : tau_e) component *= left;
    return tau_e;
  }
};

/// Trapezoidal rule, second order in time (theory.md (S6), (S7); Nikitin & Golubev 2021 eq. 40-49): half of
/// the slip of a step goes at the rate of its beginning and is taken before the waves move, half at the rate
/// of its end, after. Where a step is longer than four times the relaxation time d S dt the weight of the end
/// grows to 1 - 2 d S: the plain rule rings there, this one does not, and at d = 0 it is dry friction
/// exactly. Neither half ever raises |tau|.
struct SecondOrder {
  static constexpr const char* name = "second";

  template <int D, class Real>
  struct Memory {
    Traction<D, Real> ahead{};  // what the beginning of the next step takes off tau: (1 - theta) G, Pa
    Real theta = Real(0.5);     // weight of the end of that step
  };

  template <int D, class Real>
  static Traction<D, Real> shear(Traction<D, Real> tau_e, Real strength, Real d, Memory<D, Real>& memory) {
    const Real ds = slip::bounded_ds(d, strength);
    const Real magnitude = slip::length(tau_e);
    Real excess;
    const Real left = slip::share_left(magnitude, strength, ds, memory.theta, excess);
    memory.theta = std::max(Real(0.5), Real(1) - Real(2) * ds);
    // G = (|tau|/S - 1)/d; where theta > 1/2 this is 2 (|tau| - S), so that no small d S divides.
    const Real begin = memory.theta > Real(0.5) ? Real(2) * excess : Real(0.5) * excess / ds;
    const Real share = begin / std::max(magnitude, std::numeric_limits<Real>::min());
    for (std::size_t i = 0; i < D; ++i) {
      memory.ahead[i] = share * tau_e[i];
      tau_e[i] *= left;
    }
    return tau_e;
  }
};

/// s_n of a plane (S1).
template <int D, class Real>
Real normal_stress(const std::type_identity_t<Traction<D, Real>>& normal, const Stress<D, Real>& s) {
  Real sum = 0;
  for (int i = 0; i < D; ++i) {
    Real traction = 0;
    for (int j = 0; j < D; ++j) traction += s(i, j) * normal[std::size_t(j)];
    sum += normal[std::size_t(i)] * traction;
  }
  return sum;
}

/// s += change n + n change.
template <int D, class Real>
void add_shear(Stress<D, Real>& s, const std::type_identity_t<Traction<D, Real>>& change,
               const std::type_identity_t<Traction<D, Real>>& normal) {
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      s(i, j) +=
          change[std::size_t(i)] * normal[std::size_t(j)] + change[std::size_t(j)] * normal[std::size_t(i)];
}

/// One slip system of one cell at the end of an elastic step: s (total stress, Pa) loses what slip on the
/// planes relaxes, s += (tau - tau_e) n + n (tau - tau_e) (S4). s_n is untouched, and so is all of s that
/// does not shear the planes. `d` is slip_d() of the cell, `memory` the correction's for this cell and
/// system.
template <class Correction, int D, class Real>
void correct(const std::type_identity_t<SlipStrength<Real>>& law,
             const std::type_identity_t<Traction<D, Real>>& normal, std::type_identity_t<Real> d,
             Stress<D, Real>& s, typename Correction::template Memory<D, Real>& memory) {
  Traction<D, Real> tau_e;
  for (int i = 0; i < D; ++i) {
    tau_e[std::size_t(i)] = 0;
    for (int j = 0; j < D; ++j) tau_e[std::size_t(i)] += s(i, j) * normal[std::size_t(j)];
  }
  const Real s_n = slip::dot(normal, tau_e);
  for (std::size_t i = 0; i < D; ++i) tau_e[i] -= s_n * normal[i];
  // n is a unit vector to rounding only; without the second projection s_n would drift over many steps.
  const Real residue = slip::dot(normal, tau_e);
  for (std::size_t i = 0; i < D; ++i) tau_e[i] -= residue * normal[i];

  const Real strength = law.friction * std::max(-s_n, Real(0)) + law.cohesion_pa;
  const Traction<D, Real> tau = Correction::template shear<D, Real>(tau_e, strength, d, memory);

  Traction<D, Real> change;
  for (std::size_t i = 0; i < D; ++i) change[i] = tau[i] - tau_e[i];
  add_shear(s, change, normal);
}

/// The slip that a step begins with, before the elastic step and after whoever wants the fields of this
/// instant has seen them. Nothing in the first step, nothing for corrections that have no such part.
template <class Correction, int D, class Real>
void begin(const std::type_identity_t<Traction<D, Real>>& normal, Stress<D, Real>& s,
           const typename Correction::template Memory<D, Real>& memory) {
  if constexpr (requires { memory.ahead; }) {
    Traction<D, Real> change;
    for (std::size_t i = 0; i < D; ++i) change[i] = -memory.ahead[i];
    add_shear(s, change, normal);
  }
}

}  // namespace slipwave
