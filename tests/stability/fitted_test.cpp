// On fitted grids, too, nothing may grow: slopes, curves, thin rows and strong contrasts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fitted_medium.hpp"
#include "lab.hpp"
#include "model/coefficients.hpp"

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
        domain_(solver::make_domain(medium_, edges, numbers.zone_cells, {}, numbers.order)),
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
    } else if constexpr (D == 2) {
      sponge_ = std::make_unique<Sponge<D, Real>>(domain_, dt_s_, fastest);
    }
    shake(numbers.seed);
  }

  void step() {
    for (const auto& sweep : splitting_) sweeps_.along(sweep.axis, Real(sweep.fraction));
    if (sponge_) sponge_->damp(state_);
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
  std::unique_ptr<Sponge<D, Real>> sponge_;
  std::vector<SweepFraction> splitting_;
};

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

const std::vector<std::string>& fitted_names() {
  static const std::vector<std::string> all = {
      "WaterOverRockDip0", "WaterOverRockDip15",  "WaterOverRockDip30", "WaterOverRockDip45",
      "AirOverSteelDip15", "AirOverSteelDip30",   "AirOverSteelDip45",  "SoftOverHardDip30",
      "SoftOverHardDip45", "WaterOverCurvedRock", "AirOverCurvedSteel", "SteelUnderCurvedWideAir",
      "ThinRows",          "ThinFluid",           "FlatThinRows",       "SurfaceDip15",
      "SurfaceDip30",      "SurfaceDip45",        "CurvedSurface",      "CurvedSurfaceOfWaterOverRock"};
  return all;
}

EdgeLaws<2> edges_below(EdgeLaw top, EdgeLaw others) {
  auto edges = all_edges(others);
  edges[1][0] = top;
  return edges;
}

/// What is known to hold of a regular grid: in no step more energy than ever before, but for rounding. After
/// the first steps it is counted in every tenth.
template <class Real, int D>
void expect_no_growth(const Medium<D>& medium, const EdgeLaws<D>& edges, const Numbers& numbers, int steps) {
  SCOPED_TRACE("order " + std::to_string(numbers.order) + ", " + std::to_string(numbers.time_order) +
               " in time, cfl " + std::to_string(numbers.cfl) + ", top " +
               std::to_string(int(edges[D - 1][0])) + ", sides " + std::to_string(int(edges[0][0])) +
               (sizeof(Real) == 4 ? ", float" : ", double"));
  FittedLab<D, Real> lab(medium, edges, numbers);
  const double begin = lab.energy();
  ASSERT_GT(begin, 0);
  double lowest = begin;
  for (int n = 1; n <= steps; ++n) {
    lab.step();
    if (n > 100 && n % 10) continue;
    const double now = lab.energy();
    // Written so that NaN fails.
    ASSERT_TRUE(now <= lowest * (1 + rounding<Real>()))
        << "step " << n << ": the energy is " << now << ", it was down to " << lowest << " and began as "
        << begin;
    lowest = std::min(lowest, now);
  }
}

class FittedEnergy : public ::testing::TestWithParam<std::string> {
 protected:
  Medium<2> medium() const {
    return long_form() ? fitted_named(GetParam(), 40, 88) : fitted_named(GetParam(), 20, 44);
  }
  const ThreadLimit one_thread_{1};
  const int steps_ = long_form() ? 20000 : 1000;
};

TEST_P(FittedEnergy, NeverRisesInDouble) {
  for (const int order : orders)
    for (const auto edge : {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::absorbing}) {
      if (!long_form() && (order == 1 ? edge != EdgeLaw::free : order == 3 && edge != EdgeLaw::rigid))
        continue;
      const auto edges = edges_below(edge == EdgeLaw::absorbing ? EdgeLaw::free : edge, edge);
      expect_no_growth<double>(medium(), edges, {order}, steps_);
    }
}

TEST_P(FittedEnergy, NeverRisesInFloat) {
  for (const auto& [order, edge] : {std::pair(5, EdgeLaw::free), std::pair(7, EdgeLaw::absorbing)})
    expect_no_growth<float>(medium(), all_edges(edge), {order}, steps_);
}

TEST_P(FittedEnergy, NeverRisesAtFourthOrderInTimeOrInSmallSteps) {
  for (const int order : {5, 7}) {
    for (const double cfl : {1., 2.})
      expect_no_growth<double>(medium(), all_edges(EdgeLaw::free), {order, 4, cfl}, steps_ / 4);
    expect_no_growth<double>(medium(), all_edges(EdgeLaw::free), {order, 2, 0.3}, steps_ / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedEnergy, ::testing::ValuesIn(fitted_names()),
                         [](const auto& info) { return info.param; });

TEST(FittedCubeEnergy, NeverRises) {
  const ThreadLimit one_thread(1);
  const Grid<3> grid{{12, 10, 26}, h, {0, 0, 0}};
  const auto dip = [](double x, double y) { return 61.3 + 0.5 * (x - 30) - 0.3 * (y - 25); };
  const auto hills = [](double x, double y) { return 41 + 4 * std::sin(x / 12) * std::cos(y / 15); };
  for (const auto& medium :
       {fitted_medium<3>(grid, {water, hard(dip)}), fitted_medium<3>(grid, {air, steel(hills)}),
        fitted_medium<3>(grid, {soft(hills)}, true)})
    for (const auto edge : {EdgeLaw::free, EdgeLaw::rigid}) {
      EdgeLaws<3> edges;
      for (int axis = 0; axis < 3; ++axis) edges[axis] = {edge, edge};
      for (const int order : {3, 7})
        expect_no_growth<double>(medium, edges, {order}, long_form() ? 4000 : 120);
      expect_no_growth<float>(medium, edges, {5}, long_form() ? 4000 : 120);
    }
}

class FittedPml : public ::testing::TestWithParam<std::string> {};

// Beyond curved sides and tops the layer damps rows that bend.
TEST_P(FittedPml, StaysBoundedForThousandsOfSteps) {
  const ThreadLimit one_thread(1);
  const auto medium = fitted_named(GetParam(), 14, 36);
  for (const auto& [order, top, zone_cells] : {std::tuple(3, EdgeLaw::absorbing, 8),
                                               {5, EdgeLaw::free, 8},
                                               {5, EdgeLaw::absorbing, 20},
                                               {7, EdgeLaw::rigid, 8},
                                               {7, EdgeLaw::free, 20}}) {
    Numbers numbers{order};
    numbers.zone_cells = zone_cells;
    numbers.pml_hz = 30;
    SCOPED_TRACE("order " + std::to_string(order) + ", top " + std::to_string(int(top)) + ", " +
                 std::to_string(zone_cells) + " cells");
    FittedLab<2, double> lab(medium, edges_below(top, EdgeLaw::absorbing), numbers);
    const double begin = lab.energy();
    for (int n = 0; n < 500; ++n) lab.step();
    const double early = lab.energy();
    EXPECT_LT(early, begin);
    for (int piece = 0; piece < (long_form() ? 39 : 7); ++piece) {
      for (int n = 0; n < 500; ++n) lab.step();
      // Written so that NaN fails.
      ASSERT_TRUE(lab.energy() < 1.001 * early)
          << "after " << 1000 + piece * 500 << " steps: " << lab.energy() << ", it was " << early;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedPml, ::testing::ValuesIn(fitted_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace slipwave
