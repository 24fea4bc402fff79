// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lab.hpp"
#include "solver/effect/slip.hpp"
#include "solver/simulation.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::solver_slip_diary_test {
namespace {

/// Steps of slip under random loads of up to load_pa: the energy that all cells lose by it.
double lost_by_slip(Lab<double>& lab, Slip<2, double>& slip, std::int64_t steps, double load_pa,
                    double dt_s) {
  using L = Lab<double>;
  std::mt19937 random(2);
  double lost = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    for (std::int64_t k = 0; k < lab.grid().shape[1]; ++k)
      for (std::int64_t i = 0; i < lab.grid().shape[0]; ++i)
        for (const auto row : {L::sxx, L::szz, L::sxz})
          lab(row, i, k) += std::uniform_real_distribution<>(-load_pa, load_pa)(random);
    const double before = lab.energy();
    run_everywhere(slip, {step, dt_s}, lab.state());
    run_after_everywhere(slip, {step, dt_s}, lab.state());
    lost += before - lab.energy();
  }
  return lost;
}

// Proves (S14).
TEST(SlipDiary, NotesTheEnergyThatSlipTakesOutOfTheCells) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(20, 20, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 3; k < 17; ++k)
    for (std::int64_t i = 2; i < 19; i += 1 + k % 2) scene.model.fracture({i, k}) = 1;
  scene.model.fracture_sets = {
      {"crossing", {{{0.6, 0.8}, 0.2, 2e3, 1e3}, {{std::sqrt(0.5), std::sqrt(0.5)}, 0.1, 2e3, 0}}}};
  scene.slip_diary = true;
  const double dt_s = 0.9 * 5 / 4500;
  const auto crossing_systems = scene.model.fracture_sets[0].systems;
  auto& medium = scene.model.medium;
  for (const auto& [crossing, tilted] :
       {std::pair{true, false}, {false, false}, {true, true}, {false, true}}) {
    scene.model.fracture_sets[0].systems = crossing_systems;
    if (!crossing) scene.model.fracture_sets[0].systems.pop_back();
    for (const auto& [property, value] :
         {std::pair{Property::epsilon, 0.1F}, {Property::delta, 0.05F}, {Property::tilt, 20.F}})
      medium[property] = tilted ? Field<2>(medium.grid(), value) : Field<2>();
    for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential,
                                  SlipCorrection::centred}) {
      scene.numerics.correction = correction;
      using L = Lab<double>;
      L lab(scene.model.medium, edges_all(EdgeLaw::rigid), 5, dt_s);
      Slip<2, double> slip(lab.state(), lab.domain(), scene, dt_s);
      const double lost = lost_by_slip(lab, slip, 5, 1e5, dt_s);
      const auto totals = slip.totals();
      EXPECT_GT(totals.dissipated, 0);
      EXPECT_NEAR(totals.dissipated, lost, 1e-9 * lost) << name_of(correction) << ' ' << tilted;
      EXPECT_EQ(totals.out_of_waves, totals.dissipated);
      EXPECT_GT(totals.slipped, totals.cells / 2);
      EXPECT_LE(totals.slipped, totals.cells);
      const auto field = slip.field(SlipField::slip);
      for (std::size_t cell = 0; cell < field.size(); ++cell)
        EXPECT_TRUE(field[cell] == 0 || scene.model.fracture[cell] != 0) << cell;
    }
  }
}

/// Parting planes give back what they took when they come together: all that is lost is what pulls them apart
/// by a step's stress, and knocks them together.
// Proves (S14).
TEST(SlipDiary, BalancesPlanesThatPartUnderStaticStress) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(16, 16, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 1);
  scene.model.fracture_sets = {
      {"blocks", {{{0.6, 0.8}, 0.2, 2e3, 1e3, true}, {{0.8, -0.6}, 0.2, 2e3, 1e3, true}}}};
  const float pressure = 2e4f;
  for (const float value : {-pressure, -pressure, 0.f})
    scene.model.prestress_pa.emplace_back(scene.model.grid(), value);
  scene.slip_diary = true;
  const double dt_s = 0.9 * 5 / 4500;
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential,
                                SlipCorrection::centred}) {
    scene.numerics.correction = correction;
    using L = Lab<double>;
    L lab(scene.model.medium, edges_all(EdgeLaw::rigid), 5, dt_s);
    Slip<2, double> slip(lab.state(), lab.domain(), scene, dt_s);
    const double lost = lost_by_slip(lab, slip, 8, 5e4, dt_s);
    const auto totals = slip.totals();
    EXPECT_NEAR(totals.out_of_waves, lost, 1e-9 * std::abs(lost)) << name_of(correction);
    EXPECT_NE(totals.out_of_waves, totals.dissipated);
    const auto heat = slip.field(SlipField::dissipated), opening = slip.field(SlipField::opening);
    double widest = 0;
    for (std::size_t cell = 0; cell < heat.size(); ++cell) {
      EXPECT_GE(heat[cell], 0) << cell;
      widest = std::max(widest, double(opening[cell]));
    }
    EXPECT_GT(widest, 0);
  }
}

