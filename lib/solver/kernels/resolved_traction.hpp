// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/slip_kernels.hpp"

/// The traction that the stress of a cell exerts on planes. For slip_level.cpp only: compiled once for each
/// instruction set, so everything here is inlined whatever a compiler thinks of it; the linker must not find
/// one copy for all.
namespace slipwave::solver {

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

/// Projections of one system.
template <int D, class Real>
struct OneSystem {
  static constexpr int tangents = D - 1, last = D == 2 ? 2 : 5;
  Real normal[last + 1], m1[last + 1], m2[last + 1];
  FrictionConstants<Real> law;
  [[gnu::always_inline]] explicit OneSystem(const SlipPlanes<Real>& planes) : law(planes.law[0]) {
    for (int c = 0; c <= last; ++c) {
      normal[c] = planes.normal[0][c];
      m1[c] = planes.shear[0][c];
      m2[c] = planes.shear[tangents - 1][c];
    }
  }
};

/// What a change (d1, d2) along the tangents is to component c of the stress.
template <int D, class Real>
[[gnu::always_inline]] inline Real along_planes(const OneSystem<D, Real>& system, int c, Real d1, Real d2) {
  const Real second = D == 3 ? system.m2[c] * d2 : Real(0);
  return system.m1[c] * d1 + second;
}

/// Prestress and opening of the planes of one system.
template <class Real>
struct OnSystem {
  const Real* __restrict const normal;
  const Real* __restrict const shear1;
  const Real* __restrict const shear2;
  const Real* __restrict const gaps;
  [[gnu::always_inline]] OnSystem(const SlipRows<Real>& rows, int tangents)
      : normal(rows.prestress),
        shear1(rows.prestress + rows.prestress_pitch),
        shear2(rows.prestress + tangents * rows.prestress_pitch),
        gaps(rows.gap[0]) {}
};

/// Strength of planes that may be open.
template <class Law, bool Extended, class Real>
[[gnu::always_inline]] inline Real strength_of(const FrictionConstants<Real>& law, Real s_n, Real slip_m,
                                               Real gap) {
  const Real shut = Law::strength(law, s_n, slip_m);
  return Extended && gap > 0 ? Real(0) : shut;
}

/// Strength of planes that may be open at the end of a step in which slip takes `loss` off the traction at
/// `strength`, theta c being `weighted`.
template <class Law, bool Extended, class Real>
[[gnu::always_inline]] inline Real strength_at_end(const FrictionConstants<Real>& law, Real s_n, Real slip_m,
                                                   Real slip_per_pa, Real gap, Real strength, Real weighted,
                                                   Real loss) {
  const Real share = weighted / greater(strength + weighted, slip::least<Real>);
  const Real shut = Law::strength_at_end(law, s_n, slip_m, slip_per_pa, loss, share);
  return Extended && gap > 0 ? Real(0) : shut;
}

/// Normal stress and traction along the planes of a cell, its length and the strength of the planes.
template <class Real>
struct ResolvedTraction {
  Real s_n, t1, t2, size, strength;
};

/// `slip_m` is the slip so far, for laws that have a state.
template <int D, class Law, bool Extended, class Real>
[[gnu::always_inline]] inline ResolvedTraction<Real> resolved_traction(const OneSystem<D, Real>& system,
                                                                       Real s0, Real s1, Real s2, Real s3,
                                                                       Real s4, Real s5,
                                                                       const OnSystem<Real>& on, Real slip_m,
                                                                       std::int64_t i) {
  Real s_n = projected<D>(system.normal, Real(1), s0, s1, s2, s3, s4, s5);
  Real t1 = projected<D>(system.m1, Real(0.5), s0, s1, s2, s3, s4, s5), t2 = 0;
  if constexpr (D == 3) t2 = projected<D>(system.m2, Real(0.5), s0, s1, s2, s3, s4, s5);
  if constexpr (Extended) {
    s_n += on.normal[i];
    t1 += on.shear1[i];
    if constexpr (D == 3) t2 += on.shear2[i];
  }
  const Real strength = strength_of<Law, Extended>(system.law, s_n, slip_m, Extended ? on.gaps[i] : Real(0));
  return {s_n, t1, t2, D == 2 ? (t1 < 0 ? -t1 : t1) : length(t1, t2), strength};
}

}  // namespace slipwave::solver
