// SPDX-License-Identifier: BSD-3-Clause
#include "planning/measured_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <span>

#include "accuracy/sizes.hpp"
#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "scene/orders.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

/// The ratio of sizes: the first that the scene holds. Halves again are the second.
constexpr double first_ratios[] = {1.5, 1.4, 1.6, 1.75, 4. / 3, 1.25, 2};
constexpr double second_ratios[] = {2.25, 2.1, 2.4, 2, 2.6, 1.85, 3};
constexpr double finer_ratios[] = {1 / 1.5, 1 / 1.4, 1 / 1.75, 0.5};
/// Each may be another by so many times one part in so many, where horizons lie rather alike.
constexpr int parts_around = 10, parts_of_a_ratio = 200;
/// Sizes that differ by less tell nothing of an order.
constexpr double least_apart = 1.15;

/// The ratios, each moved to where level horizons lie in cells as they do in those of the setting; those in
/// which they do so to a tenth of a cell come before those to two tenths, and so on.
template <int D>
std::vector<double> alike(const SceneRuns<D>& runs, const AccuracySetting& setting,
                          std::span<const double> ratios) {
  constexpr double alike_cells = 0.1;
  std::vector<std::pair<int, double>> moved;
  for (const double ratio : ratios) {
    double best = ratio, least = runs.lie_otherwise(setting, ratio);
    for (int n = 1; n <= 2 * parts_around; ++n) {
      const int parts = (n + 1) / 2;
      const double part = double(parts) / parts_of_a_ratio;
      const double other = ratio * (1 + (n % 2 ? part : -part));
      const double otherwise = runs.lie_otherwise(setting, other);
      if (otherwise < least - 1e-9) best = other, least = otherwise;
    }
    moved.emplace_back(int(least / alike_cells), best);
  }
  std::stable_sort(moved.begin(), moved.end(), [](auto a, auto b) { return a.first < b.first; });
  std::vector<double> sorted;
  for (const auto& [steps, ratio] : moved) sorted.push_back(ratio);
  return sorted;
}

template <int D>
double change(SceneRuns<D>& runs, const AccuracySetting& from, const AccuracySetting& to,
              Variation variation = Variation::none) {
  const auto& base = runs.run(from).observed;
  return gather_error(base, runs.run(to, variation).observed).whole;
}

/// What else moves the traces, in the cells of `coarse`; `own` is the setting that is advised on.
template <int D>
void add_sensitivities(SceneRuns<D>& runs, const AccuracySetting& coarse, const AccuracySetting& own,
                       std::vector<Sensitivity>& all) {
  auto shorter = coarse;
  shorter.cfl /= 2;
  all.push_back({"half the time step", "--cfl " + shown(own.cfl / 2, 3), change(runs, coarse, shorter),
                 coarse.spacing_m});
  auto other = coarse;
  other.order += other.order == orders[order_count - 1] ? -2 : 2;
  all.push_back({"order " + std::to_string(other.order), "--order " + std::to_string(other.order),
                 change(runs, coarse, other), coarse.spacing_m});
  if (!runs.model().could_be_fitted()) return;
  try {
    all.push_back({"rows that follow horizons", "sw-layers --fit all",
                   change(runs, coarse, coarse, Variation::fitted), coarse.spacing_m});
  } catch (const Error&) {
    // Rows that cannot follow them are no remedy.
  }
}

/// How near the receivers of a shot are to its sources.
template <int D>
std::vector<double> away_from_sources_m(const Survey<D>& survey, std::size_t shot) {
  const auto receivers = survey.receivers_of(shot);
  std::vector<double> away(receivers.size(), std::numeric_limits<double>::infinity());
  for (const auto* source : survey.sources_of(shot)) {
    if (!point_injection(*source)) continue;
    for (std::size_t n = 0; n < receivers.size(); ++n)
      away[n] = std::min(away[n], distance_m<D>(receivers[n].point_m, source->position_m));
  }
  return away;
}

/// The traces observed with a setting, without those beside sources.
class Compared {
 public:
  template <int D>
  explicit Compared(const SceneRuns<D>& runs) {
    const auto& scene = runs.scene();
    std::size_t all = 0;
    for (const auto shot : runs.observed().shots) {
      auto& beside = channels_.emplace_back();
      for (const double away_m : away_from_sources_m(scene.survey, shot)) {
        beside.push_back(away_m < cells_of_a_source * scene.model.grid().spacing_m);
        count_ += beside.back();
        if (!beside.back()) nearest_m_ = std::min(nearest_m_, away_m);
      }
      all += beside.size();
    }
    // Where there are no others, they are what was asked for.
    if (count_ == all) count_ = 0;
  }
  std::size_t left_out() const { return count_; }
  double nearest_m() const { return nearest_m_; }
  /// Kept until the end of this.
  const std::vector<Gather>& of(const SceneRun& run) {
    if (count_ == 0) return run.observed;
    auto& gathers = silenced_.emplace_back(run.observed);
    for (std::size_t shot = 0; shot < gathers.size(); ++shot)
      for (auto& trace : gathers[shot].traces) {
        const auto n = std::size_t(trace.header.channel - 1);
        if (n < channels_[shot].size() && channels_[shot][n])
          std::fill(trace.samples.begin(), trace.samples.end(), 0);
      }
    return gathers;
  }

