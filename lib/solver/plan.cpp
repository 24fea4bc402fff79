#include "solver/plan.hpp"

#include <cmath>

#include "base/error.hpp"
#include "solver/dispersion.hpp"
#include "solver/step.hpp"

namespace slipwave {
namespace {

/// Fewer cells a wavelength than this are worth a warning.
constexpr double fewest_cells = 4;

std::string rounded(double value, int digits) {
  const double unit = std::pow(10, digits - 1 - std::floor(std::log10(std::abs(value))));
  return value == 0 ? "0" : shown(std::round(value * unit) / unit);
}

template <int D>
double cells_a_wavelength(const Scene<D>& scene, const SlowestWave& slowest, double hz) {
  return slowest.speed / hz / scene.model.grid().spacing_m;
}

template <int D>
double loss_of(const Scene<D>& scene, const SlowestWave& slowest, double cells) {
  const double courant = slowest.speed * time_step_s(scene) / scene.model.grid().spacing_m;
  // Waves shorter than two cells are not on the grid at all.
  return cells > 2 ? solver::loss_per_wavelength(scene.numerics.order, courant, cells) : 1;
}

template <int D, class Real>
Plan<D> plan_as(const Scene<D>& scene) {
  const solver::Step<D, Real> step(scene, 1, [](double, const FieldReader<D>&) {});
  Plan<D> plan;
  plan.computed = step.domain().grid;
  plan.time_step_s = time_step_s(scene);
  plan.courant = plan.time_step_s / stable_time_step_s(scene);
  plan.steps = step.steps();
  plan.passes = step.planned();
  plan.span_ends = step.sweeps().span_end_cells();
  plan.memory_bytes = step.memory_bytes();
  plan.highest_hz = highest_frequency_hz(scene.survey);
  plan.slowest = slowest_wave(scene.model.medium);
  plan.points_per_wavelength = cells_a_wavelength(scene, plan.slowest, plan.highest_hz);
  plan.loss_per_wavelength = loss_of(scene, plan.slowest, plan.points_per_wavelength);
  plan.instruction_set = solver::instruction_set();
  return plan;
}

}  // namespace

template <int D>
Plan<D> plan(const Scene<D>& scene) {
  return scene.numerics.double_precision ? plan_as<D, double>(scene) : plan_as<D, float>(scene);
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
  report.number("cells a shortest wavelength", plan.points_per_wavelength, "");
  report.text("its loss by the scheme",
              rounded(100 * plan.loss_per_wavelength, 2) + " % of the amplitude a wavelength");
  report.count("cells beside contacts", plan.span_ends);
  report.text("memory", rounded(double(plan.memory_bytes) / (1 << 20), 3) + " MiB");
  report.text("instruction set", plan.instruction_set);
  for (const auto& pass : plan.passes)
    report.text("pass", pass.name + ": " + rounded(100 * pass.share, 3) + " % of the cells");
  return report;
}

template <int D>
std::vector<std::string> warnings(const Scene<D>& scene) {
  const auto slowest = slowest_wave(scene.model.medium);
  const double highest = highest_frequency_hz(scene.survey);
  const double cells = cells_a_wavelength(scene, slowest, highest);
  if (cells >= fewest_cells) return {};
  const double h = scene.model.grid().spacing_m;
  return {"found " + rounded(cells, 2) + " cells a shortest wavelength (" + rounded(slowest.speed, 4) +
          " m/s at " + place_of(scene.model.grid(), slowest.cell) + ", " + rounded(highest, 3) +
          " Hz), expected at least " + shown(fewest_cells) + ": such waves lose " +
          rounded(100 * loss_of(scene, slowest, cells), 2) + " % of their amplitude a wavelength; cells of " +
          rounded(h * cells / fewest_cells, 2) + " m would do, at " +
          rounded(std::pow(fewest_cells / cells, D + 1), 2) + " times the cost"};
}

template Plan<2> plan(const Scene<2>&);
template Report report_of(const Plan<2>&);
template std::vector<std::string> warnings(const Scene<2>&);

}  // namespace slipwave
