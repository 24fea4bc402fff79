#include "solver/simulation.hpp"

#include <algorithm>

#include "solver/step.hpp"

namespace slipwave {
namespace {

template <int D, class Real>
Gather shoot_as(const Scene<D>& scene, std::size_t shot, const Progress& progress,
                const SnapshotSink<D>& snapshots, Pauses* pauses, ShotReport* report) {
  solver::Step<D, Real> step(scene, shot, snapshots);
  const Keep keep = [&step](Archive& archive) { step.keep(archive); };
  std::function<bool()> wanted;
  if (pauses) {
    pauses->begin(keep);
    wanted = [pauses] { return pauses->wanted(); };
  }
  for (;;) {
    step.run_to(step.steps(), progress, wanted);
    if (step.done() == step.steps()) break;
    pauses->pause(keep, {step.done(), step.steps()});
  }
  if (report) *report = step.report();
  return step.take_gather();
}

}  // namespace

template <int D>
Gather shoot(const Scene<D>& scene, std::size_t shot, const Progress& progress,
             const SnapshotSink<D>& snapshots, Pauses* pauses, ShotReport* report) {
  return scene.numerics.double_precision
             ? shoot_as<D, double>(scene, shot, progress, snapshots, pauses, report)
             : shoot_as<D, float>(scene, shot, progress, snapshots, pauses, report);
}

template <int D>
std::int64_t memory_of_a_shot_bytes(const Scene<D>& scene) {
  std::int64_t widest = 0, cells = 1;
  for (const auto& source : scene.survey.sources)
    widest = std::max<std::int64_t>(widest, zone_cells(scene, source));
  for (const auto n : scene.model.grid().shape) cells *= n + 2 * widest;
  const std::int64_t value = scene.numerics.double_precision ? sizeof(double) : sizeof(float);
  return cells * value * (solver::FieldRows<D>::count + solver::material_rows);
}

template std::int64_t memory_of_a_shot_bytes(const Scene<2>&);
template Gather shoot(const Scene<2>&, std::size_t, const Progress&, const SnapshotSink<2>&, Pauses*,
                      ShotReport*);

}  // namespace slipwave
