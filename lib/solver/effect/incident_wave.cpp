// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/incident_wave.hpp"

#include "base/instantiate.hpp"
#include "scene/plane_wave.hpp"
#include "solver/effect/layered_wave.hpp"
#include "solver/effect/vertical_wave.hpp"

namespace slipwave::solver {

template <int D>
SweepClocks<D>::SweepClocks(std::vector<SweepFraction> sweeps, double dt_s)
    : sweeps_(std::move(sweeps)), dt_s_(dt_s) {
  for (const auto& sweep : sweeps_) along_last_ += sweep.axis == D - 1;
}

template <int D>
Clocks<D> SweepClocks<D>::before(const SweepTime& time) const {
  Clocks<D> clocks;
  std::array<double, std::size_t(D)> fractions{};
  clocks.along_last = time.step * along_last_;
  for (std::size_t n = 0; n < time.sweep; ++n) {
    fractions[std::size_t(sweeps_[n].axis)] += sweeps_[n].fraction;
    clocks.along_last += sweeps_[n].axis == D - 1;
  }
  for (std::size_t axis = 0; axis < D; ++axis)
    clocks.axis_s[axis] = (double(time.step) + fractions[axis]) * dt_s_;
  return clocks;
}

template <int D>
Clocks<D> SweepClocks<D>::after(const SweepTime& time, double fraction) const {
  auto clocks = before(time);
  const auto axis = sweeps_[time.sweep].axis;
  clocks.axis_s[std::size_t(axis)] += fraction * dt_s_;
  clocks.along_last += axis == D - 1;
  return clocks;
}

template <int D, class Real>
std::unique_ptr<IncidentWave<D, Real>> make_incident_wave(const Scene<D>& scene, const Source<D>& source,
                                                          const Domain<D>& domain, double dt_s,
                                                          const PlaneWaveGround<D>* of_bands) {
  const auto ground = of_bands ? *of_bands : ground_of_plane_wave(scene, source);
  auto wave = std::make_unique<LayeredWave<D, Real>>(scene, source, domain, ground, dt_s);
  if constexpr (D == 2)
    if (ground.way.kind == PlaneWaveKind::vertical)
      return make_vertical_wave<Real>(scene, source, std::move(wave), domain, dt_s);
  return wave;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SweepClocks);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, make_incident_wave);

}  // namespace slipwave::solver
