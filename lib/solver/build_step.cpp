#include "solver/build_step.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/pml.hpp"
#include "solver/effect/point_source.hpp"
#include "solver/effect/slip.hpp"
#include "solver/effect/sponge.hpp"
#include "solver/schedule/plain.hpp"
#include "solver/schedule/tiled.hpp"

namespace slipwave::solver {
namespace {

template <int D>
bool absorbs(const Scene<D>& scene, const Source<D>& source) {
  bool any = false;
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) any |= scene.edges[axis][side] == EdgeLaw::absorbing;
  return any && zone_cells(scene, source) > 0;
}

}  // namespace

template <int D, class Real>
Effects<D, Real> build_effects(const Scene<D>& scene, std::size_t shot, State<D, Real>& state,
                               const Domain<D>& domain, double dt_s, double unit, Ranks* ranks) {
  const auto& source = scene.survey.sources[shot - 1];
  const double vp_max = std::max(fastest_speed(scene.model.medium), scene.subdomain.fastest);
  const bool plane_wave = std::holds_alternative<PlaneWave<D>>(source.mechanism);
  Effects<D, Real> effects;
  if (absorbs(scene, source) && !plane_wave)
    effects.push_back(std::make_unique<Pml<D, Real>>(
        state.layout, domain, dt_s, vp_max, source.wavelet.nominal_hz(), scene.numerics.time_order, ranks));
  // Plane waves exist in 2-D only; check(scene) has made sure of it.
  if constexpr (D == 2) {
    if (plane_wave)
      effects.push_back(std::make_unique<Sponge<D, Real>>(
          state.layout, domain, dt_s, vp_max, make_plane_wave<Real>(scene, source, domain, dt_s)));
  }
  if (point_injection(source)) {
    auto point = std::make_unique<PointSource<D, Real>>(state, domain, scene, source, unit, ranks);
    if (!point->rows().empty()) effects.push_back(std::move(point));
  }
  if (scene.slips()) effects.push_back(std::make_unique<Slip<D, Real>>(state, domain, scene, dt_s, unit));
  return effects;
}

template <int D, class Real>
TimeStep<D, Real> build_time_step(const Scene<D>& scene, const Domain<D>& domain, Sweeps<D, Real>& sweeps,
                                  const Layout<D>& layout, const Effects<D, Real>& effects,
                                  const std::vector<Record<D, Real>*>& records, double dt_s,
                                  std::int64_t steps) {
  std::vector<Effect<D, Real>*> filters;
  std::vector<Entry<D, Real>> before, after, step;
  for (const auto& effect : effects) {
    const auto declared = effect->declaration();
    if (declared.filters_sweeps) {
      filters.push_back(effect.get());
      sweeps.use(effect.get());
    }
    if (declared.acts_on == ActsOn::nothing) continue;
    before.push_back(Apply<D, Real>{effect.get(), false});
    after.push_back(Apply<D, Real>{effect.get(), true});
  }
  // The effect that acts last before recording acts first after it: the step is symmetric about its end.
  std::reverse(after.begin(), after.end());
  for (const auto& [axis, fraction] : splitting(D, scene.numerics.time_order))
    step.push_back(Sweep<D, Real>{axis, fraction, filters});
  step.insert(step.end(), before.begin(), before.end());
  for (auto* record : records) step.push_back(Read<D, Real>{record});
  step.insert(step.end(), after.begin(), after.end());
  const bool all_needed = scene.slip_diary || (scene.snapshot_every_s && records.size() > 1);
  return {layout, dt_s, std::move(step), Patches<D>(layout, domain, scene.model), all_needed, steps};
}

template <int D, class Real>
std::unique_ptr<Executor> make_executor(const Scene<D>& scene, const Domain<D>& domain, State<D, Real>& state,
                                        Sweeps<D, Real>& sweeps, TimeStep<D, Real>& step,
                                        Halo<D, Real>* halo) {
  const auto& tiling = scene.numerics.tiling;
  if (tiling.plain) {
    if (halo) throw Error("the plain executor runs on one process only", ErrorKind::usage);
    return std::make_unique<PlainExecutor<D, Real>>(sweeps, state, step);
  }
  auto tiled = std::make_unique<TiledExecutor<D, Real>>(sweeps, state, step, tiling, domain.rows_beside());
  tiled->use(halo);
  return tiled;
}

template Effects<2, float> build_effects(const Scene<2>&, std::size_t, State<2, float>&, const Domain<2>&,
                                         double, double, Ranks*);
template TimeStep<2, float> build_time_step(const Scene<2>&, const Domain<2>&, Sweeps<2, float>&,
                                            const Layout<2>&, const Effects<2, float>&,
                                            const std::vector<Record<2, float>*>&, double, std::int64_t);
template std::unique_ptr<Executor> make_executor(const Scene<2>&, const Domain<2>&, State<2, float>&,
                                                 Sweeps<2, float>&, TimeStep<2, float>&, Halo<2, float>*);
template Effects<2, double> build_effects(const Scene<2>&, std::size_t, State<2, double>&, const Domain<2>&,
                                          double, double, Ranks*);
template TimeStep<2, double> build_time_step(const Scene<2>&, const Domain<2>&, Sweeps<2, double>&,
                                             const Layout<2>&, const Effects<2, double>&,
                                             const std::vector<Record<2, double>*>&, double, std::int64_t);
template std::unique_ptr<Executor> make_executor(const Scene<2>&, const Domain<2>&, State<2, double>&,
                                                 Sweeps<2, double>&, TimeStep<2, double>&, Halo<2, double>*);
template Effects<3, float> build_effects(const Scene<3>&, std::size_t, State<3, float>&, const Domain<3>&,
                                         double, double, Ranks*);
template TimeStep<3, float> build_time_step(const Scene<3>&, const Domain<3>&, Sweeps<3, float>&,
                                            const Layout<3>&, const Effects<3, float>&,
                                            const std::vector<Record<3, float>*>&, double, std::int64_t);
template std::unique_ptr<Executor> make_executor(const Scene<3>&, const Domain<3>&, State<3, float>&,
                                                 Sweeps<3, float>&, TimeStep<3, float>&, Halo<3, float>*);
template Effects<3, double> build_effects(const Scene<3>&, std::size_t, State<3, double>&, const Domain<3>&,
                                          double, double, Ranks*);
template TimeStep<3, double> build_time_step(const Scene<3>&, const Domain<3>&, Sweeps<3, double>&,
                                             const Layout<3>&, const Effects<3, double>&,
                                             const std::vector<Record<3, double>*>&, double, std::int64_t);
template std::unique_ptr<Executor> make_executor(const Scene<3>&, const Domain<3>&, State<3, double>&,
                                                 Sweeps<3, double>&, TimeStep<3, double>&, Halo<3, double>*);

}  // namespace slipwave::solver
