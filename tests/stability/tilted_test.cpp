// SPDX-License-Identifier: BSD-3-Clause
// Energy in cells that interfaces cut, whose axes of symmetry do not lie along the grid.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "geology/layers.hpp"
#include "lab.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave::tilted_test {
namespace {

template <class Real>
void expect_no_growth_of(const Medium<2>& medium, EdgeLaw edges, int order, double cfl, int steps,
                         int time_order = 2) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium;
  setup.edges = all_edges(edges);
  setup.order = order;
  setup.cfl = cfl;
  setup.time_order = time_order;
  Lab<Real>(setup).expect_no_growth(steps, rounding<Real>());
}

/// Two rocks above and below a line through the middle of a square of cells.
Medium<2> cut(int cells, double dip_deg, const Material& over, const Material& under) {
  const Grid<2> grid{{cells, cells}, 5, {0, 0}};
  const double middle = 2.5 * cells, slope = std::tan(dip_deg * std::numbers::pi / 180);
  return layered_medium<2>(grid,
                           {{-1e6, over.vp, over.vs, over.rho},
                            {middle * (1 - slope) + 1.7, under.vp, under.vs, under.rho, dip_deg}},
                           Average::tilted);
}

/// Blocks of tilted means, their dips at random, among isotropic rocks and, in odd media, water.
Medium<2> tilted_blocks(int n, int block, const std::function<Material()>& draw,
                        const std::function<double()>& random) {
  constexpr int cells = 24;
  Medium<2> medium = rock(cells, cells);
  add_tilted_means(medium);
  const double share = n % 3 == 0 ? 1 : 0.5;
  for (int k = 0; k < cells; k += block)
    for (int i = 0; i < cells; i += block) {
      const auto any = draw();
      const double dip = (2 * random() - 1) * std::numbers::pi / 2, kind = random();
      for (int m = 0; m < block * block; ++m) {
        const int row = k + m / block, column = i + m % block;
        if (row >= cells || column >= cells) continue;
        const auto cell = std::size_t(row * cells + column);
        if (kind > share && n % 2 == 1 && kind > 0.8) {
          put(medium, cell, {1500, 0, 1000});
          continue;
        }
        put(medium, cell, {any.vp, any.vs, any.rho});
        if (kind < share) put_tilted_mean(medium, cell, any, dip);
      }
    }
  return medium;
}

/// Impedances of all that it draws for one medium differ by less than 4 times, from P to P and from S to S.
std::function<Material()> rocks_alike(const std::function<double()>& random) {
  const double slowest = 1500 + 1500 * random(), ratio = 0.15 + 0.45 * random();
  return [=] {
    for (;;) {
      const double vp = slowest * (1 + 1.2 * random()), vs = vp * ratio * (1 + 0.15 * random());
      const Material any{vp, vs, 1800 + 800 * random(), -0.4 + 1.4 * random(), -0.4 + 1.4 * random()};
      if (!fault_of_anisotropy(any)) return any;
    }
  };
}

}  // namespace

// Proves (T5).
TEST(EnergyOfTiltedMeans, NeverRisesWhateverTheyAre) {
  const ThreadLimit one_thread(1);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::function<double()> random = [&] { return uniform(engine); };
  const int media = long_form() ? 6 : 4, steps = long_form() ? 20000 : 200;
  for (int n = 0; n < media; ++n)
    for (const int block : {1, 4})
      for (const int order : share_of(std::vector{3, 5, 7}, std::size_t(n + block / 4))) {
        SCOPED_TRACE("medium " + std::to_string(n) + " block " + std::to_string(block) + " order " +
                     std::to_string(order));
        // Of two media in turn: impedances that tilted means may part, and any, where some stay isotropic.
        const bool alike = n / 2 % 2 == 0;
        const auto draw = alike ? rocks_alike(random)
                                : std::function<Material()>([&] { return random_anisotropic(random); });
        const auto medium = tilted_blocks(n, block, draw, random);
        if (alike && n % 2 == 0) {
          ASSERT_EQ(solver::make_domain<2>(medium, all_edges(EdgeLaw::rigid), 0).anisotropic_cells().size(),
                    cells_of_tilted_means(medium).size());
        }
        expect_no_growth_of<double>(medium, n % 2 ? EdgeLaw::free : EdgeLaw::rigid, order, n % 3 ? 1 : 0.6,
                                    steps);
        if (n == 0) expect_no_growth_of<float>(medium, EdgeLaw::free, order, 1, steps);
      }
}

