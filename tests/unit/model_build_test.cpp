// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/parse.hpp"
#include "geology/layers.hpp"
#include "model/fracture.hpp"
#include "model/prestress.hpp"
#include "model/single_fracture.hpp"
#include "model_cases.hpp"
#include "rock/relations.hpp"

namespace slipwave::model_build_test {

TEST(Layers, CellCentresDecide) {
  // Tops at 0 and 12: of the centres 5, 15, 25 the last two lie in the second layer.
  const auto medium = layered_medium(grid_of(1, 3, 10), {{0, 1500, 0, 1000, 0}, {12, 3000, 1500, 2000, 0}});
  EXPECT_EQ(medium.vp[0], 1500);
  EXPECT_EQ(medium.vp[1], 3000);
  EXPECT_EQ(medium.vp[2], 3000);
}

TEST(Layers, ATopAtACentreBelongsToTheCell) {
  const auto medium = layered_medium(grid_of(1, 2, 10), {{0, 1500, 0, 1000, 0}, {15, 3000, 1500, 2000, 0}});
  EXPECT_EQ(medium.vp[1], 3000);
}

TEST(Layers, PositiveDipDeepensTowardsX) {
  const auto grid = grid_of(40, 60, 5);
  const auto medium = layered_medium(grid, {{0, 1500, 0, 1000, 0}, {100, 3000, 1500, 2000, 30}});
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const double x = grid.centre(0, at[0]), z = grid.centre(1, at[1]);
    EXPECT_EQ(medium.vp[std::size_t(cell)], z >= 100 + x / std::sqrt(3.0) ? 3000 : 1500) << x << ' ' << z;
  }
}

TEST(Layers, AboveTheFirstOneIsVoid) {
  const auto medium = layered_medium(grid_of(1, 3, 10), {{12, 3000, 1500, 2000, 0}});
  EXPECT_TRUE(medium.is_void(0));
  EXPECT_TRUE(medium.is_solid(1));
}

TEST(Layers, AreParsedStrictly) {
  const auto layer = parse_layer("10:3000:1500:2000:-5");
  EXPECT_EQ(layer.top.depth_m(), 10);
  EXPECT_DOUBLE_EQ(layer.top.at(100), 10 - 100 * std::tan(5 * std::acos(-1.0) / 180));
  EXPECT_EQ(layer.material, (Material{3000, 1500, 2000}));
  EXPECT_EQ(layer.gradient, Material{});
  EXPECT_EQ(sentence_of([] { parse_layer("1:2:3"); }),
            "found '1:2:3', expected DEPTH:VP:VS:RHO[:DIP] [NAME=VALUE...]");
}

TEST(GridOfSize, WantsWholeSteps) {
  const auto grid = grid_of_size<2>({2500, 3000}, 5);
  EXPECT_EQ(grid.shape, (Index<2>{500, 600}));
  EXPECT_EQ(grid_of_size<2>({1, 0.3}, 0.1).shape, (Index<2>{10, 3}));
  EXPECT_EQ(sentence_of([] {
              grid_of_size<2>({2500, 3000}, 7);
            }),
            "2500 m are 357.143 steps of 7 m, expected a whole number");
  EXPECT_NE(sentence_of([] {
              grid_of_size<3>({1e9, 1e9, 1e9}, 1e-3);
            }).find("cells do not fit into the memory of this machine, at most "),
            std::string::npos);
}

TEST(FractureNormal, IsPerpendicularToAPlaneDeepeningTowardsX) {
  for (const double dip : {-90.0, -30.0, 0.0, 17.0, 45.0, 90.0}) {
    const auto normal = normal_of_dip(dip);
    const double radians = dip * std::acos(-1.0) / 180;
    EXPECT_NEAR(normal[0] * std::cos(radians) + normal[1] * std::sin(radians), 0, 1e-15) << dip;
    EXPECT_NEAR(std::hypot(normal[0], normal[1]), 1, 1e-15) << dip;
  }
  EXPECT_EQ(normal_of_dip(90), (Point<2>{1, 0}));
  EXPECT_EQ(normal_of_dip(0), (Point<2>{0, -1}));
}

TEST(FractureNormal, GivesItsDipBackWhicheverWayItPoints) {
  for (const double dip : {-89.0, -30.0, 0.0, 17.0, 90.0}) {
    const auto normal = normal_of_dip(dip);
    EXPECT_NEAR(dip_of_normal(normal), dip, 1e-12);
    if (dip < 90) {
      EXPECT_NEAR(dip_of_normal({-normal[0], -normal[1]}), dip, 1e-12);
    }
  }
}

