// SPDX-License-Identifier: BSD-3-Clause
#include "planning/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "accuracy/dispersion.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/parse.hpp"
#include "base/processor_time.hpp"
#include "grid/longest_side.hpp"
#include "model/anisotropy.hpp"
#include "parallel/threads.hpp"
#include "planning/computed_share.hpp"
#include "planning/expected_slip.hpp"
#include "scene/subdomains.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave {
namespace {

/// Fewer cells per wavelength than this are worth a warning.
constexpr double fewest_cells = 4;

/// Of all cells' slowest waves the one that fewest cells resolve; on a regular grid the slowest.
template <int D>
SlowestWave least_resolved(const Medium<D>& medium) {
  if (!medium.grid().rows) return slowest_wave(medium);
  if (anisotropic_cells(medium) > 0) return least_resolved(in_slowest_directions(medium));
  SlowestWave least;
  double per_second = 0;
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto cell = std::size_t(n);
    if (medium.is_void(cell)) continue;
    const double speed = medium.is_fluid(cell) ? medium.vp[cell] : medium.vs[cell];
    const double cells = speed / longest_side_m(medium.grid(), n);
    if (per_second == 0 || cells < per_second) per_second = cells, least = {speed, n};
  }
  return least;
}

template <int D>
double cells_a_wavelength(const Scene<D>& scene, const SlowestWave& slowest, double hz) {
  return slowest.speed / hz / longest_side_m(scene.model.grid(), slowest.cell);
}

template <int D>
double loss_of(const Scene<D>& scene, const SlowestWave& slowest, double cells) {
  const double courant =
      slowest.speed * time_step_s(scene) / longest_side_m(scene.model.grid(), slowest.cell);
  // Waves shorter than two cells are not on the grid at all.
  if (cells <= 2) return 1;
  return loss_per_wavelength({scene.numerics.order, courant, 0, scene.numerics.time_order}, cells);
}

/// Cells that a second's way of P anywhere and of S in solids crosses at least (0: none), along their longest
/// sides.
template <int D>
std::array<double, 2> cells_of_a_second(const Medium<D>& medium) {
  if (anisotropic_cells(medium) > 0) return cells_of_a_second(in_slowest_directions(medium));
  const auto& grid = medium.grid();
  std::array<double, 2> slowest = {std::numeric_limits<double>::infinity(), 0};
  for (std::size_t n = 0; n < std::size_t(grid.size()); ++n) {
    if (medium.is_void(n)) continue;
    const double side = longest_side_m(grid, std::int64_t(n));
    const double p = medium.vp[n] / side, s = medium.vs[n] / side;
    slowest[0] = std::min(slowest[0], p);
    if (s > 0 && !(slowest[1] > 0 && slowest[1] < s)) slowest[1] = s;
  }
  return slowest;
}

