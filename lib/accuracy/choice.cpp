// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/choice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "accuracy/expected_error.hpp"
#include "accuracy/finer_model.hpp"
#include "accuracy/response_error.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

/// Orders in space and time, and the Courant numbers that may pay with them (theory.md 1.1: time order 4 pays
/// with orders from 7 on and long steps only; the longest sustain short waves near a force).
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
          {9, 2, 1.6, {0.9, 0.7, 0.5, 0.35, 0.2}},
          {11, 2, 1.9, {0.9, 0.7, 0.5, 0.35, 0.2}},
          {7, 4, 6.2, {1.9, 1.5}},
          {9, 4, 7.7, {1.9, 1.5}},
          {11, 4, 9.7, {1.9, 1.5}}};
}

/// Measured errors were up to 1.5 times the expected ones (docs/accuracy.md): this is the margin.
constexpr double margin = 1.5;
/// A cell is split into this many a side at most.
constexpr int most_parts = 8;

/// Widths of absorbing layers, over the usual ones.
constexpr double edge_widths[] = {1, 1.5, 2, 3};

/// Width of absorbing layers in cells that are parts of those of the scene, unless another is chosen.
int usual_zone(const Scene<2>& scene, int parts) {
  const auto& source = scene.survey.sources.front();
  const int own = zone_cells(scene, source);
  // That of plane waves is a length.
  return scene.numerics.zone_cells > 0 || point_injection(source) ? own : own * parts;
}

double cells_of(const Scene<2>& scene, int parts, int zone) {
  const auto& grid = scene.model.grid();
  double cells = 1;
  for (int axis = 0; axis < 2; ++axis) {
    double count = double(grid.shape[std::size_t(axis)]) * parts;
    for (const int side : {0, 1})
      if (scene.edges[axis][side] == EdgeLaw::absorbing) count += zone;
    cells *= count;
  }
  return cells;
}

}  // namespace

Choice cheapest_setting_for_response(const Scene<2>& scene, double wanted) {
  const FractureResponse response(scene);
  if (!response.any()) throw Error(response.why_not(), ErrorKind::usage);
  const double own_m = scene.model.grid().spacing_m, stable_per_m = stable_time_step_s(scene) / own_m;
  struct Candidate {
    AccuracySetting setting;
    double cost;
  };
  std::vector<Candidate> candidates;
  for (const auto& scheme : schemes())
    for (const double cfl : scheme.courant_numbers)
      for (int parts = 1; parts <= most_parts && scheme.time_order == 2; ++parts)
        for (const double wider : edge_widths) {
          if (wider > 1 && scene.numerics.zone_cells > 0) continue;
          const int zone = int(std::lround(wider * usual_zone(scene, parts)));
          AccuracySetting setting{scheme.order, cfl, own_m / parts, scene.numerics.correction};
          setting.zone_cells = wider > 1 ? zone : 0;
          candidates.push_back({setting, scheme.cost * cells_of(scene, parts, zone) * parts / cfl});
        }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  Choice best;
  best.of_response = true;
  best.finer_geometry = has_finer_geometry(scene);
  for (const auto& [setting, cost] : candidates) {
    const double h = setting.spacing_m;
    const int zone =
        setting.zone_cells > 0 ? setting.zone_cells : usual_zone(scene, int(std::lround(own_m / h)));
    const auto promise =
        response.promised({{setting.order, setting.cfl * stable_per_m * h, h, 2}, setting.correction, zone});
    if (best.expected_error > 0 && promise.error >= best.expected_error) continue;
    best.setting = setting;
    best.expected_error = promise.error;
    best.good_enough = margin * promise.error <= wanted;
    best.reason = best.good_enough || promise.causes.empty() ? "" : sentence_of(promise.causes.front());
    if (best.good_enough) break;
  }
  return best;
}