 private:
  std::vector<std::vector<bool>> channels_;
  std::size_t count_ = 0;
  double nearest_m_ = std::numeric_limits<double>::infinity();
  std::list<std::vector<Gather>> silenced_;
};

/// Returns whether waves meet nothing but one medium without loss, and edges that absorb.
template <int D>
bool nothing_reflects(const Scene<D>& scene) {
  for (int axis = 0; axis < D; ++axis)
    for (const auto edge : scene.edges[axis])
      if (edge != EdgeLaw::absorbing) return false;
  const auto& medium = scene.model.medium;
  return scene.model.fracture_sets.empty() && !scene.attenuation &&
         std::ranges::all_of(medium.properties(), [&](Property property) {
           const auto& values = medium[property];
           return std::ranges::all_of(values, [&](float value) { return value == values[0]; });
         });
}

/// Returns the order that the errors of a setting keep: that in time where nothing reflects, two with
/// surfaces and interfaces that rows follow. What horizons that cut cells and faces between bands add falls
/// more slowly than the rest, and hides behind it in larger cells.
template <int D>
double kept_order(const SceneRuns<D>& runs, const AccuracySetting& setting) {
  if (runs.model().tops_cut_cells() || !runs.scene().numerics.bands.empty()) return 1;
  return nothing_reflects(runs.scene()) ? setting.time_order : 2;
}

}  // namespace

template <int D>
std::vector<AccuracySetting> other_sizes(const SceneRuns<D>& runs, const AccuracySetting& setting) {
  std::vector<AccuracySetting> others;
  const auto add = [&](std::span<const double> ratios, Places places) {
    for (const double ratio : alike(runs, setting, ratios)) {
      const auto other = runs.resized(setting, ratio, places);
      if (!other) continue;
      const bool apart = std::all_of(others.begin(), others.end(), [&](const AccuracySetting& one) {
        return std::abs(std::log(one.spacing_m / other->spacing_m)) > std::log(least_apart);
      });
      if (!apart) continue;
      others.push_back(*other);
      return;
    }
  };
  // Rather other matter at some receiver than no measurement.
  for (const auto places : {Places::in_the_same_matter, Places::anywhere}) {
    if (others.empty()) add(first_ratios, places);
    if (others.size() == 1) add(second_ratios, places);
  }
  if (others.empty()) add(finer_ratios, Places::anywhere);
  if (others.empty())
    throw Error("the scene holds no cells of other sizes near " + shown(setting.spacing_m, 4) +
                " m, in which its error could be measured");
  return others;
}

template <int D>
double nearest_receiver_m(const SceneRuns<D>& runs) {
  return Compared(runs).nearest_m();
}

template <int D>
std::optional<AccuracySetting> with_wider_edges(const SceneRuns<D>& runs, AccuracySetting setting) {
  if (!any_edge_absorbs(runs.scene())) return std::nullopt;
  setting.zone_cells = 2 * runs.zone_of(setting);
  return setting;
}