/// Processor time of a step: the median of several.
template <int D, class Real>
double seconds_of_step(solver::ShotSimulation<D, Real>& step) {
  constexpr std::int64_t warm_up = 2, most = 15;
  constexpr double enough_s = 0.6;
  std::vector<double> seconds;
  double sum = 0;
  const auto count = std::min(step.steps(), warm_up + most);
  for (std::int64_t n = 0; n < count && (sum < enough_s || seconds.empty()); ++n) {
    const double start = processor_time_s();
    step.run_to(n + 1);
    const double taken = processor_time_s() - start;
    sum += taken;
    if (n >= std::min(warm_up, count - 1)) seconds.push_back(taken);
  }
  const auto middle = seconds.begin() + std::ptrdiff_t(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

/// What the program and its libraries have resident before they read a model.
constexpr std::int64_t program_bytes = std::int64_t{30} << 20;

template <int D>
std::int64_t shared_bytes(const Scene<D>& scene) {
  const auto& model = scene.model;
  const auto bytes_of = [](const auto& field) {
    return bytes_without_zero_pages(std::as_bytes(std::span(field)));
  };
  auto bytes = program_bytes + bytes_of(model.fracture);
  for (const auto property : model.medium.properties()) bytes += bytes_of(model.medium[property]);
  for (const auto& stress : model.prestress_pa) bytes += bytes_of(stress);
  return bytes;
}

/// Of the shot that records most.
template <int D>
std::int64_t trace_bytes(const Scene<D>& scene) {
  std::size_t most = 0;
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    most = std::max(most, scene.survey.receiver_count(shot));
  return std::int64_t(most * scene.recording.components.size()) * scene.recording.samples() *
         std::int64_t(sizeof(double));
}

template <int D, class Real>
Plan<D> plan_as(const Scene<D>& scene) {
  // Steps are timed as they are when waves are everywhere.
  Scene<D> everywhere = scene;
  everywhere.numerics.tiling.everywhere = true;
  const double start = processor_time_s();
  solver::ShotSimulation<D, Real> step(everywhere, 1, [](double, const FieldReader<D>&) {});
  const double build_s = processor_time_s() - start;
  Plan<D> plan;
  plan.computed = step.domain().grid;
  plan.time_step_s = time_step_s(scene);
  plan.courant = plan.time_step_s / stable_time_step_s(scene);
  plan.steps = step.steps();
  plan.entries = step.planned();
  plan.interface_cells = step.sweeps().interface_stencil_cells();
  plan.trace_bytes = trace_bytes(scene);
  plan.memory_bytes = step.memory_bytes() + step.record_bytes();
  plan.building_bytes = step.building_bytes();
  plan.shared_bytes = shared_bytes(scene);
  plan.highest_hz = highest_frequency_hz(scene.survey);
  plan.slowest = least_resolved(scene.model.medium);
  const auto [cells_of_p, cells_of_s] = cells_of_a_second(scene.model.medium);
  plan.cells_of_shortest_p = cells_of_p / plan.highest_hz;
  if (cells_of_s > 0) plan.cells_of_shortest_s = cells_of_s / plan.highest_hz;
  plan.loss_per_wavelength =
      loss_of(scene, plan.slowest, cells_a_wavelength(scene, plan.slowest, plan.highest_hz));
  plan.duration_s = scene.recording.duration_s;
  plan.threads = parallel_threads();
  plan.error = expected_error(scene);
  plan.slip = expected_slip(scene);
  plan.cell_dependence = cell_dependence(scene);
  plan.computed_share = expected_share(scene, plan.computed);
  plan.seconds = double(scene.survey.sources.size()) *
                 (build_s + plan.computed_share * double(plan.steps) * seconds_of_step(step));
  plan.instruction_set = solver::instruction_set();
  return plan;
}

}  // namespace

template <int D>
Plan<D> plan(const Scene<D>& scene) {
  return scene.numerics.double_precision ? plan_as<D, double>(scene) : plan_as<D, float>(scene);
}

template <int D>
std::int64_t memory_of_a_shot_bytes(const Scene<D>& scene) {
  std::int64_t widest = 0, cells = 1;
  for (const auto& source : scene.survey.sources)
    widest = std::max<std::int64_t>(widest, zone_cells(scene, source));
  for (const auto n : scene.model.grid().shape) cells *= n + 2 * widest;
  const std::int64_t value = scene.numerics.double_precision ? sizeof(double) : sizeof(float);
  const auto& medium = scene.model.medium;
  using solver::MaterialKind;
  auto kind = MaterialKind::fluid;
  if (scene.subdomain.anisotropic || anisotropic_cells(medium) > 0)
    kind = any_orthorhombic(medium) || (D == 3 && any_tilted_axes(medium)) ? MaterialKind::orthorhombic
                                                                           : MaterialKind::anisotropic;
  else if (scene.subdomain.shear || has_shear(medium))
    kind = MaterialKind::isotropic;
  return cells * value * (solver::FieldRows<D>::of(kind) + solver::material_rows_of<D>(kind));
}

template <int D>
std::int64_t memory_of_run_bytes(const Plan<D>& plan, const ShotsHeld& held) {
  // Samples are written when what was only needed to build the shot is gone.
  const auto building = std::max<std::int64_t>(0, plan.building_bytes - plan.trace_bytes);
  return plan.shared_bytes + std::int64_t(held.side_by_side) * (plan.memory_bytes + building) +
         std::int64_t(held.retained) * plan.trace_bytes;
}

namespace {

std::string mebibytes(std::int64_t bytes) { return shown(double(bytes) / (1 << 20), 3) + " MiB"; }

/// Causes that make less of the whole are left out.
constexpr double least_cause = 0.1;

std::vector<ErrorCause> large_ones(const std::vector<ErrorCause>& all, double whole) {
  std::vector<ErrorCause> causes;
  for (const auto& cause : all)
    if (cause.error > least_cause * whole) causes.push_back(cause);
  return causes;
}
std::vector<ErrorCause> causes_of(const ExpectedError& error) {
  return error.promise ? large_ones(error.promise->causes, error.promise->error) : std::vector<ErrorCause>{};
}

/// The first two, as a sentence.
std::string sentence_of(const std::vector<ErrorCause>& causes) {
  std::string text;
  for (std::size_t n = 0; n < std::min<std::size_t>(causes.size(), 2); ++n)
    text += (n > 0 ? "; " : "") + sentence_of(causes[n]);
  return text;
}

/// "up to 3.4 % of fractured less elastic traces below 60 Hz; mostly from ...": nothing where nothing slips.
std::string response_text(const ExpectedError& error) {
  if (!error.response)
    return error.response_unknown.empty() ? "" : "not estimated: " + error.response_unknown;
  const auto& of = *error.response;
  std::string text = "up to " + shown(100 * of.error, 2) + " % of fractured less elastic traces below " +
                     shown(of.below_hz, 3) + " Hz; mostly from " +
                     sentence_of(large_ones(of.causes, of.error));
  if (!error.response_leaves_out.empty()) text += "; not counted: " + joined(error.response_leaves_out, "; ");
  return text;
}

/// "up to 5.6 % of all traces together; not counted: ...".
std::string error_text(const ExpectedError& error, double duration_s) {
  std::string text;
  if (error.promise) {
    text = "up to " + shown(100 * error.promise->error, 2) + " % of all traces together";
  } else {
    text = "after " + shown(duration_s, 3) + " s: P " + shown(100 * error.p, 2) + " %" +
           (error.s ? ", S " + shown(100 * *error.s, 2) + " %" : "");
  }
  if (!error.not_covered.empty()) text += "; not counted: " + joined(error.not_covered, "; ");
  return text;
}

template <int D>
std::string cells_text(const Plan<D>& plan) {
  return "P " + shown(plan.cells_of_shortest_p, 3) +
         (plan.cells_of_shortest_s ? ", S " + shown(*plan.cells_of_shortest_s, 3) : "");
}

/// Of sentences on fracture sets the first, and that there are others.
void report_first(const std::string& key, const std::vector<std::string>& sentences, Report& report) {
  if (sentences.empty()) return;
  const auto others = sentences.size() - 1;
  report.text(key, sentences.front() + (others == 0   ? ""
                                        : others == 1 ? "; with -v also of another fracture set"
                                                      : "; with -v also of " + std::to_string(others) +
                                                            " other fracture sets"));
}

/// Two digits, which is more than they are good for.
void report_percent(Report& report, const std::string& key, double share) {
  report.number(key, std::stod(shown(100 * share, 2)), "%");
}

void report_causes(const std::string& key, const std::vector<ErrorCause>& causes, Report& report) {
  std::vector<Report> all;
  for (const auto& cause : causes) {
    auto& one = all.emplace_back();
    report_percent(one, "error", cause.error);
    one.text("name", cause.name);
    if (!cause.remedy.empty()) one.text("remedy", cause.remedy);
  }
  if (!all.empty()) report.list(key, all);
}

/// What is promised of all traces together, and why it is not less.
void report_promise(const ExpectedError& error, Report& report) {
  if (error.promise) report_percent(report, "promised error", error.promise->error);
  report_causes("cause", causes_of(error), report);
  if (!error.not_covered.empty()) report.texts("not counted", error.not_covered);
  if (!error.response) return;
  report_percent(report, "promised error of the response", error.response->error);
  report.number("response below", error.response->below_hz, "Hz");
  report_causes("cause of the response's error", large_ones(error.response->causes, error.response->error),
                report);
}

}  // namespace

template <int D>
std::string cost_of_a_second(const Scene<D>& scene) {
  // Of one thread, docs/performance.md.
  constexpr double cells_per_s = D == 2 ? 200e6 : 45e6;
  const auto zone = 2 * zone_cells(scene, scene.survey.sources.front());
  double cells = 1;
  for (const auto n : scene.model.grid().shape) cells *= double(n + zone);
  const double steps = std::ceil(1 / time_step_s(scene)), bytes = double(memory_of_a_shot_bytes(scene));
  const auto& medium = scene.model.medium;
  const auto slowest = least_resolved(medium);
  std::vector<std::string> effects;
  if (attenuating_cells(medium) > 0) effects.emplace_back("attenuation");
  if (any_tilted_axes(medium)) effects.emplace_back("tilted axes");
  const std::string more =
      effects.empty() ? "" : ", more with " + joined(effects, " and ") + " (sw-shoot --plan)";
  return "1 s of traces: " + shown(steps) + " steps of " + shown(cells) + " cells, about " +
         shown(cells * steps / cells_per_s, 2) + " s of one processor and " + shown(bytes / (1 << 20), 2) +
         " MiB" + more + "; waves up to " +
         shown(slowest.speed / (fewest_cells * longest_side_m(scene.model.grid(), slowest.cell)), 2) + " Hz";
}

template <int D>
Report summary_of(const Plan<D>& plan, const ShotsHeld& held) {
  Report report;
  if (D == 3 && !plan.error.promise) {
    report.text("error", "not estimated; cells per shortest wavelength: " + cells_text(plan));
    report.text("mostly from", "loss of the slowest wave: " + shown(100 * plan.loss_per_wavelength, 2) +
                                   " % of its amplitude per wavelength");
  } else {
    report.text("error", error_text(plan.error, plan.duration_s));
    const auto text = sentence_of(causes_of(plan.error));
    if (!text.empty()) report.text("mostly from", text);
  }
  if (const auto text = response_text(plan.error); !text.empty()) report.text("response", text);
  const std::string threads = plan.threads > 1 ? ", " + shown(plan.seconds / plan.threads, 2) + " s on " +
                                                     std::to_string(plan.threads) + " threads"
                                               : "";
  report.text("time", shown(plan.seconds, 2) + " s of processor time" + threads);
  report.text("memory",
              mebibytes(memory_of_run_bytes(plan, held)) + ", of which " + mebibytes(plan.memory_bytes) +
                  " a shot" +
                  (held.side_by_side > 1 ? ", " + std::to_string(held.side_by_side) + " side by side" : ""));
  report_first("slip", plan.slip, report);
  report_first("depends on cells", plan.cell_dependence, report);
  return report;
}

template <int D>
Report report_of(const Plan<D>& plan) {
  Report report;
  report.text("grid", shown(plan.computed) + ", absorbing zones included");
  report.count("steps", plan.steps);
  report.number("time step", plan.time_step_s, "s");
  report.number("Courant number", plan.courant, "");
  report.number("slowest wave", plan.slowest.speed, "m/s");
  report.number("highest frequency", plan.highest_hz, "Hz");
  report.text("cells per shortest wavelength", cells_text(plan));
  report.text("loss of the slowest wave",
              shown(100 * plan.loss_per_wavelength, 2) + " % of the amplitude per wavelength");
  report_promise(plan.error, report);
  if (D == 2) {
    if (plan.error.direct) report_percent(report, "error in direct arrivals", *plan.error.direct);
    report_percent(report, "late error P", plan.error.p);
    if (plan.error.s) report_percent(report, "late error S", *plan.error.s);
  }
  report.count("cells at interfaces", plan.interface_cells);
  report.text(
      "active cells",
      shown(100 * plan.computed_share, 2) +
          " % (cells that no wave has reached, or that can no longer affect a receiver, are skipped)");
  report.number("memory of a shot", double(plan.memory_bytes) / (1 << 20), "MiB");
  report.number("memory of model and program", double(plan.shared_bytes) / (1 << 20), "MiB");
  report.number("memory of the traces of a shot", double(plan.trace_bytes) / (1 << 20), "MiB");
  report.number("processor time", plan.seconds, "s");
  report.count("threads", plan.threads);
  report.text("instruction set", plan.instruction_set);
  if (plan.slip.size() > 1) report.texts("slip of a set", plan.slip);
  if (plan.cell_dependence.size() > 1) report.texts("set that depends on cells", plan.cell_dependence);
  std::vector<std::string> entries;
  for (const auto& entry : plan.entries)
    entries.push_back(entry.name + ": " + shown(100 * entry.share, 3) + " % of the cells");
  report.texts("part of step", entries);
  return report;
}

template <int D>
std::vector<std::string> warnings(const Scene<D>& scene) {
  const auto slowest = least_resolved(scene.model.medium);
  const double highest = highest_frequency_hz(scene.survey);
  const double cells = cells_a_wavelength(scene, slowest, highest);
  if (cells >= fewest_cells) return {};
  const double h = scene.model.grid().spacing_m;
  const std::string wave = scene.model.medium.is_fluid(std::size_t(slowest.cell)) ? "P" : "S";
  return {"only " + shown(cells, 2) + " cells per shortest " + wave + " wavelength (" +
          shown(slowest.speed, 4) + " m/s at " + place_of(scene.model.grid(), slowest.cell) + ", " +
          shown(highest, 3) + " Hz), at least " + shown(fewest_cells) + " needed: amplitude drops by " +
          shown(100 * loss_of(scene, slowest, cells), 2) + " % per wavelength. Use cells of " +
          shown(h * cells / fewest_cells, 2) + " m (" + shown(std::pow(fewest_cells / cells, D + 1), 2) +
          " times the cost)" + (D == 2 ? " or --error" : " (--step of the model)")};
}

template Plan<2> plan(const Scene<2>&);
template std::int64_t memory_of_run_bytes(const Plan<2>&, const ShotsHeld&);
template std::int64_t memory_of_run_bytes(const Plan<3>&, const ShotsHeld&);
template std::int64_t memory_of_a_shot_bytes(const Scene<2>&);
template std::string cost_of_a_second(const Scene<2>&);
template Report summary_of(const Plan<2>&, const ShotsHeld&);
template Report report_of(const Plan<2>&);
template std::vector<std::string> warnings(const Scene<2>&);
template Plan<3> plan(const Scene<3>&);
template std::int64_t memory_of_a_shot_bytes(const Scene<3>&);
template std::string cost_of_a_second(const Scene<3>&);
template Report summary_of(const Plan<3>&, const ShotsHeld&);
template Report report_of(const Plan<3>&);
template std::vector<std::string> warnings(const Scene<3>&);

}  // namespace slipwave
