// On fitted grids, too, nothing may grow: slopes, curves, thin rows and strong contrasts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "fitted_medium.hpp"
#include "lab.hpp"
#include "model/coefficients.hpp"
#include "solver/effect/sponge.hpp"
#include "whole_effect.hpp"

namespace slipwave {
namespace {

struct Numbers {
  int order = 5, time_order = 2;
  double cfl = 1;
  int zone_cells = 8;
  double pml_hz = 0;  // 0: sponge
  unsigned seed = 1;
};

/// A random wave field on a fitted grid that evolves freely.
template <int D, class Real>
class FittedLab {
 public:
  FittedLab(const Medium<D>& medium, const EdgeLaws<D>& edges, const Numbers& numbers)
      : medium_(medium),
        domain_(solver::make_domain(medium_, edges, numbers.zone_cells)),
        dt_s_(numbers.cfl * medium_.grid().spacing_m / fastest_across_cells(medium_)),
        state_(solver::make_filled_state<D, Real>(domain_, medium_, dt_s_)),
        sweeps_(state_, domain_, numbers.order),
        splitting_(splitting(D, numbers.time_order)) {
    const double fastest = fastest_speed(medium_);
    if (domain_.grid.size() == domain_.model_grid.size()) {
    } else if (numbers.pml_hz > 0) {
      pml_ = std::make_unique<solver::Pml<D, Real>>(state_.layout, domain_, dt_s_, fastest, numbers.pml_hz,
                                                    numbers.time_order);
      sweeps_.use(pml_.get());
    } else {
      sponge_ = std::make_unique<solver::Sponge<D, Real>>(state_.layout, domain_, dt_s_, fastest, nullptr);
    }
    shake(numbers.seed);
  }

  void step() {
    for (const auto& sweep : splitting_) sweeps_.along(sweep.axis, Real(sweep.fraction));
    const solver::StepTime time{steps_++, dt_s_};
    if (!sponge_) return;
    solver::run_everywhere(*sponge_, time, state_);
    solver::run_after_everywhere(*sponge_, time, state_);
  }

  /// With the sponge, whose cells it counts too; without it that of solver::energy().
  double energy() const {
    if (!sponge_) return solver::energy(state_, domain_, medium_);
    double total = 0;
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const double counted = medium_.grid().height(domain_.model_cell(at));
      total += solver::energy_of_cell(state_, domain_, medium_, at) / counted * height(at);
    }
    return total;
  }

 private:
  /// Of a cell of the computed grid, in m: the mean over its corners.
  double height(const Index<D>& at) const {
    double sum = 0;
    for (int n = 0; n < 1 << D; ++n) {
      auto corner = at;
      for (int axis = 0; axis < D; ++axis) corner[std::size_t(axis)] += (n >> axis) & 1;
      sum += ((n >> (D - 1)) & 1 ? 1 : -1) * solver::corner_depth(domain_, corner);
    }
    return sum / (1 << (D - 1)) * domain_.grid.spacing_m;
  }

  void shake(unsigned seed) {
    using Rows = solver::FieldRows<D>;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const auto cell = std::size_t(medium_.grid().flat(domain_.model_cell(at)));
      const bool in_model = domain_.computed_cell(domain_.model_cell(at)) == at;
      if (medium_.is_void(cell) || (pml_ && !in_model)) continue;
      const bool solid = medium_.is_solid(cell);
      const double z = double(medium_.rho[cell]) * medium_.vp[cell], pressure = z * uniform(engine);
      for (int row = 0; row < Rows::count; ++row) {
        double value = uniform(engine);
        if (row >= D && row < 2 * D)
          value = solid ? z * value : pressure;
        else if (row >= 2 * D)
          value = solid ? 0.3 * z * value : 0;
        auto line = at;
        line[0] = 0;
        state_.field_row(line, row)[at[0]] = Real(value);
      }
    }
  }

  Medium<D> medium_;
  solver::Domain<D> domain_;
  double dt_s_;
  solver::State<D, Real> state_;
  solver::Sweeps<D, Real> sweeps_;
  std::unique_ptr<solver::Pml<D, Real>> pml_;
  std::unique_ptr<solver::Effect<D, Real>> sponge_;
  std::vector<SweepFraction> splitting_;
  std::int64_t steps_ = 0;
};

/// What became of the energy: the most it rose above its lowest value so far, as a share of that, what is
/// left of the first half of the steps in the second, and of all.
struct Course {
  double rise = 0, late = 0, left = 0;
};

template <int D, class Real>
Course course_of(FittedLab<D, Real>&& lab, int steps, int every = 1) {
  const double begin = lab.energy();
  double lowest = begin, half = begin, now = begin;
  Course course;
  for (int n = 1; n <= steps; ++n) {
    lab.step();
    if (n % every) continue;
    now = lab.energy();
    if (!(now <= 2 * begin)) return {INFINITY, INFINITY, now / begin};
    course.rise = std::max(course.rise, now / lowest - 1);
    lowest = std::min(lowest, now);
    if (n == steps / 2 / every * every) half = now;
  }
  course.late = now / half;
  course.left = now / begin;
  return course;
}

constexpr double h = 5;
const Below air{nullptr, 340, 0, 1.2}, water{nullptr, 1500, 0, 1000};

Below steel(std::function<double(double, double)> top) { return {std::move(top), 5900, 3200, 7800}; }
Below hard(std::function<double(double, double)> top) { return {std::move(top), 4500, 2250, 2500}; }
Below soft(std::function<double(double, double)> top) { return {std::move(top), 2500, 1200, 2000}; }
Below wet(std::function<double(double, double)> top) { return {std::move(top), 1500, 0, 1000}; }