TEST(FractureNormal, IsScaledToLengthOne) {
  EXPECT_EQ(unit_normal<2>({-3, 4}), (Point<2>{-0.6, 0.8}));
  EXPECT_EQ(unit_normal<2>({1e-200, 0}), (Point<2>{1, 0}));
  EXPECT_THROW(unit_normal<2>({0, 0}), Error);
}

TEST(Fractures, MarkSolidCellsAndLeaveFluidIntact) {
  auto model = water_over_rock(grid_of(10, 10, 10), 5);
  const Box<2> box{{0, 30}, {40, 70}};
  const auto count = add_fractures<2>(model, {"set", {{{0, 1}, 0.1, 1, 0}}},
                                      [&](const Point<2>& at) { return box.contains(at); });
  EXPECT_EQ(count.marked, 8);
  EXPECT_EQ(count.left, 8);
  EXPECT_EQ(model.fracture({0, 4}), 0);
  EXPECT_EQ(model.fracture({0, 5}), 1);
  EXPECT_EQ(model.fracture({4, 5}), 0);
  EXPECT_NO_THROW(check(model));
}

TEST(Fractures, OfALaterSetWin) {
  auto model = water_over_rock(grid_of(4, 4, 10), 0);
  const FractureSet<2> set{"set", {{{0, 1}, 0.1, 1, 0}}};
  add_fractures<2>(model, set, [](const Point<2>&) { return true; });
  const auto count = add_fractures<2>(model, set, [](const Point<2>& at) { return at[0] < 20; });
  EXPECT_EQ(count.taken, 8);
  EXPECT_EQ(model.fracture({1, 0}), 2);
  EXPECT_EQ(model.fracture({2, 0}), 1);
  EXPECT_EQ(model.fracture_sets.size(), 2u);
}

TEST(Fractures, OfARegionThatCutsCellsHaveAShareOfThem) {
  auto model = water_over_rock(grid_of(10, 10, 10), 0);
  const FractureSet<2> set{"set", {{{0, 1}, 0.1, 1, 0}}};
  const auto count = add_fractures<2>(model, set, region_of_box<2>({{20, 33}, {60, 75}}));
  EXPECT_EQ(count.marked, 4 * 5);
  EXPECT_EQ(count.cut, 4 * 2);
  EXPECT_FLOAT_EQ(model.fracture_share({2, 3}), 0.7F);
  EXPECT_EQ(model.fracture_share({2, 4}), 1);
  EXPECT_FLOAT_EQ(model.fracture_share({5, 7}), 0.5F);
  EXPECT_EQ(model.fracture({6, 4}), 0);
  EXPECT_EQ(model.fracture_share({6, 4}), 1);
  EXPECT_NO_THROW(check(model));
  model.fracture_share({2, 4}) = 0;
  EXPECT_THROW(check(model), Error);
}

TEST(Fractures, OfARegionWithItsEdgesOnFacesHaveWholeCells) {
  auto model = water_over_rock(grid_of(10, 10, 0.1), 0);
  add_fractures<2>(model, {"set", {{{0, 1}, 0.1, 1, 0}}}, region_of_box<2>({{0.3, 0.1}, {0.7, 0.9}}));
  EXPECT_TRUE(model.fracture_share.empty());
  EXPECT_EQ(std::count(model.fracture.begin(), model.fracture.end(), 1), 32);
}

TEST(Fractures, OfTwoSetsInACellSlipInTheSharesOfBoth) {
  auto model = water_over_rock(grid_of(10, 10, 10), 0);
  const FractureSet<2> set{"set", {{{0, 1}, 0.1, 1, 0}}};
  add_fractures<2>(model, set, region_of_box<2>({{0, 0}, {100, 34}}));
  const auto below = add_fractures<2>(model, set, region_of_box<2>({{0, 34}, {100, 78}}));
  EXPECT_EQ(below.taken, 10);  // 0.6 of them, 0.4 before
  EXPECT_EQ(model.fracture({3, 3}), 2);
  EXPECT_FLOAT_EQ(model.fracture_share({3, 3}), 1);
  EXPECT_THROW(add_fractures<2>(model, set, region_of_box<2>({{0, 78}, {100, 80}})), Error);
}

