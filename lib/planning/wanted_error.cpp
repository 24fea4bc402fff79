// SPDX-License-Identifier: BSD-3-Clause
#include "planning/wanted_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "planning/plan.hpp"
#include "planning/setting_search.hpp"

namespace slipwave {
namespace {

/// What is aimed at, of what is wanted: the error is known once the setting has run, and a second run costs
/// more than cells that are a little smaller.
constexpr double aim = 0.85;
/// So often is a setting chosen anew by runs in larger cells, and run again in smaller ones.
constexpr int most_choices = 4, most_runs = 4;
/// Edges that leave less than this of what is wanted are wide enough; so often are they doubled.
constexpr double edge_share = 0.3;
constexpr int most_doublings = 3;

template <int D>
class Search {
 public:
  Search(SceneRuns<D>& runs, double wanted, const SearchLimits& limits,
         const std::function<void(const std::string&)>& say)
      : runs_(runs),
        wanted_(wanted),
        limits_(limits),
        say_(say),
        settings_(runs, [this](const AccuracySetting& setting) { return fits(setting); }) {}

  ReachedError reached() {
    if (limits_.seconds > 0)
      if (const auto cheap = runs_.resized(setting_of(runs_.scene()), 2.25, Places::anywhere))
        note_time(*cheap);
    for (int run = 0; run < most_runs; ++run) {
      const auto setting = chosen();
      if (!setting) break;
      auto measured = measured_error(runs_, *setting);
      learn(measured);
      const bool better = !best_ || !(measured.error.whole >= best_->error.whole);
      if (better) best_ = std::move(measured);
      if (best_->error.whole <= wanted_) break;
      say_(name_of(*setting, runs_.scene()) + ": measured error " + shown(100 * best_->error.whole, 2) +
           " %, wanted " + shown(100 * wanted_, 2) + " %; smaller cells are next");
    }
    // What the user set is better than nothing.
    if (!best_) best_ = measured_error(runs_, setting_of(runs_.scene()));
    ReachedError reached{std::move(*best_), false, reason_, 0};
    reached.good = reached.measured.error.whole <= wanted_;
    if (!reached.good && reached.reason.empty())
      reached.reason = "the search ended after " + std::to_string(most_runs) + " settings";
    reached.search_s = runs_.seconds() - reached.measured.run_s;
    return reached;
  }

