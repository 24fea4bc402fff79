// SPDX-License-Identifier: BSD-3-Clause
#include "model/prestress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "build/resample.hpp"
#include "model/fracture.hpp"
#include "model_cases.hpp"

namespace slipwave::model_prestress_test {
namespace {

/// Water above rock, one set of planes in all of the rock.
Model<2> fractured(const SlipSystem<2>& system) {
  auto model = water_over_rock(grid_of(4, 10, 20), 3);
  add_fractures<2>(model, {"planes", {system}}, [](const Point<2>&) { return true; });
  return model;
}

/// Of one tensor in all fractured cells.
std::string refusal(const SlipSystem<2>& system, const std::string& prestress) {
  auto model = fractured(system);
  set_prestress(model, 1, parse_prestress<2>(prestress));
  return sentence_of([&] { check(model); });
}

const double half = std::sqrt(0.5);

}  // namespace

// Proves (S15).
TEST(Prestress, OfTheWeightAboveGrowsWithDepthAsTheDensitiesSay) {
  auto model = fractured({{half, -half}, 1, 0, 0});
  set_prestress(model, 1, parse_prestress<2>("lithostatic:0.7"));
  // 60 m of water, and rock down to the centre of the cell: 10 m, 30 m, ...
  for (const std::int64_t row : {3, 4, 9}) {
    const double expected = -9.80665 * (60 * 1000 + (20 * double(row - 3) + 10) * 2200);
    EXPECT_NEAR(model.prestress_pa[1]({2, row}), expected, 1e-6 * std::abs(expected)) << row;
    EXPECT_NEAR(model.prestress_pa[0]({2, row}), 0.7 * expected, 1e-6 * std::abs(expected)) << row;
    EXPECT_EQ(model.prestress_pa[2]({2, row}), 0);
  }
  EXPECT_EQ(model.prestress_pa[1]({2, 2}), 0) << "only the cells of the set have any";
}

TEST(Prestress, OfRockThatNeverGaveWaySidewaysIsThatOfUniaxialStrain) {
  auto model = fractured({{half, -half}, 1, 0, 0});
  set_prestress(model, 1, parse_prestress<2>("lithostatic"));
  // lambda/(lambda + 2 mu) of vp = 2 vs.
  EXPECT_NEAR(model.prestress_pa[0]({1, 8}) / model.prestress_pa[1]({1, 8}), 0.5, 1e-6);
}

TEST(Prestress, OfAirAboveWeighsNothing) {
  auto model = fractured({{half, -half}, 1, 0, 0});
  for (std::size_t cell = 0; cell < 12; ++cell)
    model.medium.vp[cell] = model.medium.vs[cell] = model.medium.rho[cell] = 0;
  set_prestress(model, 1, parse_prestress<2>("lithostatic"));
  EXPECT_NEAR(model.prestress_pa[1]({0, 3}), -9.80665 * 10 * 2200, 1);
}

TEST(Prestress, ReadsPressuresAndTensorsAndNone) {
  auto model = fractured({{half, -half}, 1, 0, 1e9});
  set_prestress(model, 1, parse_prestress<2>("none"));
  EXPECT_TRUE(model.prestress_pa.empty()) << "what nobody asked for takes no memory";
  set_prestress(model, 1, parse_prestress<2>("2e6"));
  EXPECT_EQ(model.prestress_pa[0]({0, 5}), -2e6f);
  EXPECT_EQ(model.prestress_pa[1]({0, 5}), -2e6f);
  EXPECT_EQ(model.prestress_pa[2]({0, 5}), 0);
  set_prestress(model, 1, parse_prestress<2>("-1,-2,3e3"));
  EXPECT_EQ(model.prestress_pa[0]({3, 5}), -1);
  EXPECT_EQ(model.prestress_pa[1]({3, 5}), -2);
  EXPECT_EQ(model.prestress_pa[2]({3, 5}), 3e3f);
  set_prestress(model, 1, parse_prestress<2>("none"));
  EXPECT_EQ(model.prestress_pa[1]({3, 5}), 0);
}

TEST(Prestress, ReadsSixComponentsInSpace) {
  const auto stress = std::get<SymmetricTensor<3, double>>(parse_prestress<3>("1,2,3,4,5,6"));
  EXPECT_EQ(stress(0, 1), 4);
  EXPECT_EQ(stress(0, 2), 5);
  EXPECT_EQ(stress(1, 2), 6);
  EXPECT_EQ(stress_names<3>(), (std::vector<std::string>{"sxx", "syy", "szz", "sxy", "sxz", "syz"}));
}

TEST(Prestress, RefusesWhatItDoesNotKnow) {
  const auto said = [](const char* text) { return sentence_of([&] { parse_prestress<2>(text); }); };
  for (const std::string text : {"heavy", "1,2", "1,2,", "1,2,3,4", "lithostatics"})
    EXPECT_EQ(
        said(text.c_str()),
        "found '" + text + "', expected none, lithostatic, lithostatic:K0, a pressure or sxx,szz,sxz in Pa");
  EXPECT_EQ(said("lithostatic:-1"), "found K0 of -1, expected it not below zero");
}

// Proves (S15).
TEST(Prestress, ThatSlipsByItselfIsRefused) {
  // Planes at 45 degrees under szz = -p, sxx = -p/2: s_n = -3/4 p, |tau| = p/4, which friction of 1/3 just
  // holds.
  const std::string stress = "-5e5,-1e6,0";
  EXPECT_EQ(refusal({{half, -half}, 1.0 / 3, 0, 0}, stress), "no error");
  EXPECT_EQ(refusal({{half, -half}, 0.3, 0, 0}, stress),
            "the prestress at x=10 z=70 shears the planes of fracture set 1 'planes' by 250000 Pa, "
            "expected at "
            "most their strength of 225000 Pa");
  EXPECT_EQ(refusal({{half, -half}, 0.3, 0, 2.5e4}, stress), "no error");
  EXPECT_EQ(refusal({{0, 1}, 0, 0, 0}, stress), "no error") << "no shear on horizontal planes";
}

TEST(Prestress, ThatPullsPlanesApartIsRefusedWhereTheyOpen) {
  EXPECT_EQ(
      refusal({{0, 1}, 0.5, 0, 0, true}, "-3"),
      "the prestress at x=10 z=70 pulls the planes of fracture set 1 'planes' apart by 3 Pa; planes that may "
      "open must be under compression");
  EXPECT_EQ(refusal({{0, 1}, 0.5, 0, 0, false}, "-3"), "no error");
  EXPECT_EQ(refusal({{0, 1}, 0.5, 0, 0, true}, "3"), "no error");
}

TEST(Prestress, ThatIsNoNumberIsRefused) {
  auto model = fractured({{0, 1}, 0.5, 0, 0});
  set_prestress(model, 1, parse_prestress<2>("3"));
  model.prestress_pa[2]({1, 4}) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(sentence_of([&] { check(model); }),
            "the prestress at x=30 z=90 on the planes of fracture set 1 'planes' is not finite, expected "
            "numbers");
}

TEST(Prestress, GoesWithItsCellsToOtherGrids) {
  auto model = fractured({{half, -half}, 1, 0, 0});
  set_prestress(model, 1, parse_prestress<2>("lithostatic"));
  const auto fine = resampled(model, 10.0);
  EXPECT_EQ(fine.prestress_pa[1]({5, 13}), model.prestress_pa[1]({2, 6}));
  const auto coarse = regridded(model, 40.0);
  const auto& of_parts = model.prestress_pa[1];
  EXPECT_NEAR(coarse.prestress_pa[1]({1, 4}), (of_parts({3, 8}) + of_parts({3, 9})) / 2, 1);
  const auto part = cropped(model, Box<2>{{20, 100}, {80, 200}});
  EXPECT_EQ(part.prestress_pa[1]({0, 0}), model.prestress_pa[1]({1, 5}));
}

TEST(ModelEffect, OfStaticStressAndOpeningCanBeTakenOut) {
  auto model = fractured({{half, -half}, 1, 0, 0, true});
  set_prestress(model, 1, parse_prestress<2>("lithostatic"));
  remove_effect(model, model_effect_named("opening"));
  EXPECT_FALSE(model.fracture_sets[0].systems[0].opens);
  remove_effect(model, model_effect_named("prestress"));
  EXPECT_TRUE(model.prestress_pa.empty());
}

TEST(ModelEffect, OfPlanesThatNoWaveMovesIsLeftOut) {
  const auto left_of = [](const SlipSystem<2>& system, double resolution = 1e-7) {
    auto model = fractured(system);
    const auto sets = leave_out_inert(model, resolution);
    const bool any =
        std::any_of(model.fracture.begin(), model.fracture.end(), [](auto code) { return code != 0; });
    EXPECT_EQ(sets, any ? std::vector<std::string>{} : std::vector<std::string>{"planes"});
    return any;
  };
  SlipSystem<2> springs{{half, -half}};
  springs.law = FrictionLaw::none;
  springs.compliance = {.tangential_m_per_pa = 1e-30, .spacing_m = 1};
  EXPECT_FALSE(left_of(springs));
  springs.compliance.tangential_m_per_pa = 1e-17;  // strains by 1e-8 to 1e-7 of what rock does
  EXPECT_FALSE(left_of(springs));
  EXPECT_TRUE(left_of(springs, 1e-16));
  springs.compliance.tangential_m_per_pa = 1e-12;
  EXPECT_TRUE(left_of(springs));
  EXPECT_FALSE(left_of({{half, -half}, 0.1, 0, 1e12}));
  EXPECT_TRUE(left_of({{half, -half}, 0.1, 0, 1e12, true})) << "planes that part";
  EXPECT_TRUE(left_of({{half, -half}, 0.1, 0, 1e6}));
}

}  // namespace slipwave::model_prestress_test