TEST(Fractures, RefuseARegionWithoutRockAndChangeNothing) {
  auto model = water_over_rock(grid_of(4, 4, 10), 4);
  EXPECT_THROW(add_fractures<2>(model, {"set", {{{0, 1}, 0.1, 1, 0}}}, [](const Point<2>&) { return true; }),
               Error);
  EXPECT_TRUE(model.fracture_sets.empty());
}

TEST(FrictionLaws, AreParsedStrictly) {
  SlipSystem<2> system{{0, 1}, 0.6, 0, 0};
  set_friction_law(system, "slip-weakening:0.2:1e-3");
  EXPECT_EQ(system.law, FrictionLaw::slip_weakening);
  EXPECT_EQ(system.dynamic_friction, 0.2);
  EXPECT_EQ(system.slip_distance_m, 1e-3);
  set_friction_law(system, "coulomb");
  EXPECT_EQ(system.law, FrictionLaw::coulomb);
  for (const char* text : {"", "Coulomb", "coulomb:1", "slip-weakening", "slip-weakening:0.2",
                           "slip-weakening:0.2:", "slip-weakening:0.2:1:1", "slip-weakening:0.7:1",
                           "slip-weakening:-1:1", "slip-weakening:0.2:0", "slip-weakening:0.2:nan"})
    EXPECT_THROW(set_friction_law(system, text), Error) << text;
}

TEST(FrictionLaws, HaveACriticalLengthWhereStaticStressPressesMost) {
  auto model = water_over_rock(grid_of(4, 4, 10), 0);
  FractureSet<2> set{"set", {{{0, 1}, 0.6, 0, 0}}};
  set_friction_law(set.systems[0], "slip-weakening:0.2:1e-3");
  add_fractures<2>(model, set, [](const Point<2>&) { return true; });
  EXPECT_TRUE(std::isinf(critical_length(model, 1).length_m));
  model.prestress_pa.assign(3, Field<2>(model.grid(), -1e6F));
  model.prestress_pa[1][6] = -2e6F;
  const double vs = double(model.medium.vs[6]), mu = double(model.medium.rho[6]) * vs * vs;
  const auto [length_m, cell] = critical_length(model, 1);
  EXPECT_EQ(cell, 6);
  EXPECT_NEAR(length_m, mu * 1e-3 / (0.4 * 2e6), 1e-9 * length_m);
}

TEST(FrictionLaws, HaveACriticalLengthInTheSofterRockBesideAFaceToo) {
  Model<2> model;
  model.medium = layered_medium(grid_of(8, 8, 10), {{0, 3000, 1500, 2000, 0}, {40, 2000, 1000, 1800, 0}});
  FractureSet<2> set{"set", {{{0, 1}, 0.6, 0, 0}}, {{{20, 40}, {70, 40}}}, true};
  set_friction_law(set.systems[0], "slip-weakening:0.2:1e-3");
  add_single_fractures(model, set);
  set_prestress(model, 1, parse_prestress<2>("1e6"));
  const auto [length_m, cell] = critical_length(model, 1);
  EXPECT_EQ(model.grid().index(cell)[1], 4);
  EXPECT_NEAR(length_m, 1800. * 1000 * 1000 * 1e-3 / (0.4 * 1e6), 1e-9 * length_m);
}

TEST(Fractures, FitTheCodeOfOneByte) {
  auto model = water_over_rock(grid_of(2, 2, 10), 0);
  const FractureSet<2> set{"set", {{{0, 1}, 0.1, 1, 0}}};
  const auto everywhere = [](const Point<2>&) { return true; };
  for (int i = 0; i < 255; ++i) add_fractures<2>(model, set, everywhere);
  EXPECT_EQ(model.fracture[0], 255);
  EXPECT_THROW(add_fractures<2>(model, set, everywhere), Error);
}

TEST(Relations, FollowTheirFormulas) {
  Field<2> vp(grid_of(4, 1, 10));
  vp[0] = 1500, vp[1] = 2520, vp[2] = 10000, vp[3] = 0;
  const auto vs = vs_by_castagna(vp);
  EXPECT_EQ(vs[0], 0);
  EXPECT_FLOAT_EQ(vs[1], 1000);  // 2520 = 1.16 1000 + 1360
  EXPECT_EQ(vs[3], 0);
  const auto rho = rho_by_gardner(vp, vs);
  EXPECT_EQ(rho[0], 1000);
  EXPECT_FLOAT_EQ(rho[2], 3100);  // 310 10000^(1/4)
  EXPECT_EQ(rho[3], 0);
  EXPECT_EQ(vs_by_castagna(vp, 3000)[1], 0);
}

}  // namespace slipwave::model_build_test
