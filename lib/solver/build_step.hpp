// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "scene/plane_wave.hpp"
#include "scene/scene.hpp"
#include "solver/schedule/executor.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/time_step.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

template <int D, class Real>
using Effects = std::vector<std::unique_ptr<Effect<D, Real>>>;

/// Builds the time step of a scene. What it builds keeps references to its members.
template <int D, class Real>
struct StepBuilder {
  const Scene<D>& scene;
  const Domain<D>& domain;
  State<D, Real>& state;
  double dt_s;

  /// The effects of a shot, in the order in which they act before recording. Fields are `unit` times SI.
  /// Collective where there are `ranks` (may be null). `of_bands` as make_incident_wave() takes it.
  Effects<D, Real> effects(std::size_t shot, double unit, Ranks* ranks,
                           const PlaneWaveGround<D>* of_bands = nullptr) const;
  /// The time step: its sweeps and, at the end of the step, effects and records. Makes sweeps use the effects
  /// that filter them.
  TimeStep<D, Real> time_step(Sweeps<D, Real>& sweeps, const Effects<D, Real>& effects,
                              const std::vector<Record<D, Real>*>& records, std::int64_t steps) const;
  /// The executor: tiled, or plain where the scene says so. `halo` (may be null): exchange with neighbouring
  /// subdomains.
  std::unique_ptr<Executor> executor(Sweeps<D, Real>& sweeps, TimeStep<D, Real>& step,
                                     Halo<D, Real>* halo) const;
};

}  // namespace slipwave::solver
