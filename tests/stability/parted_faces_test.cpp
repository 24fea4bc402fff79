// Fractures on faces between cells: the energy of waves and springs falls in the long run, in any rock, open
// or not (docs/theory.md 2.8).
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "slip_cases.hpp"

namespace slipwave {
namespace {

int cells() { return long_form() ? 40 : 28; }
int steps() { return long_form() ? 20000 : 300; }

FractureSet<2> fractures(const std::vector<FractureTrace<2>>& traces, double normal, double tangential) {
  SlipSystem<2> system{{0, 1}, 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {normal, tangential, 0, 0, 0};
  return {"on faces", {system}, traces, true};
}

/// Level and upright ones, also side by side, and some that cross.
std::vector<FractureTrace<2>> some_traces(const Grid<2>& grid, unsigned seed) {
  std::mt19937 engine(seed);
  std::vector<FractureTrace<2>> traces;
  for (int n = 0; n < 6; ++n) {
    const std::size_t along = n % 2 == 0 ? 0 : 1;
    const double end = grid.spacing_m * double(cells());
    const auto at = [&](double from, double to) {
      return end * std::uniform_real_distribution<double>(from, to)(engine);
    };
    Point<2> one{}, other{};
    one[along] = at(0.02, 0.4), other[along] = one[along] + at(0.2, 0.5);
    one[1 - along] = other[1 - along] = at(0.1, 0.9);
    traces.push_back({one, other});
  }
  return traces;
}

template <class Real>
void expect_bounded(const typename Lab<Real>::Setup& given) {
  Lab<Real> lab(given);
  const double first = lab.energy();
  double before = first;
  for (int n = 0; n < steps(); ++n) {
    lab.step();
    if (n % 10 != 9) continue;
    const double now = lab.energy();
    ASSERT_TRUE(now <= first) << "step " << n << ": " << now << " of " << first;
    // Corrections along open faces may raise it for a while, as those of free surfaces do.
    ASSERT_TRUE(now <= before * 1.01) << "step " << n << ": " << now << " after " << before;
    before = std::min(before, now);
  }
}

class PartedFaces : public ::testing::TestWithParam<std::string> {};

TEST_P(PartedFaces, KeepEnergyFallingOpenOrNot) {
  const ThreadLimit one_thread(1);
  constexpr double open = std::numeric_limits<double>::infinity(), soft = 1e-9 * 5;
  unsigned seed = 1;
  for (const int order : {1, 5, 7, 11})
    for (const auto& [normal, tangential] :
         {std::pair{open, open}, {soft, soft}, {0., open}, {soft / 100, soft / 30}}) {
      typename Lab<double>::Setup setup;
      setup.medium = medium_named(GetParam(), cells());
      setup.order = order;
      setup.cfl = seed % 2 == 0 ? 1 : 0.6;
      setup.edges = all_edges(seed % 3 == 0 ? EdgeLaw::rigid : EdgeLaw::free);
      setup.seed = seed;
      setup.fracture_sets = {fractures(some_traces(setup.medium.grid(), seed), normal, tangential)};
      setup.fracture = Field<2, std::uint8_t>(setup.medium.grid());
      SCOPED_TRACE("order " + std::to_string(order) + ", compliances " + shown(normal) + ", " +
                   shown(tangential) + ", seed " + std::to_string(seed));
      expect_bounded<double>(setup);
      ++seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Media, PartedFaces,
                         ::testing::Values("SofterRockInRock", "SoilOverRock", "RandomMixture"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace slipwave
