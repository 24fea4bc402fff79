// SPDX-License-Identifier: BSD-3-Clause
#include "model/slip_regime.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/tensor.hpp"

namespace slipwave {

template <int D>
PlanesUnderWave planes_under(const Model<D>& model, std::size_t cell, const SlipSystem<D>& system,
                             const WaveOnPlanes& wave) {
  const double omega = 2 * std::numbers::pi * wave.hz, strain = wave.strain_rate / omega;
  const double rho = double(model.medium.rho[cell]), vs = double(model.medium.vs[cell]),
               vp = double(model.medium.vp[cell]), mu = rho * vs * vs, modulus = rho * vp * vp;
  SymmetricTensor<D, double> stress;
  for (std::size_t c = 0; c < model.prestress_pa.size(); ++c)
    stress.values[c] = double(model.prestress_pa[c][cell]);
  Point<D> traction{};
  double pressed = std::max(-resolve<D, double>(system.normal, stress, traction), 0.);
  if (pressed == 0) pressed = modulus * strain;
  PlanesUnderWave of;
  of.strength_pa = system.friction * pressed + system.strength_pa;
  of.traction_pa = mu * strain;
  const double above_springs =
      mu / (1 + mu * compliance_in(system.compliance, modulus - 2 * mu, mu).tangential);
  if (of.strength_pa > 0) of.competing_viscosity_s = above_springs / (omega * of.strength_pa);
  return of;
}

template <int D>
PlanesUnderWave competing_slip(const Model<D>& model, std::size_t code, const WaveOnPlanes& wave) {
  std::vector<PlanesUnderWave> all;
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    if (model.fracture[cell] != code) continue;
    for (const auto& system : model.fracture_sets[code - 1].systems) {
      const auto of = planes_under(model, cell, system, wave);
      if (system.slides() && of.strength_pa > 0) all.push_back(of);
    }
  }
  if (all.empty())
    throw Error(
        "planes without friction and cohesion have no strength; no viscosity makes slip compete there",
        ErrorKind::usage);
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(), [](const auto& a, const auto& b) {
    return a.competing_viscosity_s < b.competing_viscosity_s;
  });
  return *middle;
}

BandGrowth band_growth(double friction, double vp, double vs) {
  // The acoustic tensor of the direction (c, s) in the frame of normal and slip (S28).
  constexpr int directions = 2000;
  const double p = vp * vp, m = vs * vs, lambda = p - 2 * m;
  BandGrowth most;
  for (int n = 0; n <= directions; ++n) {
    const double angle = std::numbers::pi / 2 * n / directions, c = std::cos(angle), s = std::sin(angle);
    const double d_n = m * s + friction * (lambda + 2 * m) * c, d_t = m * c + friction * lambda * s;
    const double nn = (p - m) * c * c + m - s * d_n, nt = (p - m) * c * s - s * d_t;
    const double tn = (p - m) * c * s - c * d_n, tt = (p - m) * s * s + m - c * d_t;
    const double trace = nn + tt, determinant = nn * tt - nt * tn;
    if (!(determinant < 0)) continue;
    const double slowest = trace / 2 - std::sqrt(trace * trace / 4 - determinant);
    most.dry_m_s = std::max(most.dry_m_s, std::sqrt(-slowest));
    most.relaxing = std::max(most.relaxing, -determinant / (p * m));
  }
  return most;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, planes_under);
SLIPWAVE_INSTANTIATE_D(FUNCTION, competing_slip);

}  // namespace slipwave
