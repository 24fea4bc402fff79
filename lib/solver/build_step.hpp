#pragma once

#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "solver/schedule/executor.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/time_step.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

template <int D, class Real>
using Effects = std::vector<std::unique_ptr<Effect<D, Real>>>;

/// The effects a shot of a scene calls for, in the order in which they act before recording. Fields are
/// `unit` times SI. Keep references to state, domain and scene. Collective where there are `ranks` (may be
/// null).
template <int D, class Real>
Effects<D, Real> build_effects(const Scene<D>& scene, std::size_t shot, State<D, Real>& state,
                               const Domain<D>& domain, double dt_s, double unit, Ranks* ranks);

/// The time step of the scene: its sweeps and, at the end of the step, effects and records. Makes sweeps use
/// the effects that filter them.
template <int D, class Real>
TimeStep<D, Real> build_time_step(const Scene<D>& scene, const Domain<D>& domain, Sweeps<D, Real>& sweeps,
                                  const Layout<D>& layout, const Effects<D, Real>& effects,
                                  const std::vector<Record<D, Real>*>& records, double dt_s,
                                  std::int64_t steps);

/// What is needed to execute it: in time tiles, or plainly where the scene asks for that. `halo` (may be
/// null): of neighbouring subdomains.
template <int D, class Real>
std::unique_ptr<Executor> make_executor(const Scene<D>& scene, const Domain<D>& domain, State<D, Real>& state,
                                        Sweeps<D, Real>& sweeps, TimeStep<D, Real>& step,
                                        Halo<D, Real>* halo);

}  // namespace slipwave::solver
