// SPDX-License-Identifier: BSD-3-Clause
#include "solver/simulation.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "scene/surroundings.hpp"
#include "solver/banded_shot.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave {
namespace {

/// The samples recorded while the fields were sound, which they were for so many steps, and zeros after it.
Gather sound_part(Gather gather, const Recording& recording, std::int64_t steps, double dt_s) {
  std::int64_t sound = gather.axis.count;
  for (Recording shorter = recording; sound > 0; --sound) {
    shorter.duration_s = double(sound - 1) * recording.interval_s;
    if (solver::Recorder<2, float>::steps_needed(shorter, dt_s) <= steps) break;
  }
  for (auto& trace : gather.traces) {
    trace.samples.resize(std::min(trace.samples.size(), std::size_t(sound)));
    trace.samples.resize(std::size_t(gather.axis.count), 0);
  }
  return gather;
}

/// First divergence is searched for in at most so many cell steps: about ten seconds of a core.
constexpr double most_again = 2e9;

/// The first step at whose end the fields have diverged, and where. For that the shot is simulated again from
/// its beginning and checked after every step from the last check on that passed. Nothing where that would
/// take more than `most_again` cell steps.
template <int D, class Real>
std::optional<solver::DivergedFields<D>> first_divergence(const Scene<D>& scene, std::size_t shot,
                                                          const solver::Divergence<D>& seen, bool snapshots) {
  // As many cells are computed as the first time: all of them where there were snapshots.
  const auto nowhere = [](double, const FieldReader<D>&) {};
  solver::ShotSimulation<D, Real> again(scene, shot,
                                        snapshots ? SnapshotSink<D>(nowhere) : SnapshotSink<D>());
  const std::int64_t bad = seen.time.step + 1;
  if (double(bad) * double(again.domain().grid.size()) > most_again) return std::nullopt;
  try {
    again.run_to(solver::StabilityCheck<D, Real>::last_before(bad));
    while (again.done() < bad) {
      again.run_to(again.done() + 1);
      again.check_stability();
    }
  } catch (const solver::DivergedFields<D>& first) {
    return first;
  }
  return std::nullopt;
}

/// The error of a shot that became unstable, with the most exact place and time that can be found.
template <int D, class Real>
Unstable unstable(const Scene<D>& scene, std::size_t shot, solver::ShotSimulation<D, Real>& simulation,
                  const solver::DivergedFields<D>& seen, bool snapshots, Ranks* ranks) {
  const auto sound_until = [&](const std::string& what, std::int64_t sound) {
    const auto dt_s = seen.first().time.dt_s;
    return Unstable(what, shot, sound_part(simulation.take_gather(), scene.recording, sound, dt_s),
                    double(sound) * dt_s);
  };
  if (ranks)
    return sound_until(seen.what(), solver::StabilityCheck<D, Real>::last_before(seen.first().time.step + 1));
  const auto again = first_divergence<D, Real>(scene, shot, seen.first(), snapshots);
  const auto& found = again ? *again : seen;
  const auto& first = found.first();
  const auto checked = solver::StabilityCheck<D, Real>::last_before(first.time.step + 1);
  std::string what =
      std::string(found.what()) + "; " + surroundings(scene, shot, simulation.domain().from_model(first.at));
  // Between two checks it may have begun elsewhere.
  if (!again && first.box[0] != first.box[1])
    what += "; seen first in a box from " +
            place_of(simulation.domain().grid, simulation.domain().grid.flat(first.box[0])) + " to " +
            place_of(simulation.domain().grid, simulation.domain().grid.flat(first.box[1])) + ", sound " +
            std::to_string(first.time.step + 1 - checked) + " steps before";
  const auto sound = again ? first.time.step : checked;
  return sound_until(what, sound);
}

/// Runs a simulation to its end, interrupted by pauses.
template <class Simulation>
void run(Simulation& simulation, const Progress& progress, Pauses* pauses) {
  const Serialize serialize = [&simulation](Archive& archive) { simulation.serialize(archive); };
  std::function<bool()> wanted;
  if (pauses) {
    pauses->begin(serialize);
    wanted = [pauses] { return pauses->wanted(); };
  }
  for (;;) {
    simulation.run_to(simulation.steps(), progress, wanted);
    if (simulation.done() == simulation.steps()) return;
    pauses->pause(serialize, {simulation.done(), simulation.steps()});
  }
}

template <int D, class Real>
Gather shoot_in_bands(const Scene<D>& scene, std::size_t shot, const Progress& progress,
                      const SnapshotSink<D>& snapshots, Pauses* pauses, ShotReport* report, Ranks* ranks) {
  solver::BandedShot<D, Real> simulation(scene, shot, scene.snapshot_every_s ? snapshots : SnapshotSink<D>(),
                                         ranks);
  try {
    run(simulation, progress, pauses);
  } catch (const solver::DivergedFields<D>& seen) {
    const auto dt_s = seen.first().time.dt_s;
    const auto sound = solver::StabilityCheck<D, Real>::last_before(seen.first().time.step + 1);
    throw Unstable(seen.what(), shot, sound_part(simulation.take_gather(), scene.recording, sound, dt_s),
                   double(sound) * dt_s);
  }
  if (report) *report = simulation.report();
  return simulation.take_gather();
}

template <int D, class Real>
Gather shoot_as(const Scene<D>& scene, std::size_t shot, const Progress& progress,
                const SnapshotSink<D>& snapshots, Pauses* pauses, ShotReport* report, Ranks* ranks) {
  if (!scene.numerics.bands.empty())
    return shoot_in_bands<D, Real>(scene, shot, progress, snapshots, pauses, report, ranks);
  solver::ShotSimulation<D, Real> simulation(scene, shot, snapshots, ranks);
  try {
    run(simulation, progress, pauses);
  } catch (const solver::DivergedFields<D>& seen) {
    throw unstable(scene, shot, simulation, seen, bool(snapshots), ranks);
  }
  if (report) *report = simulation.report();
  return simulation.take_gather();
}

}  // namespace

template <int D>
Gather shoot(const Scene<D>& scene, std::size_t shot, const Progress& progress,
             const SnapshotSink<D>& snapshots, Pauses* pauses, ShotReport* report, Ranks* ranks) {
  return scene.numerics.double_precision
             ? shoot_as<D, double>(scene, shot, progress, snapshots, pauses, report, ranks)
             : shoot_as<D, float>(scene, shot, progress, snapshots, pauses, report, ranks);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, shoot);

}  // namespace slipwave
