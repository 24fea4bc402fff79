// SPDX-License-Identifier: BSD-3-Clause
#include "gather/component.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/parse.hpp"

namespace slipwave::gather_component_test {
namespace {

TEST(Components, AreFoundByTheirNamesAndHaveTraceCodesOfTheirOwn) {
  std::set<int> codes;
  for (const auto& row : component_rows()) {
    EXPECT_EQ(component_named(row.name), row.component);
    EXPECT_EQ(&row_of(row.component), &row);
    EXPECT_TRUE(codes.insert(row.trace_code).second) << row.name;
    EXPECT_EQ(row.term_count > 0, row.component != Component::other && row.component != Component::das)
        << row.name;
  }
}

TEST(Components, OfTwoDimensionsHaveNoY) {
  EXPECT_EQ(joined(component_names(2), " or "),
            "vx, vz, p, sxx, szz, sxz, ux, uz, ax, az, exx, ezz, exz, div, curl or das");
  EXPECT_EQ(joined(component_names(2, 0, Listed::fields), " or "), "vx, vz, p, sxx, szz or sxz");
  EXPECT_EQ(joined(component_names(3, 2)), "vy, syy, sxy, syz, uy, ay, eyy, exy, eyz, curlx, curly, curlz");
  EXPECT_EQ(joined(component_names(3, 2, Listed::fields)), "vy, syy, sxy, syz");
  for (const auto& row : component_rows())
    for (const int dimension : {2, 3})
      EXPECT_TRUE(!row.is_field() || row.in(dimension) == !row.terms_in(dimension).empty()) << row.name;
}

TEST(Components, ThatAreMeansSayTheirFormula) {
  EXPECT_EQ(row_of(Component::p).description(2), "pressure, -(sxx + szz)/2");
  EXPECT_EQ(row_of(Component::p).description(3), "pressure, -(sxx + syy + szz)/3");
  EXPECT_EQ(row_of(Component::sxz).description(2), "shear stress");
  EXPECT_EQ(row_of(Component::exz).description(2), "shear strain rate, (dvx/dz + dvz/dx)/2");
  EXPECT_EQ(row_of(Component::div).description(3), "divergence of particle velocity");
}

TEST(Components, HaveUnitsAsNetcdfWantsThem) {
  EXPECT_EQ(cf_unit("m/s"), "m s-1");
  EXPECT_EQ(cf_unit("1/s"), "s-1");
  EXPECT_EQ(cf_unit("m/s2"), "m s-2");
  EXPECT_EQ(cf_unit("Pa"), "Pa");
}

}  // namespace
}  // namespace slipwave::gather_component_test
