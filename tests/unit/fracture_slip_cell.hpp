// One slip system in one cell, through the kernels that whole lines go through.
#pragma once

#include <array>

#include "fracture/joint_slip.hpp"
#include "solver/slip_planes.hpp"

namespace slipwave {

struct FirstOrder {
  static constexpr auto correction = SlipCorrection::first;
  /// What is kept from step to step.
  template <int D, class Real>
  using Memory = std::array<Real, 8>;
};
struct SecondOrder : FirstOrder {
  static constexpr auto correction = SlipCorrection::second;
};
struct Exponential : FirstOrder {
  static constexpr auto correction = SlipCorrection::exponential;
};

/// S = friction max(-s_n, 0) + cohesion_pa.
template <class Real>
struct SlipStrength {
  Real friction = 0, cohesion_pa = 0;
};

/// d = eta/(mu dt), 1/Pa: what the slip of a step is measured by, 1/c.
inline double slip_d(double viscosity_s, double mu_pa, double dt_s) {
  return 1 / slip::creep_pa(viscosity_s, mu_pa, dt_s);
}
inline double creep_of_d(double d) { return d > 1 / most_creep_pa ? 1 / d : most_creep_pa; }

namespace slip_cell {

template <class Correction, int D, class Real>
struct Call {
  solver::SlipPlanes<Real> planes;
  solver::SlipRows<Real> rows{};
  solver::SlipKernels<Real> kernels;
  Real creep;
};

template <class Correction, int D, class Real, class Vector>
Call<Correction, D, Real> call(const SlipStrength<Real>& law, const Vector& normal, Real creep) {
  Point<D> n{};
  for (std::size_t i = 0; i < D; ++i) n[i] = double(normal[i]);
  return {solver::planes_of<D, Real>({{n, double(law.friction), 0, double(law.cohesion_pa)}}),
          {},
          solver::slip_kernels<Real>({D, 1, Correction::correction, false}),
          creep};
}

}  // namespace slip_cell

/// What slip makes of the stress after an elastic step.
template <class Correction, int D, class Real>
void correct(const std::type_identity_t<SlipStrength<Real>>& law,
             const std::type_identity_t<Traction<D, Real>>& normal, double d, Stress<D, Real>& s,
             std::array<Real, 8>& memory) {
  auto call = slip_cell::call<Correction, D, Real>(law, normal, Real(creep_of_d(d)));
  call.rows = {s.values.data(), 1, {&call.creep, nullptr}, memory.data(), 1, nullptr, 0, {nullptr, nullptr}};
  call.kernels.slip(1, call.planes, call.rows);
}

/// What the next step begins with.
template <class Correction, int D, class Real>
void begin(const std::type_identity_t<SlipStrength<Real>>& law,
           const std::type_identity_t<Traction<D, Real>>& normal, double d, Stress<D, Real>& s,
           std::array<Real, 8>& memory) {
  auto call = slip_cell::call<Correction, D, Real>(law, normal, Real(creep_of_d(d)));
  call.rows = {s.values.data(), 1, {&call.creep, nullptr}, memory.data(), 1, nullptr, 0, {nullptr, nullptr}};
  call.kernels.begin(1, call.planes, call.rows);
}

template <int D, class Real>
Real normal_stress(const std::type_identity_t<Traction<D, Real>>& n, const Stress<D, Real>& s) {
  Traction<D, Real> tau;
  return resolve<D, Real>(n, s, tau);
}

}  // namespace slipwave
