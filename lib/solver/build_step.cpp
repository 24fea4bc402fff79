// SPDX-License-Identifier: BSD-3-Clause
#include "solver/build_step.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "scene/splitting.hpp"
#include "scene/subdomains.hpp"
#include "solver/effect/attenuation.hpp"
#include "solver/effect/incident_pml.hpp"
#include "solver/effect/linear_slip.hpp"
#include "solver/effect/pml.hpp"
#include "solver/effect/point_source.hpp"
#include "solver/effect/slip.hpp"
#include "solver/schedule/band_face.hpp"
#include "solver/schedule/plain.hpp"
#include "solver/schedule/tiled.hpp"

namespace slipwave::solver {
namespace {

template <int D>
bool absorbs(const Scene<D>& scene, const Source<D>& source) {
  return any_edge_absorbs(scene) && zone_cells(scene, source) > 0;
}

/// Friction comes after the springs under it.
template <int D, class Real>
void add_slip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s, double unit,
              const InjectedStress<D, Real>& injected, Effects<D, Real>& all) {
  const auto& sets = scene.model.fracture_sets;
  if (!scene.slips()) return;
  if (std::any_of(sets.begin(), sets.end(), gives<D>))
    all.push_back(std::make_unique<LinearSlip<D, Real>>(state, domain, scene, dt_s, unit, injected));
  if (std::any_of(sets.begin(), sets.end(), slides<D>))
    all.push_back(std::make_unique<Slip<D, Real>>(state, domain, scene, dt_s, unit));
}

/// The sweeps of a step and, after the middle one of those along the last axis, what acts between sweeps.
template <int D, class Real>
void add_sweeps(const std::vector<SweepFraction>& sweeps, const std::vector<Effect<D, Real>*>& filters,
                const std::vector<Entry<D, Real>>& between, std::vector<Entry<D, Real>>& step) {
  std::vector<std::size_t> along_last;
  for (std::size_t n = 0; n < sweeps.size(); ++n)
    if (sweeps[n].axis == D - 1) along_last.push_back(n);
  for (std::size_t n = 0; n < sweeps.size(); ++n) {
    step.push_back(Sweep<D, Real>{sweeps[n].axis, sweeps[n].fraction, filters});
    if (n == along_last[(along_last.size() - 1) / 2]) step.insert(step.end(), between.begin(), between.end());
  }
}

}  // namespace

template <int D, class Real>
Effects<D, Real> StepBuilder<D, Real>::effects(std::size_t shot, double unit, Ranks* ranks,
                                               const PlaneWaveGround<D>* of_bands) const {
  const auto& source = scene.survey.sources[shot - 1];
  const double vp_max = fastest_speed(scene.model.medium, scene.subdomain);
  const bool plane_wave = std::holds_alternative<PlaneWave<D>>(source.mechanism);
  Effects<D, Real> all;
  if (absorbs(scene, source)) {
    const auto settings = plane_wave ? pml_of_plane_wave(scene) : PmlSettings{};
    auto pml = std::make_unique<Pml<D, Real>>(state.layout, domain, dt_s, vp_max, source.wavelet.nominal_hz(),
                                              scene.numerics.time_order, ranks, settings);
    if (plane_wave)
      all.push_back(std::make_unique<IncidentPml<D, Real>>(
          state.layout, domain, std::move(pml), settings,
          make_incident_wave<D, Real>(scene, source, domain, dt_s, of_bands),
          SweepClocks<D>(splitting(D, scene.numerics.time_order), dt_s)));
    else
      all.push_back(std::move(pml));
  }
  std::vector<PointSource<D, Real>*> points;
  for (const auto* each : scene.survey.sources_of(shot)) {
    if (!point_injection(*each)) continue;
    auto point = std::make_unique<PointSource<D, Real>>(state, domain, scene, *each, unit, ranks);
    if (point->rows().empty()) continue;
    points.push_back(point.get());
    all.push_back(std::move(point));
  }
  const InjectedStress<D, Real> injected(std::move(points));
  if (scene.attenuates())
    all.push_back(std::make_unique<RelaxingStress<D, Real>>(state.layout, domain, scene, dt_s, injected));
  add_slip<D, Real>(state, domain, scene, dt_s, unit, injected, all);
  return all;
}

template <int D, class Real>
TimeStep<D, Real> StepBuilder<D, Real>::time_step(Sweeps<D, Real>& sweeps, const Effects<D, Real>& effects,
                                                  const std::vector<Record<D, Real>*>& records,
                                                  std::int64_t steps) const {
  if (scene.numerics.monotone) sweeps.keep_monotone();
  std::vector<Effect<D, Real>*> filters;
  std::vector<Entry<D, Real>> before, after, between, step;
  for (const auto& effect : effects) {
    const auto declared = effect->declaration();
    if (declared.filters_sweeps) {
      filters.push_back(effect.get());
      sweeps.use(effect.get());
    }
    if (declared.between_sweeps) between.push_back(Between<D, Real>{effect.get()});
    if (declared.acts_on == ActsOn::nothing) continue;
    before.push_back(Apply<D, Real>{effect.get(), false});
    after.push_back(Apply<D, Real>{effect.get(), true});
  }
  // The effect that acts last before recording acts first after it: the step is symmetric about its end.
  std::reverse(after.begin(), after.end());
  add_sweeps(splitting(D, scene.numerics.time_order), filters, between, step);
  step.insert(step.end(), before.begin(), before.end());
  for (auto* record : records) step.push_back(Read<D, Real>{record});
  step.insert(step.end(), after.begin(), after.end());
  const bool all_needed = scene.slip_diary || (scene.snapshot_every_s && records.size() > 1);
  return {state.layout, dt_s, std::move(step), Patches<D>(state.layout, domain, scene.model),
          all_needed,   steps};
}

template <int D, class Real>
std::unique_ptr<Executor> StepBuilder<D, Real>::executor(Sweeps<D, Real>& sweeps, TimeStep<D, Real>& step,
                                                         Halo<D, Real>* halo) const {
  const auto& tiling = scene.numerics.tiling;
  if (tiling.plain) {
    if (halo && !scene.subdomain.in_bands())
      throw Error("the plain executor runs on one process only", ErrorKind::usage);
    auto plain = std::make_unique<PlainExecutor<D, Real>>(sweeps, state, step);
    plain->use(halo);
    return plain;
  }
  // Bands of cells read rows of each other while what is beside them is swept.
  const auto shared =
      domain.rows_beside() + (scene.subdomain.in_bands() ? BandFace<D, Real>::most_rows_read : 0);
  auto tiled = std::make_unique<TiledExecutor<D, Real>>(sweeps, state, step, tiling, shared);
  tiled->use(halo);
  return tiled;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, struct StepBuilder);

}  // namespace slipwave::solver
