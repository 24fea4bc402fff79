#include "accuracy/choice.hpp"

#include <algorithm>

#include "accuracy/plan.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

/// Orders in space and time, and the Courant numbers that may pay with them (theory.md 1.1: time order 4 pays
/// with order 7 and long steps only).
struct Scheme {
  int order, time_order;
  std::vector<double> courant_numbers;
};
const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> all = {{3, 2, {0.9, 0.7, 0.5}},
                                          {5, 2, {0.9, 0.7, 0.5, 0.35, 0.2}},
                                          {7, 2, {0.9, 0.7, 0.5, 0.35, 0.2}},
                                          {7, 4, {1.9, 1.5}}};
  return all;
}
/// Errors were found up to 1.5 times what was expected of them (docs/accuracy.md): so much is kept in hand.
constexpr double margin = 1.5;
/// A cell is split into this many a side at most.
constexpr int most_parts = 8;

/// Processor time of a cell and a step, measured on the model's own cells.
double rate_of(const Scene<2>& scene, const Scheme& scheme) {
  Scene<2> own = scene;
  own.numerics.order = scheme.order;
  own.numerics.time_order = scheme.time_order;
  own.numerics.cfl = scheme.courant_numbers.front();
  own.numerics.time_step_s.reset();
  const auto expected = plan(own);
  return expected.seconds / (double(expected.computed.size()) * double(expected.steps));
}

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
  std::vector<Choice> choices;
  for (const auto& scheme : schemes()) {
    const double rate = rate_of(scene, scheme);
    for (const double cfl : scheme.courant_numbers)
      for (int parts = 1; parts <= most_parts; ++parts) {
        const double steps = scene.recording.duration_s * parts / (cfl * stable_time_step_s(scene));
        choices.push_back({{scheme.order, cfl, own_m / parts, scene.numerics.correction, scheme.time_order},
                           0,
                           rate * cells_of(scene, parts) * steps});
      }
  }
  std::sort(choices.begin(), choices.end(),
            [](const Choice& a, const Choice& b) { return a.seconds < b.seconds; });
  const WavesOfScene waves(scene);
  const Choice* best = nullptr;
  for (auto& choice : choices) {
    const auto& setting = choice.setting;
    const double time_step_s = setting.cfl * stable_time_step_s(scene) * setting.spacing_m / own_m;
    choice.expected_error =
        waves.expected({setting.order, time_step_s, setting.spacing_m, setting.time_order})
            .of_reflections_too();
    if (margin * choice.expected_error <= wanted) return choice;
    if (!best || choice.expected_error < best->expected_error) best = &choice;
  }
  throw Error("found no setting whose expected error is below " + shown(wanted) + " by a factor of 1.5" +
              "; the best is " + sentence_of(*best, scene));
}

std::string sentence_of(const Choice& choice, const Scene<2>& scene) {
  return name_of(choice.setting, scene) + ": expected error " + shown(100 * choice.expected_error, 2) +
         " %, " + shown(choice.seconds, 2) + " s of the processor";
}

}  // namespace slipwave
