// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fracture/slip_law.hpp"

/// The interface of a friction law. Each law has a header of its own (coulomb.hpp, slip_weakening.hpp) and
/// overrides hooks of FrictionPolicy; kernels, the solver of crossing planes and tests take the law as a
/// template parameter. Made for the inner loop, under the rules of slip_law.hpp.
namespace slipwave {

/// Names of the laws, in the order in which model files number them. Planes with none never slide: they give
/// as far as their compliance says.
enum class FrictionLaw { coulomb, slip_weakening, none };

/// Constants of one slip system in the unit that stress has. A law reads those that it knows.
template <class Real>
struct FrictionConstants {
  Real friction = 0, cohesion_pa = 0;
  Real friction_drop = 0, per_distance = 0;  // slip weakening: q_s - q_d; 1/D_c, 1/m
};

/// Largest slip stored, m: sums and products of it stay finite.
inline constexpr double most_slip_m = 1e6, most_per_distance = 1e30;

/// What all laws share. A law overrides
///   has_state   whether strength depends on the slip so far, which is then stored for each cell and system;
///   friction    coefficient of friction at that slip;
///   softening   -d friction/d slip, 1/m.
template <class Law>
struct FrictionPolicy {
  static constexpr bool has_state = false;

  template <class Real>
  [[gnu::always_inline]] static inline Real friction(const FrictionConstants<Real>& of, Real /*slip_m*/) {
    return of.friction;
  }
  template <class Real>
  [[gnu::always_inline]] static inline Real softening(const FrictionConstants<Real>&, Real /*slip_m*/) {
    return 0;
  }

  /// S of shut planes (S2). Open ones have none.
  template <class Real>
  [[gnu::always_inline]] static inline Real strength(const FrictionConstants<Real>& of, Real s_n,
                                                     Real slip_m) {
    return Law::friction(of, slip_m) * slip::greater(-s_n, Real(0)) + of.cohesion_pa;
  }

  /// S at the end of a step (S17): by one step of Newton's method from `loss`, what slip takes off the
  /// traction at a strength that stays, of which a change of the strength by 1 takes off `share` less.
  /// `slip_per_pa` is h/mu.
  template <class Real>
  [[gnu::always_inline]] static inline Real strength_at_end(const FrictionConstants<Real>& of, Real s_n,
                                                            Real slip_m, Real slip_per_pa, Real loss,
                                                            Real share) {
    const Real weakening = Law::softening(of, slip_m) * slip::greater(-s_n, Real(0)) * slip_per_pa;
    // From 1 on slip runs away, to where the law softens no more.
    const Real stays = slip::greater(1 - weakening * share, Real(1e-6));
    return strength(of, s_n, slip_after(slip_m, slip_per_pa, loss / stays));
  }

  /// The state after slip that took `loss` off the traction.
  template <class Real>
  [[gnu::always_inline]] static inline Real slip_after(Real slip_m, Real slip_per_pa, Real loss) {
    return slip::lesser(slip_m + slip_per_pa * loss, Real(most_slip_m));
  }
};

}  // namespace slipwave
