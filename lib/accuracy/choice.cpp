#include "accuracy/choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "accuracy/plan.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr int orders[] = {3, 5, 7};
constexpr double courant_numbers[] = {0.9, 0.7, 0.5, 0.35, 0.2};
/// Errors were found up to 1.5 times what was expected of them (docs/accuracy.md): so much is kept in hand.
constexpr double margin = 1.5;
/// A cell is split into this many a side at most.
constexpr int most_parts = 8;

std::string digits(double value, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", count, value);
  return text;
}

/// What costs and errs of a setting depend on: the model's own cells computed with each order tell the rate.
struct Rate {
  int order;
  double seconds_a_cell_and_step;
};

std::vector<Rate> rates_of(const Scene<2>& scene) {
  std::vector<Rate> rates;
  for (const int order : orders) {
    Scene<2> own = scene;
    own.numerics.order = order;
    const auto expected = plan(own);
    rates.push_back({order, expected.seconds / (double(expected.computed.size()) * double(expected.steps))});
  }
  return rates;
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
  for (const auto& rate : rates_of(scene))
    for (const double cfl : courant_numbers)
      for (int parts = 1; parts <= most_parts; ++parts) {
        const double steps = scene.recording.duration_s * parts / (cfl * stable_time_step_s(scene));
        choices.push_back({{rate.order, cfl, own_m / parts, scene.numerics.correction},
                           0,
                           rate.seconds_a_cell_and_step * cells_of(scene, parts) * steps});
      }
  std::sort(choices.begin(), choices.end(),
            [](const Choice& a, const Choice& b) { return a.seconds < b.seconds; });
  const WavesOfScene waves(scene);
  const Choice* best = nullptr;
  for (auto& choice : choices) {
    const auto& [order, cfl, spacing_m, correction] = choice.setting;
    const double time_step_s = cfl * stable_time_step_s(scene) * spacing_m / own_m;
    choice.expected_error = waves.expected({order, time_step_s, spacing_m}).overall();
    if (margin * choice.expected_error <= wanted) return choice;
    if (!best || choice.expected_error < best->expected_error) best = &choice;
  }
  throw Error("found no setting whose expected error is below " + shown(wanted) + " by a factor of 1.5" +
              "; the best is " + sentence_of(*best, scene));
}

std::string sentence_of(const Choice& choice, const Scene<2>& scene) {
  return name_of(choice.setting, scene) + ": expected error " + digits(100 * choice.expected_error, 2) +
         " %, " + digits(choice.seconds, 2) + " s of the processor";
}

}  // namespace slipwave
