// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <list>
#include <string>
#include <vector>

#include "accuracy/direct_waves.hpp"
#include "accuracy/ladder.hpp"
#include "base/progress.hpp"
#include "build/model_in_cells.hpp"

namespace slipwave {

/// What errors are measured of.
struct Observed {
  std::vector<std::size_t> shots;  // from 1
  bool response = false;           // what fractures add to the traces, instead of the traces
};

/// What a scene needs beyond its setting when it is made in other cells. All may be empty.
template <int D>
struct SceneInCells {
  std::function<void(Scene<D>&)> place_again;  // its survey, where that is measured from the ground
  std::function<Progress(const std::string& title)> progress;
};

/// What of a way of computing a scene is changed to see whether it matters.
enum class Variation { none, fitted };

/// This says where sources and receivers may come to stand in cells of another size.
enum class Places { in_the_same_matter, anywhere };

/// A scene run with one setting.
struct SceneRun {
  AccuracySetting setting;
  Variation variation = Variation::none;
  std::vector<Gather> recorded;  // of the shots observed
  std::vector<Gather> observed;  // the same, or what fractures add to it
  double seconds = 0;            // of the processor
  double cell_steps = 0;         // cells times steps
};

/// The runs of a scene with many settings, each of which is made once. sw-accuracy and --error measure with
/// it.
template <int D>
class SceneRuns {
 public:
  /// The scene, checked, outlives this.
  SceneRuns(const Scene<D>& scene, Observed observed, SceneInCells<D> in_cells = {});

  const Scene<D>& scene() const { return scene_; }
  const Observed& observed() const { return observed_; }
  const ModelInCells<D>& model() const { return model_; }
  const DirectWaves<D>& direct() const { return direct_; }
  Discretisation discretisation_of(const AccuracySetting& setting) const;

  /// The scene as it is computed with a setting. Throws an Error where it cannot be.
  Scene<D> scene_of(const AccuracySetting& setting, Variation variation = Variation::none) const;
  const SceneRun& run(const AccuracySetting& setting, Variation variation = Variation::none);
  /// One that was made, or null.
  const SceneRun* find(const AccuracySetting& setting, Variation variation = Variation::none) const;

  /// The setting in the nearest cells that the scene holds: where the model ends in an edge that sends waves
  /// back, its size must be a whole number of them. Nothing where cells of about that size cannot hold it,
  /// or put sources and receivers into another kind of matter
  /// or leave a top unfollowed, where that is not allowed.
  std::optional<AccuracySetting> held(AccuracySetting setting,
                                      Places places = Places::in_the_same_matter) const;
  /// The setting with cells some `ratio` times as large, held(), and all lengths as they are.
  std::optional<AccuracySetting> resized(const AccuracySetting& setting, double ratio,
                                         Places places = Places::in_the_same_matter) const;
  /// How otherwise level horizons lie in cells some `ratio` times as large (ModelInCells::lie_otherwise()).
  double lie_otherwise(const AccuracySetting& setting, double ratio) const;
  /// Width of the absorbing layers, in cells.
  int zone_of(const AccuracySetting& setting) const;
  /// The processor time of all runs so far, s.
  double seconds() const;

 private:
  std::optional<double> possible_m(double spacing_m) const;
  bool stands_alike(const Scene<D>& other) const;
  std::vector<Gather> shoot_all(const Scene<D>& scene, const std::string& title) const;

  const Scene<D>& scene_;
  Observed observed_;
  SceneInCells<D> in_cells_;
  ModelInCells<D> model_;
  DirectWaves<D> direct_;
  std::list<SceneRun> runs_;
};

}  // namespace slipwave
