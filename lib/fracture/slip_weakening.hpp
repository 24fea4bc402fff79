// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fracture/friction_policy.hpp"

namespace slipwave {

/// Friction falls from q_s to q_d over a slip of D_c (S17; Ida 1972, J. Geophys. Res. 77(20)):
///   q = q_s - (q_s - q_d) min(slip/D_c, 1).
/// D_c -> infinity is Coulomb to the bit.
struct SlipWeakening : FrictionPolicy<SlipWeakening> {
  static constexpr bool has_state = true;

  template <class Real>
  [[gnu::always_inline]] static inline Real friction(const FrictionConstants<Real>& of, Real slip_m) {
    return of.friction - of.friction_drop * slip::lesser(slip_m * of.per_distance, Real(1));
  }
  template <class Real>
  [[gnu::always_inline]] static inline Real softening(const FrictionConstants<Real>& of, Real slip_m) {
    return slip_m * of.per_distance < 1 ? of.friction_drop * of.per_distance : Real(0);
  }
};

}  // namespace slipwave
