#include "solver/simulation.hpp"

#include "solver/step.hpp"

namespace slipwave {
namespace {

template <int D, class Real>
Gather shoot_as(const Scene<D>& scene, std::size_t shot, const Progress& progress,
                const SnapshotSink<D>& snapshots) {
  solver::Step<D, Real> step(scene, shot, snapshots);
  step.run_to(step.steps(), progress);
  return step.take_gather();
}

}  // namespace

template <int D>
Gather shoot(const Scene<D>& scene, std::size_t shot, const Progress& progress,
             const SnapshotSink<D>& snapshots) {
  return scene.numerics.double_precision ? shoot_as<D, double>(scene, shot, progress, snapshots)
                                         : shoot_as<D, float>(scene, shot, progress, snapshots);
}

template Gather shoot(const Scene<2>&, std::size_t, const Progress&, const SnapshotSink<2>&);

}  // namespace slipwave
