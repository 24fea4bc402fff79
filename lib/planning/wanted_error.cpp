// SPDX-License-Identifier: BSD-3-Clause
#include "planning/wanted_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "planning/plan.hpp"
#include "planning/setting_search.hpp"

namespace slipwave {
namespace {

/// What is aimed at, of what is wanted: the error is known once the setting has run, and a second run costs
/// more than cells that are a little smaller.
constexpr double aim = 0.85;
/// So many settings are run whose errors tell something, and so many in all; most of these runs are far
/// cheaper than the last.
constexpr int most_telling = 8, most_runs = 12;
/// Traces that so many settings one after the other did not better are not bettered by cells.
constexpr int most_worse = 3;
/// An error above this no longer falls with a power of the cells: waves arrive a twentieth of a period late.
constexpr double all_wrong = 0.3;
/// What is known in some cells is not taken further than to cells as much smaller as it was measured in
/// larger ones; beyond, the same scheme in the next size tells more, and its larger cells were run already.
constexpr double seen = 2.25, step_down = 1.5;
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
    int runs = 0, telling = 0;
    while (runs < most_runs && telling < most_telling) {
      const auto setting = chosen();
      if (!setting) break;
      auto measured = measured_error(runs_, *setting);
      const bool better = !best_ || !(measured.error.whole >= best_->error.whole);
      // Errors of traces that have no wave right do not tell how they fall.
      const bool tells = measured.by_cells <= all_wrong;
      misled_ = !better || !tells;
      note_time(measured.setting);
      ++runs, telling += tells;
      refute(measured);
      if (tells) learn(measured);
      edges_matter_ = may_widen() && matters(measured.by_edges);
      edges_alone_ = edges_matter_ && measured.by_cells <= aim * wanted_;
      all_run_.push_back(*setting);
      const double found = measured.error.whole;
      worse_ = better || best_->by_cells > all_wrong ? 0 : worse_ + 1;
      if (better || exceeds(measured.setting, best_->setting)) best_ = std::move(measured);
      if (found <= wanted_) break;
      if (worse_ == most_worse) {
        reason_ = "other cells were no better " + std::to_string(most_worse) + " times";
        break;
      }
      if (best_->by_cells > wanted_) known_.largest_m = best_->setting.spacing_m;
      say_(name_of(*setting, runs_.scene()) + ": measured error " + shown(100 * found, 2) + " %, wanted " +
           shown(100 * wanted_, 2) + " %; smaller cells are next");
    }
    // What the user set is better than nothing.
    if (!best_) best_ = measured_error(runs_, setting_of(runs_.scene()));
    ReachedError reached{std::move(*best_), false, reason_, 0};
    reached.good = reached.measured.error.whole <= wanted_;
    if (!reached.good && reached.reason.empty())
      reached.reason = "the search ended after " + std::to_string(runs) + " settings";
    reached.search_s = runs_.seconds() - reached.measured.run_s;
    return reached;
  }

