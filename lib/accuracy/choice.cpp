#include "accuracy/choice.hpp"

#include <algorithm>

#include "accuracy/expected_error.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

/// Orders in space and time, and the Courant numbers that may pay with them (theory.md 1.1: time order 4 pays
/// with order 7 and long steps only).
struct Scheme {
  int order, time_order;
  double cost;  // of a step, over that of order 5 (tests/bench/orders.sh): what is chosen must not hang on
                // the load of the moment
  std::vector<double> courant_numbers;
};
std::vector<Scheme> schemes() {
  return {{3, 2, 0.78, {0.9, 0.7, 0.5}},
          {5, 2, 1, {0.9, 0.7, 0.5, 0.35, 0.2}},
          {7, 2, 1.3, {0.9, 0.7, 0.5, 0.35, 0.2}},
          {7, 4, 7.3, {1.9, 1.5}}};
}

/// Measured errors were up to 1.5 times the expected ones (docs/accuracy.md): this is the margin.
constexpr double margin = 1.5;
/// A cell is split into this many a side at most.
constexpr int most_parts = 8;

double cells_of(const Scene<2>& scene, int parts) {
  const auto& grid = scene.model.grid();
  double cells = 1;
  for (int axis = 0; axis < 2; ++axis) {
    double count = double(grid.shape[std::size_t(axis)]) * parts;
    for (const int side : {0, 1})
      if (scene.edges[axis][side] == EdgeLaw::absorbing)
        count += zone_cells(scene, scene.survey.sources.front());
    cells *= count;
  }
  return cells;
}

}  // namespace

Choice cheapest_setting(const Scene<2>& scene, double wanted) {
  const double own_m = scene.model.grid().spacing_m;
  struct Candidate {
    AccuracySetting setting;
    double cost, error;
  };
  std::vector<Candidate> candidates;
  for (const auto& scheme : schemes())
    for (const double cfl : scheme.courant_numbers)
      for (int parts = 1; parts <= most_parts; ++parts)
        candidates.push_back(
            {{scheme.order, cfl, own_m / parts, scene.numerics.correction, scheme.time_order},
             scheme.cost * cells_of(scene, parts) * parts / cfl,
             0});
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  const WavesOfScene waves(scene);
  const Candidate* best = nullptr;
  for (auto& candidate : candidates) {
    const auto& setting = candidate.setting;
    const double time_step_s = setting.cfl * stable_time_step_s(scene) * setting.spacing_m / own_m;
    candidate.error = waves.expected({setting.order, time_step_s, setting.spacing_m, setting.time_order})
                          .of_reflections_too();
    if (!best || candidate.error < best->error) best = &candidate;
    if (margin * candidate.error <= wanted) break;
  }
  return {best->setting, best->error, margin * best->error <= wanted};
}

std::string sentence_of(const Choice& choice, const Scene<2>& scene) {
  return name_of(choice.setting, scene) + ": expected error up to " + shown(100 * choice.expected_error, 2) +
         " %";
}

}  // namespace slipwave