template <int D>
MeasuredError measured_error(SceneRuns<D>& runs, const AccuracySetting& setting, const Measured& what) {
  MeasuredError measured;
  measured.setting = setting;
  auto settings = other_sizes(runs, setting);
  const auto coarsest = settings.back();
  const double before_s = runs.seconds();
  if (what.itself) settings.insert(settings.begin(), setting);
  // The expensive one comes last: what cannot be run says so before.
  for (auto one = settings.rbegin(); one != settings.rend(); ++one) runs.run(*one);
  const auto derived = [&](const AccuracySetting& of) {
    // That of one size of cells says nothing of bands.
    const bool known = !runs.observed().response && runs.scene().numerics.bands.empty();
    return !known ? 0. : runs.direct().together(runs.discretisation_of(of));
  };
  Compared compared(runs);
  measured.beside_source = compared.left_out();
  std::vector<SizedTraces> sizes;
  for (const auto& one : settings) {
    sizes.push_back({one.spacing_m, &compared.of(runs.run(one)), derived(one)});
    if (!(one == setting)) measured.others_m.push_back(one.spacing_m);
  }
  if (sizes.size() < 2)
    throw Error("the scene holds cells of one other size only, " + shown(coarsest.spacing_m, 4) +
                " m: its error is measured by running it");
  // Where none of the sizes is its own, of second order is the best guess there is.
  auto of_cells = error_of_sizes(sizes, what.itself ? 1 : 2, kept_order(runs, setting));
  measured.order = of_cells.order;
  measured.by_cells = of_cells.error;
  measured.wrong = std::move(of_cells.wrong);
  measured.extrapolated = !what.itself;
  const auto& found = *sizes.front().traces;
  if (!what.itself && of_cells.error > 0) {
    const double smaller = std::pow(setting.spacing_m / sizes[0].spacing_m, of_cells.order);
    measured.by_cells = of_cells.share * derived(setting) + of_cells.rest * smaller;
    measured.wrong = sum_of(measured.wrong, measured.wrong, measured.by_cells / of_cells.error - 1);
  }
  measured.by_edges = std::numeric_limits<double>::quiet_NaN();
  if (what.edges)
    if (const auto wider = with_wider_edges(runs, coarsest)) {
      const auto& own = *sizes.back().traces;
      const auto by_edges = sum_of(own, compared.of(runs.run(*wider)), -1);
      measured.by_edges = size_of_error(by_edges, own).whole;
      measured.wrong = sum_of(std::move(measured.wrong), by_edges, 1);
      measured.sensitivities.push_back({"edges twice as wide",
                                        "--edge-width " + std::to_string(2 * runs.zone_of(setting)),
                                        measured.by_edges, coarsest.spacing_m});
    }
  if (what.others) add_sensitivities(runs, coarsest, setting, measured.sensitivities);
  measured.error = size_of_error(measured.wrong, found);
  if (const auto* own = runs.find(setting)) measured.run_s = own->seconds;
  measured.measuring_s = runs.seconds() - before_s - (what.itself ? measured.run_s : 0);
  return measured;
}

template <int D>
std::vector<std::size_t> representative_shots(const Survey<D>& survey) {
  /// Surveys from here on have a third shot measured: it costs them little.
  constexpr std::size_t many = 12;
  const auto count = survey.sources.size();
  std::vector<std::size_t> shots;
  const auto apart = [&](std::size_t a, std::size_t b) {
    const auto &one = survey.sources[a], &other = survey.sources[b];
    if (one.mechanism.index() != other.mechanism.index() || one.wavelet.text() != other.wavelet.text())
      return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
      sum += std::pow(one.position_m[axis] - other.position_m[axis], 2);
    return sum;
  };
  const auto farthest = [&](const std::vector<std::size_t>& from) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t n = 0; n < count; ++n) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto shot : from) nearest = std::min(nearest, n == shot ? 0 : apart(n, shot));
      if (nearest > most) most = nearest, best = n;
    }
    return best;
  };
  if (count > 0) shots.push_back(count > 1 ? farthest({0}) : 0);
  for (const std::size_t wanted : {std::size_t(2), std::size_t(3)})
    if (count >= (wanted == 3 ? many : wanted)) shots.push_back(farthest(shots));
  for (auto& shot : shots) ++shot;
  std::sort(shots.begin(), shots.end());
  return shots;
}

template <int D>
std::string sentence_of(const MeasuredError& measured, const SceneRuns<D>& runs) {
  const auto& error = measured.error;
  const auto percent = [](double share) { return shown(100 * share, 2); };
  std::string parts;
  if (error.components.size() > 1)
    for (const auto& [component, share] : error.components)
      parts += (parts.empty() ? "" : ", ") + std::string(name_of(component)) + ' ' + percent(share);
  const auto shot = runs.observed().shots[error.worst_shot];
  return percent(error.whole) + " % of " +
         (runs.observed().response ? "what fractures add to the traces" : "all traces") + " (" + parts +
         (parts.empty() ? "" : "; ") + "late quarter " + percent(error.late) + "; worst trace " +
         percent(error.worst) + " %: shot " + std::to_string(runs.scene().survey.label_of(shot)) +
         ", channel " + std::to_string(error.worst_channel) + ")";
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, other_sizes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, nearest_receiver_m);
SLIPWAVE_INSTANTIATE_D(FUNCTION, with_wider_edges);
SLIPWAVE_INSTANTIATE_D(FUNCTION, measured_error);
SLIPWAVE_INSTANTIATE_D(FUNCTION, representative_shots);
SLIPWAVE_INSTANTIATE_D(FUNCTION, sentence_of);

}  // namespace slipwave