 private:
  /// Whether one setting cannot be worse than another.
  static bool exceeds(const AccuracySetting& one, const AccuracySetting& other) {
    return one.spacing_m <= other.spacing_m && one.order >= other.order &&
           one.time_order >= other.time_order &&
           (one.cfl <= other.cfl || one.time_order > other.time_order) && one.zone_cells >= other.zone_cells;
  }
  /// Larger errors of settings that cannot be worse show that those of others are not as small as measured.
  void refute(const MeasuredError& measured) {
    std::erase_if(tried_, [&](const SettingRun& run) {
      return exceeds(measured.setting, run.setting) && run.error < measured.by_cells;
    });
  }
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
  /// The cheapest by what is known.
  std::optional<AccuracySetting> chosen() {
    const auto cheapest = [&]() -> std::optional<AccuracySetting> {
      reason_.clear();
      if (best_ && edges_alone_) {
        auto wider = best_->setting;
        wider.zone_cells = zone_;
        return fits(wider) ? std::optional(wider) : std::nullopt;
      }
      auto next = settings_.cheapest(aim * wanted_, known_, zone_);
      const bool unknown = best_ && (misled_ || !next || next->spacing_m * seen < best_->setting.spacing_m);
      if (unknown) next = smaller_cells();
      if (!next || (best_ && !unknown && settings_.expected(*next, known_) >= best_->error.whole))
        return std::nullopt;
      return with_possible_cells(*next);
    };
    const auto setting = cheapest();
    return setting && widened(*setting) ? cheapest() : setting;
  }
  /// The best scheme so far, in cells as much smaller as those that its error is measured in are larger, or
  /// less where errors of first order would fall enough; a size that was no better is passed by.
  std::optional<AccuracySetting> smaller_cells() {
    auto setting = best_->setting;
    const double step = std::min(step_down, best_->error.whole / (aim * wanted_));
    const auto was_run = [&](const AccuracySetting& one) {
      return one.order == setting.order && one.time_order == setting.time_order && one.cfl == setting.cfl &&
             std::abs(std::log(one.spacing_m / setting.spacing_m)) < std::log(step) / 2;
    };
    do setting.spacing_m /= step;
    while (std::any_of(all_run_.begin(), all_run_.end(), was_run));
    setting.zone_cells = zone_;
    return fits(setting) ? std::optional(setting) : std::nullopt;
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
  void note_time(const AccuracySetting& setting) {
    seconds_per_cost_ = runs_.run(setting).seconds / settings_.cost(setting);
  }
  /// Doubles the width of edges as long as that changes much of what is wanted, in the largest cells that the
  /// setting is measured in: before the first run, and where a run has shown that they matter. True where
  /// they are wider now.
  bool widened(const AccuracySetting& setting) {
    if (!edges_matter_) return false;
    edges_matter_ = false;
    auto wide = other_sizes(runs_, setting).back();
    const int own = runs_.zone_of(setting);
    int zone = own;
    for (int n = 0; n < most_doublings; ++n) {
      const auto wider = with_wider_edges(runs_, wide);
      if (!wider) break;
      const bool measured = best_ && n == 0;
      if (!measured && !matters(gather_error(runs_.run(*wider).observed, runs_.run(wide).observed).whole))
        break;
      wide = *wider;
      zone_ = zone *= 2;
    }
    return zone > own;
  }
  bool may_widen() const { return runs_.scene().numerics.zone_cells == 0; }
  bool matters(double by_edges) const { return by_edges > edge_share * wanted_; }
  void learn(const MeasuredError& measured) {
    // Traces that do not hang on the cells tell nothing of them.
    if (!(measured.by_cells > 0)) return;
    tried_.push_back({measured.setting, measured.by_cells});
    known_ = settings_.explained(tried_, measured.order);
  }

  SceneRuns<D>& runs_;
  double wanted_;
  SearchLimits limits_;
  const std::function<void(const std::string&)>& say_;
  KnownErrors known_;
  std::vector<SettingRun> tried_;
  std::vector<AccuracySetting> all_run_;
  bool misled_ = false;  // by what is known, or nothing is known yet
  SettingSearch<D> settings_;
  int zone_ = 0;                     // of edges, cells; 0: as they are
  bool edges_matter_ = may_widen();  // as far as is known
  bool edges_alone_ = false;         // keep the error above what is wanted
  int worse_ = 0;                    // than the best, the last ones
  double seconds_per_cost_ = 0;
  std::optional<MeasuredError> best_;
  std::string reason_;
};

}  // namespace

void check_wanted_error(double share) {
  if (!(share > 0)) throw Error("--error: found " + shown(share) + ", expected it above 0", ErrorKind::usage);
  if (share >= 1)
    throw Error("--error: found " + shown(share) + ", expected a share below 1: " + shown(share / 100) +
                    " is " + shown(share) + " %",
                ErrorKind::usage);
}

template <int D>
ReachedError reach_error(SceneRuns<D>& runs, double wanted, const SearchLimits& limits,
                         const std::function<void(const std::string&)>& say) {
  return Search<D>(runs, wanted, limits, say).reached();
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, reach_error);

}  // namespace slipwave
