// SPDX-License-Identifier: BSD-3-Clause
#include "planning/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/memory.hpp"
#include "base/parse.hpp"
#include "base/processor_time.hpp"
#include "grid/longest_side.hpp"
#include "parallel/threads.hpp"
#include "planning/computed_share.hpp"
#include "planning/expected_slip.hpp"
#include "planning/measured_error.hpp"
#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "scene/bands.hpp"
#include "scene/subdomains.hpp"
#include "solver/banded_shot.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave {
namespace {

/// In so many steps no bands and no closed boxes that were tried gained energy at any order; at order 5 and
/// below bands did not in twice as many either (docs/theory/bands.md, docs/theory/interfaces.md).
constexpr double steps_without_gain = 10000;

/// Fewer cells per wavelength than this are worth a warning.
constexpr double fewest_cells = 4;

/// Returns the one of all cells' slowest waves that fewest cells resolve; on a regular grid the slowest.
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

/// The media that are computed, zones left out: of a scene in bands (scenes_of_bands()) those of each.
template <int D>
std::vector<Medium<D>> media_of_bands(const std::vector<Scene<D>>& bands) {
  std::vector<Medium<D>> media;
  for (const auto& band : bands)
    media.push_back(rows_of(band.model.medium, band.subdomain.first, band.subdomain.last));
  return media;
}

/// The slowest wave in the cells that resolve it least, how many of them a wavelength at the highest
/// frequency of a scene has, and what it loses in that.
struct LeastResolved {
  SlowestWave slowest;
  double cells = 0, loss = 0;
};
template <int D>
LeastResolved least_resolved_of(const Scene<D>& scene, const Medium<D>& medium, double step_s, double hz) {
  LeastResolved least{least_resolved(medium)};
  const double side_m = longest_side_m(medium.grid(), least.slowest.cell);
  least.cells = least.slowest.speed / hz / side_m;
  const double courant = least.slowest.speed * step_s / side_m;
  // Waves shorter than two cells are not on the grid at all.
  least.loss =
      least.cells <= 2
          ? 1
          : loss_per_wavelength({scene.numerics.order, courant, 0, scene.numerics.time_order}, least.cells);
  return least;
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

/// Processor time of the first step, which takes the memory of the fields, and of a later one: the median of
/// several; one after another is timed as long as that takes hardly anything of `shot_steps` of them.
template <class Simulation>
std::pair<double, double> seconds_of_steps(Simulation& step, double shot_steps) {
  constexpr std::int64_t warm_up = 2, most = 15;
  constexpr double enough_s = 0.6, hardly = 0.01;
  std::vector<double> seconds;
  double first = 0, sum = 0;
  // A plan takes a small part of the run's time.
  const auto count =
      std::min({step.steps(), warm_up + most, std::max<std::int64_t>(warm_up + 1, step.steps() / 40)});
  for (std::int64_t n = 0; n < count && (sum < enough_s || seconds.empty()); ++n) {
    const double start = processor_time_s();
    step.run_to(n + 1);
    const double taken = processor_time_s() - start;
    if (n == 0) first = taken;
    if (n > 0) sum += taken;
    if (n == 1 || n == warm_up) seconds.clear();  // caches are filled
    seconds.push_back(taken);
    if (sum > hardly * shot_steps * taken) break;
  }
  const auto middle = seconds.begin() + std::ptrdiff_t(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return {first, *middle};
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

/// Returns the bytes of the traces of the shot that records most.
template <int D>
std::int64_t trace_bytes(const Scene<D>& scene) {
  std::size_t most = 0;
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    most = std::max(most, scene.survey.receiver_count(shot));
  return std::int64_t(most * scene.recording.components.size()) * scene.recording.samples() *
         std::int64_t(sizeof(double));
}

/// Time of the runs in larger cells that measure an error, over that of the run: once in cells of the first
/// ratio, five times (edges twice as wide, half the step, another order) in those of the second.
double measuring_share(int dimension) {
  constexpr double first = 1.5, second = 2.25, runs_in_second = 5;
  return std::pow(first, -dimension - 1) + runs_in_second * std::pow(second, -dimension - 1);
}

/// What a plan tells of cells and wavelengths.
template <int D>
void plan_cells(const Scene<D>& scene, const Medium<D>& medium, Plan<D>& plan) {
  const auto fewer = [](double& least, double cells) { least = least > 0 ? std::min(least, cells) : cells; };
  const auto [of_p, of_s] = cells_of_a_second(medium);
  fewer(plan.cells_of_shortest_p, of_p / plan.highest_hz);
  if (of_s > 0) {
    if (!plan.cells_of_shortest_s) plan.cells_of_shortest_s = 0;
    fewer(*plan.cells_of_shortest_s, of_s / plan.highest_hz);
  }
  const auto least = least_resolved_of(scene, medium, plan.time_step_s, plan.highest_hz);
  if (plan.slowest.speed > 0 && least.loss <= plan.loss_per_wavelength) return;
  plan.slowest = least.slowest;
  plan.loss_per_wavelength = least.loss;
}

/// All that is weighed and timed of what simulates the first shot, which build() makes.
template <int D, class Build>
void plan_run(const Scene<D>& scene, Plan<D>& plan, Build&& build) {
  const double start = processor_time_s();
  const auto step = build();
  const double build_s = processor_time_s() - start;
  plan.steps = step->steps();
  plan.entries = step->planned();
  plan.interface_cells = step->interface_stencil_cells();
  plan.memory_bytes = step->memory_bytes() + step->record_bytes();
  plan.building_bytes = step->building_bytes();
  const double shot_steps = plan.computed_share * double(plan.steps);
  const auto [first_s, later_s] = seconds_of_steps(*step, shot_steps);
  plan.seconds = double(scene.survey.sources.size()) *
                 (build_s + std::max(0., first_s - later_s) + shot_steps * later_s);
  plan.measuring_seconds = plan.seconds / double(scene.survey.sources.size()) *
                           double(representative_shots(scene.survey).size()) * measuring_share(D);
}

template <int D, class Real>
Plan<D> plan_as(const Scene<D>& scene) {
  Plan<D> plan;
  plan.highest_hz = highest_frequency_hz(scene.survey);
  plan.trace_bytes = trace_bytes(scene);
  plan.shared_bytes = shared_bytes(scene);
  plan.duration_s = scene.recording.duration_s;
  plan.threads = parallel_threads();
  plan.slip = expected_slip(scene);
  plan.cell_dependence = cell_dependence(scene);
  plan.instruction_set = solver::instruction_set();
  if (!scene.numerics.bands.empty()) {
    const auto bands = scenes_of_bands(scene);
    plan.time_step_s = time_step_s(bands.front());
    plan.courant = scene.numerics.cfl;
    for (const auto& medium : media_of_bands(bands)) {
      plan.bands.push_back(medium.grid());
      plan_cells(scene, medium, plan);
    }
    plan_run(scene, plan, [&] { return std::make_unique<solver::BandedShot<D, Real>>(scene, 1); });
    return plan;
  }
  plan.time_step_s = time_step_s(scene);
  plan.courant = plan.time_step_s / stable_time_step_s(scene);
  plan_cells(scene, scene.model.medium, plan);
  if (scene.survey.any_receiver()) plan.direct = DirectWaves<D>(scene).error(discretisation_of(scene));
  // Steps are timed as they are when waves are everywhere.
  Scene<D> everywhere = scene;
  everywhere.numerics.tiling.everywhere = true;
  plan_run(scene, plan, [&] {
    auto step = std::make_unique<solver::ShotSimulation<D, Real>>(everywhere, 1,
                                                                  [](double, const FieldReader<D>&) {});
    plan.computed = step->domain().grid;
    plan.computed_share = expected_share(scene, plan.computed);
    return step;
  });
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

/// "P 0.43 %, S 2.1 %".
std::string direct_text(const std::optional<double>& p, const std::optional<double>& s) {
  const auto of = [](const char* wave, const std::optional<double>& error) {
    return error ? std::string(wave) + ' ' + shown(100 * *error, 2) + " %" : std::string();
  };
  return of("P", p) + (p && s ? ", " : "") + of("S", s);
}

template <int D>
std::string cells_text(const Plan<D>& plan) {
  return "P " + shown(plan.cells_of_shortest_p, 3) +
         (plan.cells_of_shortest_s ? ", S " + shown(*plan.cells_of_shortest_s, 3) : "");
}

/// "1100 x 50 cells of 0.6 m", top to bottom.
template <int D>
std::vector<std::string> shown_bands(const Plan<D>& plan) {
  std::vector<std::string> bands;
  for (const auto& grid : plan.bands) bands.push_back(shown(grid));
  return bands;
}

/// Reports the first of some sentences on fracture sets, and that there are others.
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
  report.text("cells per shortest wavelength", cells_text(plan));
  const auto direct = direct_text(plan.direct.p, plan.direct.s);
  for (const auto& band : shown_bands(plan)) report.text("band", band);
  if (plan.bands.empty()) {
    report.text("direct waves", direct.empty() ? "none arrives before the traces end"
                                               : direct + " by dispersion, as derived (E16)");
    report.text("not in it",
                "reflections, waves along interfaces, edges, fractures: --plan --measure measures all of it "
                "in about " +
                    shown(plan.measuring_seconds, 2) + " s");
  }
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
  if (plan.bands.empty())
    report.text("grid", shown(plan.computed) + ", absorbing zones included");
  else
    report.texts("band", shown_bands(plan));
  report.count("steps", plan.steps);
  report.number("time step", plan.time_step_s, "s");
  report.number("Courant number", plan.courant, "");
  report.number("slowest wave", plan.slowest.speed, "m/s");
  report.number("highest frequency", plan.highest_hz, "Hz");
  report.number("cells per shortest P wavelength", plan.cells_of_shortest_p, "");
  if (plan.cells_of_shortest_s)
    report.number("cells per shortest S wavelength", *plan.cells_of_shortest_s, "");
  report.text("loss of the slowest wave",
              shown(100 * plan.loss_per_wavelength, 2) + " % of the amplitude per wavelength");
  if (plan.direct.p) report_percent(report, "dispersion of direct P waves", *plan.direct.p);
  if (plan.direct.s) report_percent(report, "dispersion of direct S waves", *plan.direct.s);
  report.count("cells at interfaces", plan.interface_cells);
  report.text(
      "active cells",
      shown(100 * plan.computed_share, 2) +
          " % (cells that no wave has reached, or that can no longer affect a receiver, are skipped)");
  report.number("memory of a shot", double(plan.memory_bytes) / (1 << 20), "MiB");
  report.number("memory of model and program", double(plan.shared_bytes) / (1 << 20), "MiB");
  report.number("memory of the traces of a shot", double(plan.trace_bytes) / (1 << 20), "MiB");
  report.number("processor time", plan.seconds, "s");
  report.number("processor time of measuring", plan.measuring_seconds, "s");
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

namespace {

/// The single fracture, a compliant one, that lies in the cells of which a source takes its place; null:
/// none.
template <int D>
const FractureSet<D>* fracture_at(const Model<D>& model, const Point<D>& source_m) {
  const auto& grid = model.grid();
  // A source is spread over the cells whose centres are nearest to it.
  constexpr double nearly_half = 0.499;
  for (int corner = 0; corner < 1 << D; ++corner) {
    Point<D> at = source_m;
    for (int axis = 0; axis < D; ++axis)
      at[std::size_t(axis)] += ((corner >> axis & 1) != 0 ? nearly_half : -nearly_half) * grid.spacing_m;
    const auto code = model.fracture[std::size_t(grid.flat(cell_of(grid, at)))];
    if (code == 0) continue;
    const auto& set = model.fracture_sets[code - 1U];
    if (!set.is_cluster() && !set.on_faces && gives(set)) return &set;
  }
  return nullptr;
}

/// The first source in the cells of a fracture: what the fracture answers to it is not known there.
template <int D>
std::optional<std::string> source_in_a_fracture(const Scene<D>& scene) {
  if (scene.model.fracture.empty()) return std::nullopt;
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    for (const auto* source : scene.survey.sources_of(shot)) {
      const auto* set = point_injection(*source) ? fracture_at(scene.model, source->position_m) : nullptr;
      if (!set) continue;
      return "the source of shot " + std::to_string(shot) + " lies in cells of the fracture '" + set->name +
             "': what it answers may be half of what it should be. Split faces if the fracture is level or "
             "upright "
             "(sw-fracture --faces), move the source away by some cells, or use smaller cells";
    }
  return std::nullopt;
}

/// How many cells of one rock lie about a cell along the axis with the fewest, counted up to as many as a
/// source can be spread over.
template <int D>
std::int64_t cells_of_bed(const Medium<D>& medium, const Index<D>& centre) {
  const auto& grid = medium.grid();
  const auto alike = [&](const Index<D>& at) {
    const auto one = std::size_t(grid.flat(centre)), other = std::size_t(grid.flat(at));
    const auto of_one_rock = [&](Wave wave) {
      return are_one_rock(wave_impedance(medium, one, D - 1, wave),
                          wave_impedance(medium, other, D - 1, wave));
    };
    return of_one_rock(wave_p) && of_one_rock(wave_s);
  };
  std::int64_t fewest = narrowest_spread;
  for (std::size_t axis = 0; axis < D; ++axis) {
    std::int64_t cells = -1;  // the cell itself is counted twice
    for (const int way : {-1, 1})
      for (auto at = centre; cells < fewest && at[axis] >= 0 && at[axis] < grid.shape[axis] && alike(at);
           at[axis] += way)
        ++cells;
    fewest = std::min(fewest, cells);
  }
  return fewest;
}

/// What a moment that lasts leaves moving once its waves are gone, of the first source that leaves anything.
template <int D>
std::optional<std::string> motion_left_by_moments(const Scene<D>& scene) {
  const auto& medium = scene.model.medium;
  std::optional<bool> fluid;  // whether there is any, looked for once
  const auto holds_fluid = [&] {
    for (std::size_t cell = 0; !fluid && cell < medium.vp.size(); ++cell)
      if (medium.is_fluid(cell)) fluid = true;
    fluid = fluid.value_or(false);
    return *fluid;
  };
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    for (const auto* source : scene.survey.sources_of(shot)) {
      if (moment_of(*source) == Moment::passing) continue;
      const auto cell = cell_of(medium.grid(), source->position_m);
      if (!medium.is_solid(std::size_t(medium.grid().flat(cell)))) continue;
      const auto of_shot = "the moment of the source of shot " + std::to_string(shot) + " lasts, and ";
      if (const auto bed = cells_of_bed(medium, cell); bed < narrowest_spread)
        return of_shot + "its rock is " + std::to_string(bed) +
               " cells thick: the rock in its row and column may keep moving for seconds, by a tenth of the "
               "peak and more. Use smaller cells";
      if (holds_fluid())
        return of_shot +
               "water above rock may keep flowing within some cells of it when the waves have left, by "
               "percents "
               "of the peak. Read velocities in water while waves pass, or use smaller cells";
    }
  return std::nullopt;
}

/// Whether two solids meet anywhere at an interface where stencils end.
template <int D>
bool joins_unlike_solids(const Medium<D>& medium) {
  const auto& grid = medium.grid();
  for (std::int64_t n = 0; n < grid.size(); ++n)
    for (int axis = 0; axis < D; ++axis) {
      auto at = grid.index(n);
      if (++at[std::size_t(axis)] == grid.shape[std::size_t(axis)]) continue;
      const auto one = std::size_t(n), other = std::size_t(grid.flat(at));
      if (!medium.is_solid(one) || !medium.is_solid(other)) continue;
      if (strong_interface(medium, one, other, axis)) return true;
    }
  return false;
}

/// What a long run may gain where no wave can leave.
template <int D>
std::optional<std::string> gain_of_closed_box(const Scene<D>& scene, double steps) {
  if (steps <= steps_without_gain || any_edge_absorbs(scene) || !joins_unlike_solids(scene.model.medium))
    return std::nullopt;
  return "no edge absorbs, and waves along interfaces of unlike rocks may gain up to " +
         shown(100 * std::expm1(gain_in_a_step * steps), 2) + " % of their amplitude in " +
         shown(std::round(steps)) + " steps: let an edge absorb, or use larger cells";
}

}  // namespace

template <int D>
std::vector<std::string> warnings(const Scene<D>& scene) {
  const double highest = highest_frequency_hz(scene.survey);
  std::vector<std::string> sentences;
  const auto warn = [&](const Medium<D>& medium, double step_s) {
    const auto [slowest, cells, loss] = least_resolved_of(scene, medium, step_s, highest);
    if (cells >= fewest_cells || !sentences.empty()) return;
    const std::string wave = medium.is_fluid(std::size_t(slowest.cell)) ? "P" : "S";
    sentences.push_back("only " + shown(cells, 2) + " cells per shortest " + wave + " wavelength (" +
                        shown(slowest.speed, 4) + " m/s at " + place_of(medium.grid(), slowest.cell) + ", " +
                        shown(highest, 3) + " Hz), at least " + shown(fewest_cells) +
                        " needed: amplitude drops by " + shown(100 * loss, 2) +
                        " % per wavelength. Use cells of " +
                        shown(medium.grid().spacing_m * cells / fewest_cells, 2) + " m (" +
                        shown(std::pow(fewest_cells / cells, D + 1), 2) + " times the cost) or --error");
  };
  const auto of_all = {source_in_a_fracture(scene), motion_left_by_moments(scene)};
  const auto add = [&](const std::optional<std::string>& sentence) {
    if (sentence) sentences.push_back(*sentence);
  };
  if (scene.numerics.bands.empty()) {
    const double step_s = time_step_s(scene);
    warn(scene.model.medium, step_s);
    std::for_each(of_all.begin(), of_all.end(), add);
    add(gain_of_closed_box(scene, scene.recording.duration_s / step_s));
    return sentences;
  }
  const auto bands = scenes_of_bands(scene);
  const double step_s = time_step_s(bands.front());
  for (const auto& medium : media_of_bands(bands)) warn(medium, step_s);
  std::for_each(of_all.begin(), of_all.end(), add);
  if (const double steps = scene.recording.duration_s / step_s;
      scene.numerics.order > 5 && steps > steps_without_gain)
    sentences.push_back("bands may slowly gain energy at order " + std::to_string(scene.numerics.order) +
                        " in more than " + shown(steps_without_gain) + " steps, here " +
                        shown(std::round(steps)) + ": use --order 5");
  return sentences;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, plan);
SLIPWAVE_INSTANTIATE_D(FUNCTION, memory_of_run_bytes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, memory_of_a_shot_bytes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, cost_of_a_second);
SLIPWAVE_INSTANTIATE_D(FUNCTION, summary_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, report_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, warnings);

}  // namespace slipwave
