#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"
#include "solver/pauses.hpp"

namespace slipwave {

/// Hands out a component of the wave field of the model's cells.
template <int D>
using FieldReader = std::function<Field<D>(Component)>;
/// Takes whole fields while a shot runs.
template <int D>
using SnapshotSink = std::function<void(double time_s, const FieldReader<D>& field)>;

/// Shoots one shot (1-based number) of a checked scene and returns its traces, component by component in the
/// order of scene.recording, receivers in their order. The traces do not depend on the number of threads.
/// `pauses` (may be null) can interrupt it between passes through memory and take it up again; that changes
/// no bit of what comes out. Throws an Error of kind unstable when the fields grow beyond all bounds.
template <int D>
Gather shoot(const Scene<D>& scene, std::size_t shot, const Progress& progress = {},
             const SnapshotSink<D>& snapshots = {}, Pauses* pauses = nullptr);

/// What the fields and the material of a shot take of memory at most, bytes.
template <int D>
std::int64_t memory_of_a_shot_bytes(const Scene<D>& scene);

/// One pass of a time step and the share of the computed cells it works on.
struct PlannedPass {
  std::string name;
  double share = 0;
};

}  // namespace slipwave
