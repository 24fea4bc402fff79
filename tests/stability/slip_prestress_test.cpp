// SPDX-License-Identifier: BSD-3-Clause
// Slip in rock under prestress. Slip by a strain e takes the energy s:e out of the stress s of the waves
// (the mean of before and after), and what becomes heat is (s0 + s):e >= 0, s0 being the prestress: it
// has done the work s0:e. So the energy of the waves may rise. What never rises is
//
//   the energy of the waves less the sum over cells of s0:e,
//
// whatever s0 is, up to a constant the potential energy of all stress under loads that stay. Between walls
// that do not move the strains of a uniform s0 sum up to nothing, and that is the same as
//
//   kinetic energy and elastic energy of s0 + s,
//
// where no book of slip has to be kept.
#include <cmath>
#include <tuple>

#include "slip_cases.hpp"

namespace slipwave::slip_prestress_test {
namespace {

constexpr int cells() { return 16; }
int steps() { return long_form() ? 600 : 100; }

/// Expects that measure(lab) never rises by more than rounding of all energies that are about.
template <class Real, class Measure>
void expect_fall(Lab<Real>& lab, const Measure& measure, double pressure_pa) {
  // Static stress is rounded with that of the waves.
  const double size = std::max(lab.energy_with_prestress(), lab.energy());
  double lowest = measure(lab);
  ASSERT_TRUE(std::isfinite(lowest));
  for (int n = 1; n <= steps(); ++n) {
    lab.step();
    const double now = measure(lab);
    ASSERT_TRUE(now <= lowest + rounding<Real>() * size)
        << "step " << n << ": " << now << ", it was down to " << lowest << ", all energies are " << size
        << ", the static pressure " << pressure_pa;
    lowest = std::min(lowest, now);
  }
}

using Case = std::tuple<Planes, SlipCorrection>;

class SlipUnderStress : public ::testing::TestWithParam<Case> {
 protected:
  const Planes& planes() const { return std::get<0>(GetParam()); }
  SlipCorrection correction() const { return std::get<1>(GetParam()); }
  const ThreadLimit one_thread_{1};
  Rotation rotation_;
};

const std::vector<Law>& some_laws() {
  static const std::vector<Law> all = {{0, 0},    {0, 1e3}, {0.1, 0},   {0.1, 1e-300}, {0.1, 1e3},
                                       {0.7, 10}, {100, 0}, {100, 1e3}, {100, 1e300}};
  return all;
}

/// Cluster, law and amplitude of the waves against a prestress of 10 MPa, for every case.
template <class Real, class Run>
void each(Rotation& rotation, const Planes& planes, const Run& run) {
  std::size_t turn = 0;
  for (const auto& law : some_laws())
    for (const char* cluster : {"one cell", "one row", "everywhere, so every edge"})
      for (const double amplitude : {1., 1e-6}) {
        rotation.next();
        // In the short form every other case, in float the others.
        const std::size_t now = turn++;
        if (!long_form() && (now / 2 + now + sizeof(Real) / 4) % 2 != 0) continue;
        const double strength_pa = law.friction == 0 ? 1e6 : 0;
        SCOPED_TRACE(std::string(cluster) + ", friction " + std::to_string(law.friction) + ", viscosity " +
                     std::to_string(law.viscosity_s) + ", amplitude " + std::to_string(amplitude) + ", " +
                     rotation.shown());
        run(cluster_named(cluster), set_of(planes, law, strength_pa), amplitude);
      }
}

}  // namespace

TEST_P(SlipUnderStress, AtTheVergeNeverAddsEnergyToAllStressBetweenWalls) {
  for (const bool in_double : {true, false}) {
    const auto run = [&](auto real) {
      using Real = decltype(real);
      each<Real>(rotation_, planes(),
                 [&](const Cluster& cluster, const FractureSet<2>& set, double amplitude) {
                   const char* const solid[] = {"SolidBlocksOf3Cells", "RandomSolids", "Checkerboard1To20"};
                   const auto medium = medium_named(solid[rotation_.order() % 3], cells());
                   auto setup = fractured<Real>(medium, cluster, set);
                   rotation_.into(setup);
                   setup.edges = all_edges(EdgeLaw::rigid);
                   setup.correction = correction();
                   setup.amplitude = amplitude;
                   setup.prestress_pa = uniform_stress(medium.grid(), at_the_verge({set}, 1e7));
                   Lab<Real> lab(setup);
                   expect_fall(
                       lab, [](const Lab<Real>& of) { return of.energy_with_prestress(); }, 1e7);
                 });
    };
    in_double ? run(double()) : run(float());
  }
}

TEST_P(SlipUnderStress, OfAnyKindNeverAddsEnergyButForTheWorkOfThatStress) {
  // Static stress that differs from cell to cell and is in no balance, above what planes bear in many cells,
  // in water, under free surfaces.
  const auto run = [&](auto real) {
    using Real = decltype(real);
    each<Real>(rotation_, planes(), [&](const Cluster& cluster, const FractureSet<2>& set, double amplitude) {
      const auto medium = medium_named(cluster.medium, cells());
      auto setup = fractured<Real>(medium, cluster, set);
      rotation_.into(setup);
      setup.correction = correction();
      setup.amplitude = amplitude;
      setup.prestress_pa = uniform_stress(medium.grid(), at_the_verge({set}, 1e7));
      for (std::size_t cell = 0; cell < medium.vs.size(); ++cell)
        for (std::size_t c = 0; c < 3; ++c)
          setup.prestress_pa[c][cell] *= float(1 + 0.5 * std::sin(double(7 * cell + 3 * c)));
      Lab<Real> lab(setup);
      expect_fall(
          lab, [](const Lab<Real>& of) { return of.potential(); }, 1e7);
    });
  };
  run(double());
}

INSTANTIATE_TEST_SUITE_P(PlanesAndCorrections, SlipUnderStress,
                         ::testing::ValuesIn(share_of_pairs(kinds_of_planes(), corrections())),
                         [](const auto& info) { return std::apply(name_of_case, info.param); });

TEST(StaticStress, DoesWorkOnSlipThatTheWavesKeep) {
  // Rock at the verge of slip whose planes are relieved of a little of their pressure: they slip, and the
  // waves have more energy than before. Both sums that never rise are the same here.
  const ThreadLimit one_thread(1);
  for (const auto correction : corrections()) {
    const FractureSet<2> set{"flat", {system_of(0, {0.7, 0})}};
    auto setup = fractured<double>(rock(20, 20), cluster_named("everywhere, so every edge"), set);
    setup.correction = correction;
    setup.edges = all_edges(EdgeLaw::rigid);
    setup.fields = [](int, int) { return CellFields{0, 0, 0, 1e5, 0}; };
    setup.prestress_pa = uniform_stress(setup.medium.grid(), {-1e7, -1e7, 7e6 * (1 - 1e-7)});
    Lab<double> lab(setup);
    const double before = lab.energy(), all = lab.energy_with_prestress();
    for (int n = 0; n < 50; ++n) {
      lab.step();
      EXPECT_NEAR(lab.energy_with_prestress() - all, lab.potential() - before, 1e-11 * all) << n;
    }
    EXPECT_GT(lab.energy(), 1.5 * before);
    EXPECT_LT(lab.energy_with_prestress(), all);
  }
}

TEST(StaticStress, AtTheVergeLeavesRockAtRestAlone) {
  const ThreadLimit one_thread(1);
  for (const auto correction : corrections())
    for (const auto& planes : kinds_of_planes())
      for (const auto& law : some_laws()) {
        const auto set = set_of(planes, law, 1e6);
        auto setup = fractured<double>(rock(16, 16), cluster_named("everywhere, so every edge"), set);
        setup.correction = correction;
        setup.fields = [](int, int) { return CellFields{}; };
        // Values of a model are floats.
        setup.prestress_pa = uniform_stress(setup.medium.grid(), at_the_verge({set}, 1e7, 1 - 1e-5));
        Lab<double> lab(setup);
        for (int n = 0; n < 5; ++n) lab.step();
        EXPECT_EQ(lab.energy(), 0) << planes.name << ", friction " << law.friction;
      }
}

}  // namespace slipwave::slip_prestress_test