// Proves (T5).
TEST(EnergyOfTiltedMeans, NeverRisesUpToTheLargestContrastTheyPart) {
  const ThreadLimit one_thread(1);
  // Impedances of P, of S, and of both, 3.9 times those above.
  const Material slow{1600, 900, 1800};
  const int steps = long_form() ? 20000 : 300;
  int turn = 0;
  for (const double dip : {0., 8., 22., 38., 45., 60., 82., -30.})
    for (const Material& fast :
         {Material{4160, 1200, 2700}, Material{2600, 1500, 2700}, Material{4160, 2340, 2700}})
      for (const int order : long_form() ? std::vector{3, 5, 7, 9, 11} : std::vector{turn++ % 2 ? 9 : 5}) {
        SCOPED_TRACE("dip " + std::to_string(dip) + " order " + std::to_string(order));
        const auto medium = cut(32, dip, slow, fast);
        ASSERT_GT(solver::make_domain<2>(medium, all_edges(EdgeLaw::rigid), 0).anisotropic_cells().size(),
                  20U);
        expect_no_growth_of<double>(medium, EdgeLaw::rigid, order, 1, steps);
        if (long_form() && order == 7)
          expect_no_growth_of<double>(medium, EdgeLaw::rigid, order, 1.9, steps / 4, 4);
      }
}

// Proves (T5).
TEST(EnergyOfTiltedMeans, NeverRisesAtInterfacesOfAnyDipAndContrast) {
  const ThreadLimit one_thread(1);
  const Material soft{1600, 400, 1800}, harder{2500, 1200, 2100}, hardest{6000, 3500, 2800};
  const int steps = long_form() ? 20000 : 300;
  std::size_t turn = 0;
  for (const double dip : {0., 3., 15., 30., 45., 75.})
    for (const auto& [over, under] :
         {std::pair{soft, harder}, std::pair{soft, hardest}, std::pair{hardest, soft}})
      for (const int order : share_of(std::vector{3, 5, 7}, turn++ % 4)) {
        SCOPED_TRACE("dip " + std::to_string(dip) + " order " + std::to_string(order));
        const auto medium = cut(32, dip, over, under);
        ASSERT_GT(tilted_means(medium), 20);
        // Edges without traction let it waver by a thousandth of what is left (E11c).
        expect_no_growth_of<double>(medium, EdgeLaw::rigid, order, 1, steps);
        if (order == 7) expect_no_growth_of<float>(medium, EdgeLaw::rigid, order, 1.9, steps / 2, 4);
      }
}

TEST(EnergyOfTiltedRock, NeverRisesWhateverItIs) {
  const ThreadLimit one_thread(1);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::function<double()> random = [&] { return uniform(engine); };
  const int media = long_form() ? 6 : 4, steps = long_form() ? 20000 : 200;
  constexpr int cells = 24;
  for (int n = 0; n < media; ++n)
    for (const int block : {1, 6})
      for (const int order : long_form() ? std::vector{3, 5, 7, 11} : std::vector{5, 9}) {
        SCOPED_TRACE("medium " + std::to_string(n) + " block " + std::to_string(block) + " order " +
                     std::to_string(order));
        std::vector<Material> rocks;
        const auto draw = n / 2 % 2 == 0
                              ? rocks_alike(random)
                              : std::function<Material()>([&] { return random_anisotropic(random); });
        for (int k = 0; k < cells * cells; ++k) {
          auto any = draw();
          any.tilt = 180 * random() - 90;
          if (n % 2 == 1 && random() < 0.2) any = {1500, 0, 1000};
          rocks.push_back(any);
        }
        Medium<2> medium = rock(cells, cells);
        for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
          medium[property] = Field<2>(medium.grid());
        for (int cell = 0; cell < cells * cells; ++cell)
          put(medium, std::size_t(cell),
              rocks[std::size_t(cell / cells / block * cells + cell % cells / block)]);
        expect_no_growth_of<double>(medium, EdgeLaw::rigid, order, n % 3 ? 1 : 0.6, steps);
        if (n == 0) expect_no_growth_of<float>(medium, EdgeLaw::rigid, order, 1, steps);
      }
}

}  // namespace slipwave::tilted_test
