// SPDX-License-Identifier: BSD-3-Clause
// One slip system in one cell, through the kernels that whole lines go through.
#pragma once

#include <array>

#include "fracture/coulomb.hpp"
#include "fracture/joint_slip.hpp"
#include "fracture/slip_weakening.hpp"
#include "solver/effect/slip_planes.hpp"

namespace slipwave {

struct FirstOrder {
  static constexpr auto correction = SlipCorrection::first;
  /// What is retained from step to step.
  template <int D, class Real>
  using Memory = std::array<Real, 8>;
};
struct SecondOrder : FirstOrder {
  static constexpr auto correction = SlipCorrection::second;
};
struct Exponential : FirstOrder {
  static constexpr auto correction = SlipCorrection::exponential;
};

/// S = friction max(-s_n, 0) + cohesion_pa; with slip weakening friction falls by slip.
template <class Real>
struct SlipStrength {
  Real friction = 0, cohesion_pa = 0;
  FrictionLaw law = FrictionLaw::coulomb;
  double dynamic_friction = 0, slip_distance_m = 0, slip_per_pa = 0;
};
/// Where Memory has the slip so far, m.
inline constexpr std::size_t slip_in_memory = 7;

/// d = eta/(mu dt), 1/Pa: what the slip of a step is measured by, 1/c.
inline double slip_d(double viscosity_s, double mu_pa, double dt_s) {
  return 1 / slip::relaxation_pa(viscosity_s, mu_pa, dt_s);
}
inline double relaxation_of_d(double d) { return d > 1 / most_relaxation_pa ? 1 / d : most_relaxation_pa; }

namespace slip_cell {

/// A kernel of one system on one cell.
template <class Correction, int D, class Real>
void run(const SlipStrength<Real>& law, const Traction<D, Real>& normal, double d, Stress<D, Real>& s,
         std::array<Real, 8>& memory, bool begins) {
  Point<D> n{};
  for (std::size_t i = 0; i < D; ++i) n[i] = double(normal[i]);
  const auto planes = solver::planes_of<D, Real>({{n, double(law.friction), 0, double(law.cohesion_pa), false,
                                                   law.law, law.dynamic_friction, law.slip_distance_m}});
  const auto kernels = solver::slip_kernels<Real>({D, 1, Correction::correction, false, law.law});
  const Real relaxation = Real(relaxation_of_d(d));
  const Real slip_per_pa = Real(law.slip_per_pa);
  (begins ? kernels.begin : kernels.slip)(1, planes,
                                          {s.values.data(),
                                           1,
                                           {&relaxation, nullptr},
                                           memory.data(),
                                           1,
                                           nullptr,
                                           0,
                                           {nullptr, nullptr},
                                           {&memory[slip_in_memory], nullptr},
                                           &slip_per_pa});
}

}  // namespace slip_cell

/// What slip makes of the stress after an elastic step.
template <class Correction, int D, class Real>
void correct(const std::type_identity_t<SlipStrength<Real>>& law,
             const std::type_identity_t<Traction<D, Real>>& normal, double d, Stress<D, Real>& s,
             std::array<Real, 8>& memory) {
  slip_cell::run<Correction, D, Real>(law, normal, d, s, memory, false);
}

/// What the next step begins with.
template <class Correction, int D, class Real>
void begin(const std::type_identity_t<SlipStrength<Real>>& law,
           const std::type_identity_t<Traction<D, Real>>& normal, double d, Stress<D, Real>& s,
           std::array<Real, 8>& memory) {
  slip_cell::run<Correction, D, Real>(law, normal, d, s, memory, true);
}

template <int D, class Real>
Real normal_stress(const std::type_identity_t<Traction<D, Real>>& n, const Stress<D, Real>& s) {
  Traction<D, Real> tau;
  return resolve<D, Real>(n, s, tau);
}

}  // namespace slipwave
