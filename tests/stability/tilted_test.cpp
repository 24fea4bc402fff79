// Energy in cells that interfaces cut, whose axes of symmetry do not lie along the grid.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "lab.hpp"
#include "model/layers.hpp"
#include "model/tilted_mean.hpp"

namespace slipwave {
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

}  // namespace

TEST(EnergyOfTiltedMeans, NeverRisesWhateverTheyAre) {
  const ThreadLimit one_thread(1);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&] { return uniform(engine); };
  const int media = long_form() ? 30 : 3, steps = long_form() ? 20000 : 250;
  for (int n = 0; n < media; ++n)
    for (const int block : {1, 4})
      for (const int order : {3, 5, 7}) {
        SCOPED_TRACE("medium " + std::to_string(n) + " block " + std::to_string(block) + " order " +
                     std::to_string(order));
        constexpr int cells = 24;
        Medium<2> medium = rock(cells, cells);
        add_tilted_means(medium);
        const double share = n % 3 == 0 ? 1 : 0.5;
        for (int k = 0; k < cells; k += block)
          for (int i = 0; i < cells; i += block) {
            const auto any = random_anisotropic(random);
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
        expect_no_growth_of<double>(medium, n % 2 ? EdgeLaw::free : EdgeLaw::rigid, order, n % 3 ? 1 : 0.6,
                                    steps);
        if (n == 0) expect_no_growth_of<float>(medium, EdgeLaw::free, order, 1, steps);
      }
}

TEST(EnergyOfTiltedMeans, NeverRisesAtInterfacesOfAnyDipAndContrast) {
  const ThreadLimit one_thread(1);
  const Material soft{1600, 400, 1800}, harder{2500, 1200, 2100}, hardest{6000, 3500, 2800};
  const int steps = long_form() ? 20000 : 300;
  for (const double dip : {0., 3., 15., 30., 45., 75.})
    for (const auto& [over, under] :
         {std::pair{soft, harder}, std::pair{soft, hardest}, std::pair{hardest, soft}})
      for (const int order : {3, 5, 7}) {
        SCOPED_TRACE("dip " + std::to_string(dip) + " order " + std::to_string(order));
        const auto medium = cut(32, dip, over, under);
        ASSERT_GT(tilted_means(medium), 20);
        expect_no_growth_of<double>(medium, order == 5 ? EdgeLaw::free : EdgeLaw::rigid, order, 1, steps);
        if (order == 7) expect_no_growth_of<float>(medium, EdgeLaw::rigid, order, 1.9, steps / 2, 4);
      }
}

}  // namespace slipwave
