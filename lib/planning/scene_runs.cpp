// SPDX-License-Identifier: BSD-3-Clause
#include "planning/scene_runs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/processor_time.hpp"
#include "grid/locate.hpp"
#include "scene/bands.hpp"
#include "scene/empty_gather.hpp"
#include "solver/simulation.hpp"

namespace slipwave {
namespace {

/// Fluid, solid or void, at sources and receivers.
template <int D>
std::vector<int> matter_at_places(const Scene<D>& scene, const Observed& observed) {
  const auto& medium = scene.model.medium;
  std::vector<int> matter;
  const auto add = [&](const Point<D>& point) {
    const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), point)));
    matter.push_back(medium.is_void(cell) ? 0 : medium.is_fluid(cell) ? 1 : 2);
  };
  for (const auto shot : observed.shots) {
    for (const auto* source : scene.survey.sources_of(shot))
      if (point_injection(*source)) add(source->position_m);
    for (const auto& receiver : scene.survey.receivers_of(shot)) add(receiver.point_m);
  }
  return matter;
}

}  // namespace

template <int D>
SceneRuns<D>::SceneRuns(const Scene<D>& scene, Observed observed, SceneInCells<D> in_cells)
    : scene_(scene),
      observed_(std::move(observed)),
      in_cells_(std::move(in_cells)),
      model_(scene.model, scene.attenuation),
      direct_(scene) {}

template <int D>
Discretisation SceneRuns<D>::discretisation_of(const AccuracySetting& setting) const {
  const double stable_per_m = stable_time_step_s(scene_) / scene_.model.grid().spacing_m;
  return {setting.order, setting.cfl * stable_per_m * setting.spacing_m, setting.spacing_m,
          setting.time_order};
}

template <int D>
Scene<D> SceneRuns<D>::scene_of(const AccuracySetting& setting, Variation variation) const {
  const bool fitted = variation == Variation::fitted;
  if (setting == setting_of(scene_) && variation == Variation::none) return scene_;
  auto scene = scene_;
  scene.numerics = numerics_of(setting, scene.numerics);
  if (!fitted && setting.spacing_m == scene.model.grid().spacing_m) return scene;
  scene = with_model(scene, fitted ? model_.fitted(setting.spacing_m) : model_.of(setting.spacing_m));
  scene.numerics.bands =
      slipwave::resized(std::move(scene.numerics.bands), setting.spacing_m / scene_.model.grid().spacing_m);
  if (in_cells_.place_again) in_cells_.place_again(scene);
  check(scene);
  return scene;
}

template <int D>
const SceneRun* SceneRuns<D>::find(const AccuracySetting& setting, Variation variation) const {
  const auto at = std::find_if(runs_.begin(), runs_.end(), [&](const SceneRun& run) {
    return run.setting == setting && run.variation == variation;
  });
  return at == runs_.end() ? nullptr : &*at;
}

template <int D>
std::vector<Gather> SceneRuns<D>::shoot_all(const Scene<D>& scene, const std::string& title) const {
  std::vector<Gather> gathers;
  for (const auto shot : observed_.shots)
    gathers.push_back(in_record(
        shoot(scene, shot, in_cells_.progress ? in_cells_.progress(title) : Progress()), scene.recording));
  return gathers;
}

template <int D>
const SceneRun& SceneRuns<D>::run(const AccuracySetting& setting, Variation variation) {
  if (const auto* known = find(setting, variation)) return *known;
  const double start = processor_time_s();
  SceneRun run{setting, variation, {}, {}, 0, 0};
  auto scene = scene_of(setting, variation);
  const auto title = name_of(setting, scene);
  run.recorded = shoot_all(scene, title);
  run.cell_steps = std::ceil(scene.recording.duration_s / time_step_s(scene));
  for (int axis = 0; axis < D; ++axis) {
    double cells = double(scene.model.grid().shape[std::size_t(axis)]);
    for (const int side : {0, 1})
      if (scene.edges[axis][side] == EdgeLaw::absorbing) cells += zone_of(setting);
    run.cell_steps *= cells;
  }
  run.observed = run.recorded;
  if (observed_.response) {
    scene.with_slip = !scene.with_slip;
    const auto other = shoot_all(scene, title);
    run.observed = scene.with_slip ? sum_of(other, run.recorded, -1) : sum_of(run.recorded, other, -1);
    run.cell_steps *= 2;
  }
  run.seconds = processor_time_s() - start;
  return runs_.emplace_back(std::move(run));
}