std::function<double(double, double)> rolling(double mean, double amplitude, double wavelength) {
  return [=](double x, double y) {
    return mean + amplitude * std::sin(2 * std::numbers::pi * (x + 0.4 * y) / wavelength);
  };
}

double tan_of(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

/// Media on fitted grids that are hard on a scheme; all measures in cells.
Medium<2> fitted_named(const std::string& name, int nx, int nz) {
  const Grid<2> grid{{nx, nz}, h, {0, 0}};
  const double middle = nx * h / 2, depth = (nz / 2 + 0.37) * h;
  const auto plane = [&](double degrees) { return dipping(depth, tan_of(degrees), middle); };
  // A sine of this wavelength whose sharpest bend has a radius of 10 cells.
  const auto curve = [&](double cells) {
    return rolling(depth, cells * cells / (40 * std::numbers::pi * std::numbers::pi) * h, cells * h);
  };
  for (const int degrees : {0, 15, 30, 45}) {
    const auto dip = std::to_string(degrees);
    if (name == "WaterOverRockDip" + dip) return fitted_medium<2>(grid, {water, hard(plane(degrees))});
    if (name == "AirOverSteelDip" + dip) return fitted_medium<2>(grid, {air, steel(plane(degrees))});
    if (name == "SoftOverHardDip" + dip) return fitted_medium<2>(grid, {soft(nullptr), hard(plane(degrees))});
    if (name == "SurfaceDip" + dip)
      return fitted_medium<2>(grid, {hard(dipping(depth - nz / 4 * h, tan_of(degrees), middle))}, true);
  }
  if (name == "WaterOverCurvedRock") return fitted_medium<2>(grid, {water, hard(curve(20))});
  if (name == "AirOverCurvedSteel") return fitted_medium<2>(grid, {air, steel(curve(20))});
  if (name == "SteelUnderCurvedWideAir") return fitted_medium<2>(grid, {air, steel(curve(40))});
  if (name == "CurvedSurface") return fitted_medium<2>(grid, {soft(curve(20))}, true);
  if (name == "CurvedSurfaceOfWaterOverRock")
    return fitted_medium<2>(grid, {wet(rolling(6.3 * h, h, 15 * h)), hard(curve(40))}, true);
  if (name == "ThinRows")  // of a bed from 0.22 to 0.9 of a cell
    return fitted_medium<2>(grid, {water, hard(rolling(depth, h, 30 * h)), wet([=](double x, double) {
                                     return depth + h * std::sin(2 * std::numbers::pi * x / (30 * h)) +
                                            h * (0.56 + 0.34 * std::sin(x / (4 * h)));
                                   })});
  if (name == "ThinFluid")
    return fitted_medium<2>(
        grid, {soft(nullptr), wet(plane(15)), steel(dipping(depth + 0.23 * h, tan_of(15), middle))});
  if (name == "FlatThinRows")
    return fitted_medium<2>(grid, {water, steel(dipping(depth, 0)), wet(dipping(depth + 0.21 * h, 0)),
                                   soft(dipping(depth + 2.7 * h, 0))});
  throw std::logic_error("no medium " + name);
}

const std::vector<std::string> inside_names = {
    "WaterOverRockDip0", "WaterOverRockDip15",  "WaterOverRockDip30", "WaterOverRockDip45",
    "AirOverSteelDip15", "AirOverSteelDip30",   "AirOverSteelDip45",  "SoftOverHardDip30",
    "SoftOverHardDip45", "WaterOverCurvedRock", "AirOverCurvedSteel", "SteelUnderCurvedWideAir",
    "ThinRows",          "ThinFluid",           "FlatThinRows",       "SurfaceDip15",
    "SurfaceDip30",      "SurfaceDip45",        "CurvedSurface",      "CurvedSurfaceOfWaterOverRock"};

TEST(Measure, All) {
  const ThreadLimit one(1);
  const char* filter = std::getenv("FT_NAME");
  const int steps = std::getenv("FT_STEPS") ? std::atoi(std::getenv("FT_STEPS")) : 600;
  for (const auto& name : inside_names) {
    if (filter && name.find(filter) == std::string::npos) continue;
    Medium<2> medium;
    try {
      medium = fitted_named(name, 30, 60);
    } catch (const std::exception& e) {
      std::printf("%-30s %s\n", name.c_str(), e.what());
      continue;
    }
    const auto [thin, thick] = medium.grid().rows->heights();
    std::printf("%-30s rows %.2f..%.2f\n", name.c_str(), thin / h, thick / h);
    for (const auto edge : {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::absorbing})
      for (const int order : {1, 3, 5, 7})
        for (const bool is_double : {true, false})
          for (const int time_order : {2, 4}) {
            if (!is_double && time_order == 4) continue;
            auto edges = all_edges(edge);
            if (edge == EdgeLaw::absorbing) edges[1][0] = EdgeLaw::free;
            Numbers numbers;
            numbers.order = order, numbers.time_order = time_order;
            const auto course = is_double ? course_of(FittedLab<2, double>(medium, edges, numbers), steps)
                                          : course_of(FittedLab<2, float>(medium, edges, numbers), steps);
            const bool bad = course.rise > (is_double ? 1e-11 : 1e-5);
            if (bad || std::getenv("FT_ALL"))
              std::printf("    edge %d order %d %s t%d: rise %.2e late %.4f left %.2e\n", int(edge), order,
                          is_double ? "double" : "float", time_order, course.rise, course.late, course.left);
            std::fflush(stdout);
          }
  }
}

}  // namespace
}  // namespace slipwave
