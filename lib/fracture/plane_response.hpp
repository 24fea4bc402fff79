// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fracture/slip_law.hpp"
#include "grid/tensor.hpp"

namespace slipwave {

/// What slip on planes askew to the axes of anisotropic rock takes off the stress of a cell (theory.md (S34),
/// (S34a)).
template <int D, class Real>
struct PlaneResponse;

/// In 2-D of slip that takes 1 off the traction along (-n_z, n_x).
template <class Real>
struct PlaneResponse<2, Real> {
  SymmetricTensor<2, Real> stress;
};

/// In 3-D of slip that takes 1 off the traction along one of two directions in the planes, at right angles,
/// along which slip changes no other traction. `share` is the modulus of each over the larger one, by which
/// the relaxation of the planes counts.
template <class Real>
struct PlaneResponse<3, Real> {
  using Vector = std::array<Real, 3>;
  std::array<Vector, 2> along;
  std::array<SymmetricTensor<3, Real>, 2> stress;
  std::array<Real, 2> share;

  /// Components of a traction.
  std::array<Real, 2> components(const Vector& traction) const {
    std::array<Real, 2> of{};
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < 3; ++i) of[k] += along[k][i] * traction[i];
    return of;
  }
  Vector traction(const std::array<Real, 2>& components) const {
    Vector of{};
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < 3; ++i) of[i] += along[k][i] * components[k];
    return of;
  }
  /// Returns what slip along a traction takes off it; where both moduli are the larger one, that has the size
  /// 1.
  Vector loss_along(const Vector& tau, Real size) const {
    auto of = components(tau);
    for (std::size_t k = 0; k < 2; ++k) of[k] *= share[k] / size;
    return traction(of);
  }
  /// Returns the component of loss_along() along the traction.
  Real share_along(const Vector& tau, Real size) const {
    const auto of = components(tau);
    return (share[0] * of[0] * of[0] + share[1] * of[1] * of[1]) / (size * size);
  }
  /// The size of the slip that took this off a traction, times the larger modulus.
  Real slip_size(const Vector& loss) const {
    const auto of = components(loss);
    return std::hypot(of[0] / share[0], of[1] / share[1]);
  }
  /// What the rule of the end of a step takes off the traction tau_e = tau (S34a): slip is along what it
  /// leaves. Newton's method for a falling convex function, from below.
  Vector relaxed(const Vector& tau, Real strength, Real weighted_relaxation) const {
    const auto given = components(tau);
    const Real size = std::hypot(given[0], given[1]);
    if (!(weighted_relaxation > 0 && size > strength)) return {};
    // Of planes without strength nothing is left.
    if (!(strength > std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon() * size))
      return traction(given);
    // Over the strength; the traction that is left is given/(1 + slip share), its size 1/(1 - slip drag).
    const std::array<Real, 2> of = {given[0] / strength, given[1] / strength};
    const Real drag = strength / weighted_relaxation, over = size / strength - 1;
    Real slip = over / (1 + drag * (1 + over));
    constexpr int most_steps = 40;
    for (int step = 0; step < most_steps; ++step) {
      Real square = 0, slope = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        const Real stays = 1 / (1 + slip * share[k]), left = of[k] * stays;
        square += left * left, slope -= left * left * share[k] * stays;
      }
      const Real left = std::sqrt(square), carried = 1 - slip * drag;
      const Real excess = left * carried - 1, falls = slope / left * carried - left * drag;
      const Real more = -excess / falls;
      if (!(more > std::numeric_limits<Real>::epsilon() * slip)) break;
      slip += more;
    }
    std::array<Real, 2> off{};
    for (std::size_t k = 0; k < 2; ++k) off[k] = given[k] * (slip * share[k] / (1 + slip * share[k]));
    return traction(off);
  }
};

}  // namespace slipwave
