// SPDX-License-Identifier: BSD-3-Clause
// Planes that give way as springs at any angle to the axes of anisotropic rock: the energy of waves and
// springs never rises above that of the beginning (docs/theory.md (S25), (S34b)).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lab.hpp"
#include "media.hpp"
#include "slip_cases.hpp"

namespace slipwave::askew_springs_test {
namespace {

constexpr double usual_mu = 1e10;

/// Blocks of any anisotropic rock; where it `tilts`, about any axis.
Medium<2> rocks(int cells, int block, bool tilts, bool alike, const std::function<double()>& random) {
  Medium<2> medium = rock(cells, cells);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(medium.grid());
  std::vector<Material> drawn;
  auto first = random_anisotropic(random);
  for (int n = 0; n < cells * cells; ++n) {
    auto any = alike ? first : random_anisotropic(random);
    any.tilt = tilts ? 180 * random() - 90 : 0;
    drawn.push_back(any);
  }
  for (int cell = 0; cell < cells * cells; ++cell)
    put(medium, std::size_t(cell), drawn[std::size_t(cell / cells / block * cells + cell % cells / block)]);
  return medium;
}

/// What a run had, for a failure.
struct Run {
  int number;
  bool tilts;
  int families;
  double softness;
};
void expect_no_growth(const Run& run, int cells, int steps) {
  std::mt19937 engine(unsigned(run.number) + 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::function<double()> random = [&] { return uniform(engine); };
  Lab<double>::Setup setup;
  setup.medium = rocks(cells,
                       run.number % 3 == 0   ? 1
                       : run.number % 3 == 1 ? 6
                                             : cells,
                       run.tilts, run.number % 4 == 0, random);
  FractureSet<2> set{"springs", {}};
  for (int family = 0; family < run.families; ++family) {
    set.systems.push_back(system_of(360 * random(), {0, 0}));
    auto& system = set.systems.back();
    system.law = FrictionLaw::none;
    const double z = run.softness / usual_mu;
    system.compliance = {run.number % 5 == 0 ? 0 : z * random(), z * random(), 0, 0, 1};
  }
  setup.fracture_sets = {set};
  setup.fracture = Field<2, std::uint8_t>(setup.medium.grid());
  for (std::size_t cell = 0; cell < std::size_t(cells * cells); ++cell)
    setup.fracture[cell] = run.number % 2 == 0 || random() < 0.5;
  const auto edge = run.number % 3 == 2 ? EdgeLaw::free : EdgeLaw::rigid;
  setup.edges = all_edges(edge);
  const int all[] = {5, 3, 7, 9, 11, 1};
  setup.order = all[run.number % 6];
  setup.cfl = run.number % 7 == 6 ? 0.6 : 1;
  setup.correction = run.number % 2 ? SlipCorrection::second : corrections()[std::size_t(run.number) / 2 % 3];
  SCOPED_TRACE("run " + std::to_string(run.number) + (run.tilts ? " tilted" : " upright") + ", softness " +
               std::to_string(run.softness) + ", order " + std::to_string(setup.order));
  Lab<double> lab(setup);
  const double begin = lab.energy();
  ASSERT_GT(begin, 0);
  for (int n = 0; n < steps; ++n) {
    lab.step();
    if (n > 50 && n % 10) continue;
    const double now = lab.energy();
    ASSERT_TRUE(now <= begin * (1 + rounding<double>())) << "step " << n << ": " << now << " of " << begin;
  }
}

// Proves (T6), (S34b).
TEST(AskewSprings, NeverAddEnergyHoweverStiffOrSoft) {
  const ThreadLimit one_thread(1);
  constexpr int cells = 14;
  const int steps = long_form() ? 10000 : 120;
  int number = 0;
  for (int round = 0; round < (long_form() ? 8 : 2); ++round)
    for (const bool tilts : {true, false})
      for (const int families : {1, 2})
        for (const double softness : {1e-3, 1., 30., 1e4, 1e9})
          expect_no_growth({number++, tilts, families, softness}, cells, steps);
}

/// Four blocks of one rock, each with beds that dip otherwise, between walls.
Lab<double>::Setup tilted_blocks(unsigned draw, int order) {
  std::mt19937 engine(draw);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::function<double()> random = [&] { return uniform(engine); };
  constexpr int block = 6, cells = 2 * block;
  Lab<double>::Setup setup;
  setup.medium = rocks(cells, block, true, true, random);
  setup.edges = all_edges(EdgeLaw::rigid);
  setup.order = order;
  return setup;
}

/// Planes that carry nothing leave motion alone but for what the sweeps take: these must not feed it.
// Proves (T6).
TEST(TiltedBlocks, LoseMotionHoweverSoftTheirPlanesAre) {
  const ThreadLimit one_thread(1);
  for (unsigned draw = 1; draw <= (long_form() ? 12U : 4U); ++draw)
    for (const int order : {5, 11}) {
      auto setup = tilted_blocks(draw, order);
      FractureSet<2> set{"springs", {}};
      for (const double angle_deg : {20., 75.}) {
        set.systems.push_back(system_of(angle_deg, {0, 0}));
        set.systems.back().law = FrictionLaw::none;
        set.systems.back().compliance = {1e9 / usual_mu, 1e9 / usual_mu, 0, 0, 1};
      }
      setup.fracture_sets = {set};
      setup.fracture = Field<2, std::uint8_t>(setup.medium.grid(), 1);
      SCOPED_TRACE("draw " + std::to_string(draw) + ", order " + std::to_string(order));
      Lab<double> lab(setup);
      const double begin = lab.kinetic_energy();
      double middle = begin;
      const int steps = long_form() ? 6000 : 1200;
      for (int n = 1; n <= steps; ++n) {
        lab.step();
        if (n == steps / 2) middle = lab.kinetic_energy();
      }
      const double end = lab.kinetic_energy();
      EXPECT_TRUE(middle < begin && end < middle) << begin << ' ' << middle << ' ' << end;
    }
}

// Proves (T6).
TEST(TiltedBlocks, LoseEnergyInTheLongRun) {
  const ThreadLimit one_thread(1);
  for (const int order : {5, 11}) {
    Lab<double> lab(tilted_blocks(1, order));
    for (int n = 0; n < 10000; ++n) lab.step();
    double last = lab.energy();
    for (int part = 0; part < 3; ++part) {
      for (int n = 0; n < 10000; ++n) lab.step();
      const double now = lab.energy();
      EXPECT_LT(now, last) << "order " << order << ", part " << part;
      last = now;
    }
  }
}

/// Four blocks of isotropic rocks whose speeds differ by up to two and a half, full of planes of two
/// families.
Lab<double>::Setup soft_blocks(unsigned draw, double softness) {
  std::mt19937 engine(draw);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&] { return uniform(engine); };
  constexpr int block = 6, cells = 2 * block;
  Lab<double>::Setup setup;
  setup.medium = rock(cells, cells);
  std::array<Material, 4> rocks{};
  for (auto& of : rocks) {
    of.vp = 2000 + 3000 * random();
    of.vs = of.vp * (0.4 + 0.3 * random());
    of.rho = 1800 + 1000 * random();
  }
  for (int cell = 0; cell < cells * cells; ++cell)
    put(setup.medium, std::size_t(cell), rocks[std::size_t(cell / cells / block * 2 + cell % cells / block)]);
  setup.edges = all_edges(EdgeLaw::rigid);
  FractureSet<2> set{"springs", {}};
  for (int family = 0; family < 2; ++family) {
    set.systems.push_back(system_of(360 * random(), {0, 0}));
    set.systems.back().law = FrictionLaw::none;
    set.systems.back().compliance = {softness / usual_mu, softness / usual_mu, 0, 0, 1};
  }
  setup.fracture_sets = {set};
  setup.fracture = Field<2, std::uint8_t>(setup.medium.grid(), 1);
  return setup;
}

/// Springs swing slowly: in the long run motion falls.
// Proves (S25).
TEST(SoftBlocks, LoseMotionAtAllOrders) {
  const ThreadLimit one_thread(1);
  for (unsigned draw = 1; draw <= (long_form() ? 16U : 2U); ++draw)
    for (const double softness : {100., 1e4})
      for (const int order : long_form() ? std::vector<int>{5, 7, 9, 11} : std::vector<int>{11}) {
        auto setup = soft_blocks(draw, softness);
        setup.order = order;
        SCOPED_TRACE("draw " + std::to_string(draw) + ", softness " + std::to_string(softness) + ", order " +
                     std::to_string(order));
        Lab<double> lab(setup);
        // Longer than springs swing.
        const int quarter = 5000;
        std::array<double, 4> means{};
        for (double& mean : means)
          for (int n = 0; n < quarter; ++n) lab.step(), mean += lab.kinetic_energy() / quarter;
        EXPECT_LT(means[1], means[0]);
        EXPECT_LT(means[3], means[1]);
      }
}

}  // namespace
}  // namespace slipwave::askew_springs_test
