// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/pauses.hpp"
#include "base/progress.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/sweep/shot_report.hpp"

namespace slipwave {

/// A component of the wave field, or a result of slip.
using FieldKey = std::variant<Component, SlipField>;
/// Reads it on the model's cells.
template <int D>
using FieldReader = std::function<Field<D>(const FieldKey&)>;
/// Takes whole fields while a shot runs.
template <int D>
using SnapshotSink = std::function<void(double time_s, const FieldReader<D>& field)>;

/// A shot whose fields have grown beyond what its energy allows. `gather` holds what was recorded before:
/// samples up to the last time at which the fields are known to have been sound, zeros after it.
class Unstable : public Error {
 public:
  Unstable(const std::string& what, std::size_t shot, Gather gather, double sound_until_s)
      : Error(what, ErrorKind::unstable),
        shot_(shot),
        gather_(std::move(gather)),
        sound_until_s_(sound_until_s) {}
  std::size_t shot() const { return shot_; }
  const Gather& gather() const { return gather_; }
  double sound_until_s() const { return sound_until_s_; }

 private:
  std::size_t shot_;
  Gather gather_;
  double sound_until_s_;
};

/// Simulates one shot (1-based number) of a checked scene and returns its traces, component by component in
/// the order of scene.recording, receivers in their order. The traces do not depend on the number of threads.
/// `pauses` (may be null) can interrupt it between time tiles and resume it; that changes no bit of the
/// result. `report` (may be null) needs a scene that keeps a diary. Throws Unstable, which says where, when,
/// in what medium and near which effect the fields were first found to have diverged. `ranks` (may be null):
/// processes that simulate it together, to the last bit as one would, each with its subdomain of the scene;
/// in bands of cells each with the whole of it, of which it computes its share (subdomains_for()). All of
/// them call this, none with pauses. The first gets the traces and whole fields, the others traces of zeros
/// and the fields of their subdomains; all get the report.
template <int D>
Gather shoot(const Scene<D>& scene, std::size_t shot, const Progress& progress = {},
             const SnapshotSink<D>& snapshots = {}, Pauses* pauses = nullptr, ShotReport* report = nullptr,
             Ranks* ranks = nullptr);

/// One entry of a time step and the share of the computed cells it works on.
struct PlannedEntry {
  std::string name;
  double share = 0;
};

}  // namespace slipwave