// Proves (S18).
TEST(SlipDiary, BalancesPlanesThatWeakenUnderStaticStress) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(16, 16, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 1);
  const SlipSystem<2> first = {{0.6, 0.8}, 0.5, 2e3, 1e3, true, FrictionLaw::slip_weakening, 0.1, 1e-4};
  auto across = first, crossing = first;
  across.normal = {0.8, -0.6};
  crossing.normal = {std::sqrt(0.5), std::sqrt(0.5)};
  const float pressure = 2e5f;
  for (const float value : {-pressure, -pressure, 0.f})
    scene.model.prestress_pa.emplace_back(scene.model.grid(), value);
  scene.slip_diary = true;
  const double dt_s = 0.9 * 5 / 4500;
  for (const auto& systems : {std::vector{first}, std::vector{first, across}, std::vector{first, crossing}})
    for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential,
                                  SlipCorrection::centred}) {
      scene.model.fracture_sets = {{"weak", systems}};
      scene.numerics.correction = correction;
      Lab<double> lab(scene.model.medium, edges_all(EdgeLaw::rigid), 5, dt_s);
      Slip<2, double> slip(lab.state(), lab.domain(), scene, dt_s);
      const double lost = lost_by_slip(lab, slip, 8, 1e5, dt_s);
      const auto totals = slip.totals();
      EXPECT_NEAR(totals.out_of_waves, lost, 1e-9 * std::abs(lost)) << name_of(correction);
      const auto heat = slip.field(SlipField::dissipated), slipped = slip.field(SlipField::slip);
      double most = 0;
      for (std::size_t cell = 0; cell < heat.size(); ++cell) {
        EXPECT_GE(heat[cell], 0) << cell;
        most = std::max(most, 5 * double(slipped[cell]));
      }
      // Friction has fallen, in part of the cells not yet to the end.
      EXPECT_GT(most, 0.3e-4);
    }
}

TEST(SlipDiary, IsInSiUnitsWhateverUnitTheFieldsHave) {
  // Fields of single precision have a unit of their own, those of double precision have not.
  Scene<2> scene;
  scene.model.medium = uniform_medium(160, 60, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t x = 75; x < 85; ++x)
    for (std::int64_t z = 30; z < 40; ++z) scene.model.fracture({x, z}) = 1;
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.2, 1e-3, 2e3, true}}}};
  for (const float value : {-4e4f, -3e4f, 0.f})
    scene.model.prestress_pa.emplace_back(scene.model.grid(), value);
  scene.survey.sources = {{{402.5, 52.5}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e12}};
  scene.survey.receivers_m = {{402.5, 102.5}};
  scene.recording = {{Component::vz}, 0.12, 0.001};
  scene.slip_diary = true;
  scene.snapshot_every_s = 0.1;
  struct Seen {
    std::vector<Field<2>> fields;
    ShotReport report;
  } seen[2];
  for (const bool precise : {false, true}) {
    scene.numerics.double_precision = precise;
    auto& here = seen[precise];
    shoot<2>(
        scene, 1, {},
        [&](double, const FieldReader<2>& field) {
          for (const auto which :
               {SlipField::slip, SlipField::slip_rate, SlipField::dissipated, SlipField::opening})
            here.fields.push_back(field(which));
        },
        nullptr, &here.report);
  }
  ASSERT_EQ(seen[0].fields.size(), seen[1].fields.size());
  for (std::size_t n = 0; n < seen[0].fields.size(); ++n) {
    std::vector<double> found, expected;
    for (std::size_t cell = 0; cell < seen[0].fields[n].size(); ++cell) {
      found.push_back(seen[0].fields[n][cell]);
      expected.push_back(seen[1].fields[n][cell]);
    }
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0) << n;
    EXPECT_LT(relative_error(found, expected), 1e-3) << n;
  }
  const auto &found = seen[0].report, &expected = seen[1].report;
  EXPECT_NEAR(found.slip->dissipated, expected.slip->dissipated, 1e-4 * expected.slip->dissipated);
  EXPECT_NEAR(*found.source_work, *expected.source_work, 1e-4 * *expected.source_work);
  EXPECT_NEAR(found.energy_left, expected.energy_left, 1e-4 * expected.energy_left);
}

}  // namespace
}  // namespace slipwave::solver::solver_slip_diary_test