namespace {

/// A setting, what it costs, and the least that its error is known to be.
struct Candidate {
  AccuracySetting setting;
  double cost;
  bool finest;  // of all cells
  double error = 0;
};

/// All there are, the cheapest first.
std::vector<Candidate> candidates_for(const Scene<2>& scene) {
  const int zone = zone_cells(scene, scene.survey.sources.front());
  std::vector<Candidate> candidates;
  for (const auto& scheme : schemes())
    for (const double cfl : scheme.courant_numbers)
      for (int parts = 1; parts <= most_parts; ++parts)
        candidates.push_back({{scheme.order, cfl, scene.model.grid().spacing_m / parts,
                               scene.numerics.correction, scheme.time_order},
                              scheme.cost * cells_of(scene, parts, zone) * parts / cfl,
                              parts == most_parts});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return candidates;
}

/// What gains less than this over all others is not worth more time.
constexpr double hardly_more = 1.02;

/// Settings of a scene by their errors.
class Search {
 public:
  Search(const Scene<2>& scene, const WavesOfScene& waves)
      : waves_(waves),
        stable_per_m_(stable_time_step_s(scene) / scene.model.grid().spacing_m),
        candidates_(candidates_for(scene)) {}
  /// Rows of other cells have the heights of the scene's, in cells.
  Discretisation cells(const AccuracySetting& setting) const {
    return {setting.order, setting.cfl * stable_per_m_ * setting.spacing_m, setting.spacing_m,
            setting.time_order};
  }
  /// The cheapest within `reach`; null: none.
  const Candidate* cheapest_within(double reach) {
    for (auto& candidate : candidates_)
      if (candidate.finest && !tried(candidate, reach)) tell_larger(candidate);
    for (auto& candidate : candidates_)
      if (tried(candidate, reach)) return &candidate;
    return nullptr;
  }
  /// That of the least error; where most of that has no cure, the cheapest that is hardly worse.
  const Candidate& best() {
    double least = std::numeric_limits<double>::infinity();
    const Candidate* best = &candidates_.back();
    // The most expensive are the best, and most others are told to be worse soon.
    for (auto candidate = candidates_.rbegin(); candidate != candidates_.rend(); ++candidate) {
      if (tried(*candidate, least)) {
        least = candidate->error;
        best = &*candidate;
      } else if (candidate->finest) {
        tell_larger(*candidate);
      }
    }
    const auto promise = waves_.promised(cells(best->setting));
    if (!promise || promise->floor <= 0.5 * least) return *best;
    const auto* cheaper = cheapest_within(hardly_more * least);
    return cheaper ? *cheaper : *best;
  }

 private:
  /// Whether it is within reach; its error need not be right where it is not.
  bool tried(Candidate& candidate, double reach) const {
    if (candidate.error <= reach)
      candidate.error = waves_.of_reflections_too(cells(candidate.setting), reach);
    return candidate.error <= reach;
  }
  /// Cells that are larger have at least the dispersion of the finest.
  void tell_larger(const Candidate& finest) {
    const double apart = waves_.apart_from_dispersion(cells(finest.setting));
    const double dispersion = std::sqrt(std::max(0., finest.error * finest.error - apart * apart));
    for (auto& other : candidates_) {
      const auto &a = other.setting, &b = finest.setting;
      if (a.order == b.order && a.time_order == b.time_order && a.cfl == b.cfl)
        other.error = std::max(other.error, dispersion);
    }
  }

  const WavesOfScene& waves_;
  double stable_per_m_;
  std::vector<Candidate> candidates_;
};

/// The largest cause that no setting cures, where it is above `reach`, or the largest of all.
std::string reason_of(const PromisedError& promise, double reach) {
  const auto& causes = promise.causes;
  if (causes.empty()) return "";
  const auto stays = std::find_if(causes.begin(), causes.end(), [&](const ErrorCause& cause) {
    return !cause.curable && cause.error > reach;
  });
  return sentence_of(stays == causes.end() ? causes.front() : *stays);
}

}  // namespace

Choice cheapest_setting(const Scene<2>& scene, double wanted) {
  const double own_m = scene.model.grid().spacing_m;
  const bool finer = has_finer_geometry(scene);
  const WavesOfScene waves(scene, finer);
  Search search(scene, waves);
  const auto* found = search.cheapest_within(wanted / margin);
  const auto& best = found ? *found : search.best();
  Choice choice{best.setting, best.error, found != nullptr, finer, 0, false, ""};
  if (scene.slips())
    if (const FractureResponse response(scene); response.any())
      choice.slip_error = response
                              .promised({search.cells(best.setting), best.setting.correction,
                                         usual_zone(scene, int(std::lround(own_m / best.setting.spacing_m)))})
                              .error;
  if (const auto promise = found ? std::nullopt : waves.promised(search.cells(best.setting)))
    choice.reason = reason_of(*promise, wanted / margin);
  return choice;
}

Scene<2> chosen_scene(const Scene<2>& scene, const Choice& choice) {
  const double own_m = scene.model.grid().spacing_m, spacing_m = choice.setting.spacing_m;
  if (!choice.finer_geometry || spacing_m == own_m) return with_setting(scene, choice.setting);
  auto setting = choice.setting;
  setting.spacing_m = own_m;
  auto chosen = with_setting(scene, setting);
  auto finer = finer_model(scene, spacing_m);
  if (!finer) return with_setting(scene, choice.setting);
  chosen.model = std::move(*finer);
  return chosen;
}

std::string sentence_of(const Choice& choice, const Scene<2>& scene) {
  return name_of(choice.setting, scene) + ": expected error " +
         (choice.of_response ? "of the response " : "") + "up to " + shown(100 * choice.expected_error, 2) +
         " %" +
         (choice.slip_error > 0 ? ", and " + shown(100 * choice.slip_error, 2) + " % of what fractures add"
                                : "");
}

}  // namespace slipwave