 private:
  double bytes_of(const AccuracySetting& setting) const {
    double ratio = 1;
    const auto& grid = runs_.scene().model.grid();
    const int own = zone_cells(runs_.scene(), runs_.scene().survey.sources.front());
    for (int axis = 0; axis < D; ++axis) {
      const double cells = double(grid.shape[std::size_t(axis)]);
      ratio *= (cells * grid.spacing_m / setting.spacing_m + 2 * runs_.zone_of(setting)) / (cells + 2 * own);
    }
    return ratio * double(memory_of_a_shot_bytes(runs_.scene()));
  }
  /// By the time that the runs so far took for their cells and steps.
  std::optional<double> seconds_of(const AccuracySetting& setting) const {
    return seconds_per_cost_ > 0 ? std::optional(seconds_per_cost_ * settings_.cost(setting)) : std::nullopt;
  }
  bool fits(const AccuracySetting& setting) {
    if (limits_.memory_bytes > 0 && bytes_of(setting) > limits_.memory_bytes) {
      reason_ = "smaller cells do not fit into the memory of this machine";
      return false;
    }
    const auto seconds = seconds_of(setting);
    // With the larger cells that it is measured in.
    constexpr double with_larger = 1.4;
    if (limits_.seconds > 0 && seconds && runs_.seconds() + with_larger * *seconds > limits_.seconds) {
      reason_ = "a smaller error would take more than the budget of " + shown(limits_.seconds, 3) + " s";
      return false;
    }
    return true;
  }
  /// The cheapest by what is known, after runs in larger cells have confirmed it.
  std::optional<AccuracySetting> chosen() {
    std::optional<AccuracySetting> setting;
    for (int n = 0; n < most_choices; ++n) {
      reason_.clear();
      const auto next = settings_.cheapest(aim * wanted_, known_, zone_);
      if (!next || (best_ && settings_.expected(*next, known_) >= best_->error.whole)) return setting;
      setting = with_possible_cells(*next);
      reason_.clear();
      if (!look(*setting)) return setting;
      if (settings_.expected(*setting, known_) <= wanted_ && setting->zone_cells == zone_) break;
    }
    return setting;
  }
  /// In cells that the scene holds.
  AccuracySetting with_possible_cells(AccuracySetting setting) const {
    const double own_m = runs_.scene().model.grid().spacing_m;
    // Cells of models that nothing tells more of are split, not filled anew.
    if (setting.spacing_m < own_m && !runs_.model().as_built())
      setting.spacing_m = own_m / std::ceil(own_m / setting.spacing_m - 1e-9);
    for (const double smaller : {1., 0.95, 0.9, 0.8, 0.7, 0.6, 0.5}) {
      auto other = setting;
      other.spacing_m *= smaller;
      if (const auto held = runs_.held(other)) return *held;
    }
    setting.spacing_m = own_m;
    return setting;
  }
  /// Runs in larger cells, and what they tell. False where the scene holds none.
  bool look(const AccuracySetting& setting) {
    const auto others = other_sizes(runs_, setting);
    if (others.size() < 2 || others.front().spacing_m < setting.spacing_m) return false;
    const auto &near = others[0], &far = others[1];
    note_time(far);
    widen_edges(far, setting);
    if (zone_ != setting.zone_cells) return true;
    note_time(near);
    remember(near, far, gather_error(runs_.run(far).observed, runs_.run(near).observed).whole, 2);
    return true;
  }
  void note_time(const AccuracySetting& setting) {
    seconds_per_cost_ = runs_.run(setting).seconds / settings_.cost(setting);
  }
  /// Edges twice as wide as long as that changes much of what is wanted.
  void widen_edges(const AccuracySetting& far, const AccuracySetting& setting) {
    if (runs_.scene().numerics.zone_cells > 0 || edges_seen_) return;
    auto wide = far;
    int zone = runs_.zone_of(setting);
    for (int n = 0; n < most_doublings; ++n) {
      const auto change = change_by_edges(runs_, wide);
      if (change.empty() || size_of_error(change, runs_.run(wide).observed).whole < edge_share * wanted_)
        break;
      wide.zone_cells = 2 * runs_.zone_of(wide);
      zone *= 2;
      zone_ = zone;
    }
    edges_seen_ = true;
  }
  /// By how much traces in cells of two sizes differ: of that dispersion of the direct waves makes what is
  /// derived, unless less is found, and the rest is of that order.
  void remember(const AccuracySetting& near, const AccuracySetting& far, double apart, double order) {
    const double derived = std::abs(settings_.dispersion(far) - settings_.dispersion(near));
    known_.dispersion = derived > apart ? apart / derived : 1;
    const double rest = std::sqrt(std::max(0., apart * apart - std::pow(known_.dispersion * derived, 2)));
    known_.rest = rest / (std::pow(far.spacing_m / near.spacing_m, order) - 1);
    known_.rest_m = near.spacing_m;
    known_.rest_order = order;
  }
  void learn(const MeasuredError& measured) {
    auto other = measured.setting;
    other.spacing_m = measured.others_m.front();
    if (other.spacing_m > measured.setting.spacing_m)
      remember(measured.setting, other, measured.nearest_apart, measured.order);
    note_time(measured.setting);
  }

  SceneRuns<D>& runs_;
  double wanted_;
  SearchLimits limits_;
  const std::function<void(const std::string&)>& say_;
  KnownErrors known_;
  SettingSearch<D> settings_;
  int zone_ = 0;  // of edges, cells; 0: as they are
  bool edges_seen_ = false;
  double seconds_per_cost_ = 0;
  std::optional<MeasuredError> best_;
  std::string reason_;
};

}  // namespace

template <int D>
ReachedError reach_error(SceneRuns<D>& runs, double wanted, const SearchLimits& limits,
                         const std::function<void(const std::string&)>& say) {
  return Search<D>(runs, wanted, limits, say).reached();
}

template ReachedError reach_error(SceneRuns<2>&, double, const SearchLimits&,
                                  const std::function<void(const std::string&)>&);
template ReachedError reach_error(SceneRuns<3>&, double, const SearchLimits&,
                                  const std::function<void(const std::string&)>&);

}  // namespace slipwave
