// SPDX-License-Identifier: BSD-3-Clause
#include "shell.hpp"

namespace slipwave::model_averaging_test {
namespace {

using ModelAveraging = Shell;

// The top at 13 m leaves 30 % of the second row of cells to the upper rock.
const std::string layers =
    "sw-layers --size 40x20 --step 10 --layer 0:2500:1200:2000 --layer 13:4500:2250:2500 --fit none ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(ModelAveraging, OfLayersIsSwitchedOffByItsOption) {
  EXPECT_TRUE(has(done(layers + "| sw-info -"), "rho           2000 to 2350 kg/m3"));
  EXPECT_TRUE(has(done(layers + "--no-average | sw-info -"), "rho           2000 to 2500 kg/m3"));
}

TEST_F(ModelAveraging, OfLargerCellsIsSwitchedOffByItsOption) {
  const std::string import =
      layers + "-o fine.nc; sw-import --vp fine.nc:vp --vs fine.nc:vs --rho fine.nc:rho --resample 20 ";
  // 65 % of 2000 2500^2 Pa and 35 % of 2500 4500^2 Pa in series, over 2175 kg/m3; or halfway between the
  // speeds of both rows.
  EXPECT_TRUE(has(done(import + "| sw-info -"), "vp            2793.5")) << done(import + "| sw-info -");
  EXPECT_TRUE(has(done(import + "--no-average | sw-info -"), "vp            2927"));
}

}  // namespace slipwave::model_averaging_test