template <int D>
int SceneRuns<D>::zone_of(const AccuracySetting& setting) const {
  if (setting.zone_cells > 0) return setting.zone_cells;
  if (scene_.numerics.zone_cells > 0) return scene_.numerics.zone_cells;
  const auto& source = scene_.survey.sources[observed_.shots.front() - 1];
  const double own_m = scene_.model.grid().spacing_m;
  const int own = zone_cells(scene_, source);
  // Bands have that many of the largest cells.
  if (const auto& bands = scene_.numerics.bands; !bands.empty())
    return int(std::ceil(own * largest_cell_m(bands) / own_m - 1e-9));
  // That of plane waves is a length.
  return point_injection(source) ? own : int(std::ceil(own * own_m / setting.spacing_m));
}

template <int D>
std::optional<double> SceneRuns<D>::possible_m(double spacing_m) const {
  const auto& grid = scene_.model.grid();
  std::vector<double> whole;  // lengths that must be whole numbers of cells, in those of the scene
  for (int axis = 0; axis < D; ++axis)
    if (scene_.edges[axis][1] != EdgeLaw::absorbing) whole.push_back(double(grid.shape[std::size_t(axis)]));
  const auto& bands = scene_.numerics.bands;
  // Depths of faces between bands that are whole numbers of cells stay so; others are where rows follow them.
  for (std::size_t n = 1; n < bands.size(); ++n)
    for (const auto& band : {bands[n - 1], bands[n]}) {
      const double cells = (bands[n].from_m - grid.origin_m[D - 1]) / band.spacing_m;
      if (std::abs(cells - std::round(cells)) < 1e-6) whole.push_back(std::round(cells));
    }
  if (whole.empty()) return spacing_m;
  const auto fits = [&](double cells) {
    return cells >= 1 && std::all_of(whole.begin(), whole.end(), [&](double length) {
             const double count = cells * length / whole.front();
             return std::abs(count - std::round(count)) < 1e-9 * std::max(1., count);
           });
  };
  const double wanted = whole.front() * grid.spacing_m / spacing_m;
  for (double away = 0; away < 0.2 * wanted + 1; ++away)
    for (const double cells : {std::round(wanted) - away, std::round(wanted) + away})
      if (fits(cells)) return whole.front() * grid.spacing_m / cells;
  return std::nullopt;
}

template <int D>
bool SceneRuns<D>::stands_alike(const Scene<D>& other) const {
  const double own_m = scene_.model.grid().spacing_m, other_m = other.model.grid().spacing_m;
  return matter_at_places(other, observed_) == matter_at_places(scene_, observed_) &&
         model_.left_out(other_m) <= model_.left_out(own_m);
}

template <int D>
std::optional<AccuracySetting> SceneRuns<D>::held(AccuracySetting setting, Places places) const {
  const auto spacing_m = possible_m(setting.spacing_m);
  if (!spacing_m) return std::nullopt;
  setting.spacing_m = *spacing_m;
  // Sides of less than this many cells, or than the scene has, hold no wave.
  constexpr double least_cells = 4;
  const auto& grid = scene_.model.grid();
  for (const auto cells : grid.shape)
    if (double(cells) * grid.spacing_m / *spacing_m < std::min(double(cells), least_cells))
      return std::nullopt;
  try {
    const auto scene = scene_of(setting);
    if (!scene.numerics.bands.empty()) scenes_of_bands(scene);
    if (places == Places::in_the_same_matter && !stands_alike(scene)) return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  return setting;
}

template <int D>
std::optional<AccuracySetting> SceneRuns<D>::resized(const AccuracySetting& setting, double ratio,
                                                     Places places) const {
  auto other = setting;
  const auto spacing_m = possible_m(ratio * setting.spacing_m);
  if (!spacing_m || std::abs(*spacing_m / setting.spacing_m - 1) < 0.05) return std::nullopt;
  other.spacing_m = *spacing_m;
  // Edges are as wide in metres; those of plane waves are by themselves.
  const auto& source = scene_.survey.sources[observed_.shots.front() - 1];
  if (setting.zone_cells > 0 || scene_.numerics.zone_cells > 0 || point_injection(source))
    other.zone_cells = int(std::ceil(zone_of(setting) * setting.spacing_m / *spacing_m - 1e-9));
  return held(other, places);
}

template <int D>
double SceneRuns<D>::lie_otherwise(const AccuracySetting& setting, double ratio) const {
  const auto spacing_m = possible_m(ratio * setting.spacing_m);
  return model_.lie_otherwise(setting.spacing_m, spacing_m.value_or(ratio * setting.spacing_m));
}

template <int D>
double SceneRuns<D>::seconds() const {
  double sum = 0;
  for (const auto& run : runs_) sum += run.seconds;
  return sum;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SceneRuns);

}  // namespace slipwave
