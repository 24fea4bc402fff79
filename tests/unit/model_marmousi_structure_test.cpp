// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "geology/marmousi_strata.hpp"

namespace slipwave::model_marmousi_structure_test {

using namespace slipwave::marmousi;

namespace {

/// Depth in the pile just left and just right of a growth fault of a province, at a depth below the sea
/// floor.
struct Jump {
  double footwall_m = 0, hanging_wall_m = 0;
  double throw_m() const { return footwall_m - hanging_wall_m; }
};

Jump jump_across(const Province& province, const GrowthFault& fault, double depth_m) {
  constexpr double lift_m = 300;  // any
  const double at = fault.position(depth_m);
  int block = 0;
  return {province.pile_of_clastics(at - 1e-6, depth_m, lift_m, block),
          province.pile_of_clastics(at + 1e-6, depth_m, lift_m, block)};
}

}  // namespace

TEST(GrowthFaults, ThrowOldBedsFurtherThanYoungOnes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto province = province_of(seed, 0);
    ASSERT_GE(province.faults.size(), 3u);
    for (const auto& fault : province.faults) {
      // The small faults cross here and there, but move both walls alike.
      const double shallow = jump_across(province, fault, 200).throw_m();
      const double middle = jump_across(province, fault, 800).throw_m();
      const double deep = jump_across(province, fault, 1500).throw_m();
      EXPECT_GT(shallow, 0);
      EXPECT_GT(middle, shallow + 50);
      EXPECT_GT(deep, middle + 50);
      EXPECT_NEAR(deep, fault.throw_m, 1e-3);
    }
  }
}

TEST(GrowthFaults, FlattenWithDepthAndNeverCross) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto province = province_of(seed, 0);
    for (double depth = 0; depth < 1800; depth += 50) {
      for (std::size_t i = 0; i < province.faults.size(); ++i) {
        const auto& fault = province.faults[i];
        EXPECT_GT(fault.position(depth + 50) - fault.position(depth), 50 * fault.cotangent);
        if (i > 0) {
          EXPECT_GT(fault.position(depth), province.faults[i - 1].position(depth) + 50);
        }
      }
    }
  }
}

TEST(Section, NeverTurnsThePileUpsideDown) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (double x = -10000; x < 30000; x += 311) {
      const Section section(seed, x);
      Place above = section.at(0);
      for (double depth = 5; depth < 4000; depth += 5) {
        const Place here = section.at(depth);
        // Within a unit and a block. Where a small fault is crossed its bed may be met twice.
        if (here.unit == above.unit && here.block == above.block) {
          EXPECT_GT(here.pile_m, above.pile_m - 60) << seed << ' ' << x << ' ' << depth;
        } else {
          EXPECT_GE(int(here.unit), int(above.unit)) << seed << ' ' << x << ' ' << depth;
        }
        above = here;
      }
    }
  }
}

TEST(Section, ContinuesFromProvinceToProvince) {
  // Across x midway between two centres, where the number of the province changes.
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (std::int64_t number = -3; number < 3; ++number) {
      double left = province_of(seed, number).centre_m, right = province_of(seed, number + 1).centre_m;
      while (right - left > 1e-3) {
        const double middle = (left + right) / 2;
        (province_at(seed, middle) == number ? left : right) = middle;
      }
      const Section before(seed, left), behind(seed, right);
      for (double depth = 0; depth < 4000; depth += 100) {
        const auto a = before.at(depth), b = behind.at(depth);
        EXPECT_EQ(a.unit, b.unit) << seed << ' ' << number << ' ' << depth;
        EXPECT_NEAR(a.pile_m, b.pile_m, 0.1) << seed << ' ' << number << ' ' << depth;
      }
    }
  }
}

TEST(Unconformity, LiesAtAnAngleOnTheFoldedSeries) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto province = province_of(seed, 0);
    // 3 km left of the crest, below everything else.
    const double x = province.x_of(-3000), apart = 50;
    const double slope =
        (Section(seed, x + apart).at(3000).pile_m - Section(seed, x - apart).at(3000).pile_m) / (2 * apart);
    EXPECT_EQ(Section(seed, x).at(3000).unit, Unit::folded);
    EXPECT_GT(std::abs(slope), std::tan(20 * std::acos(-1.) / 180)) << seed;
  }
}

TEST(Traps, HoldGasOverOilOverBrineWithFlatContacts) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto province = province_of(seed, 0);
    std::map<Filling, int> points;
    double deepest_gas = 0, shallowest_oil = 1e9, deepest_oil = 0, shallowest_brine = 1e9;
    // The trap below the last fault; its bed in its block.
    const auto& trap = province.traps.front();
    for (double offset = trap.middle_m - 1500; offset < trap.middle_m + 600; offset += 5) {
      const Section section(seed, province.x_of(offset));
      for (double depth = 0; depth < 1700; depth += 2) {
        const auto place = section.at(depth);
        const double away = (offset - trap.middle_m) / trap.half_width_m;
        const bool in_bed = place.unit == Unit::clastics && place.block == trap.block &&
                            place.pile_m > trap.pile_m + 1 &&
                            place.pile_m < trap.pile_m + trap.thickness_m * (1 - away * away) - 1;
        if (!in_bed) continue;
        const auto bed = bed_at(seed, section, place);
        EXPECT_EQ(bed.lithology, Lithology::sand);
        ++points[bed.filling];
        if (bed.filling == Filling::gas) deepest_gas = std::max(deepest_gas, depth);
        if (bed.filling == Filling::oil) shallowest_oil = std::min(shallowest_oil, depth);
        if (bed.filling == Filling::oil) deepest_oil = std::max(deepest_oil, depth);
        if (bed.filling == Filling::brine) shallowest_brine = std::min(shallowest_brine, depth);
      }
    }
    EXPECT_GT(points[Filling::gas], 20) << seed;
    EXPECT_GT(points[Filling::oil], 20) << seed;
    EXPECT_LE(deepest_gas, shallowest_oil) << seed;
    EXPECT_LE(deepest_oil, shallowest_brine) << seed;
    EXPECT_NEAR(deepest_gas, trap.gas_above_m, 4) << seed;
    EXPECT_NEAR(deepest_oil, trap.oil_above_m, 4) << seed;
  }
}

TEST(Beds, HaveSpeedsThatGrowDownwardsWithinThem) {
  // Straight down through one bed of the clastics: more burial, more speed.
  const std::uint64_t seed = 1;
  int grown = 0;
  for (double x = 0; x < 10000; x += 500) {
    const Section section(seed, x);
    for (double depth = 0; depth < 1600; depth += 3) {
      const auto upper = section.at(depth), lower = section.at(depth + 3);
      const auto a = bed_at(seed, section, upper), b = bed_at(seed, section, lower);
      if (a.body != b.body || upper.pile_m < 0 || lower.pile_m < upper.pile_m) continue;
      ++grown;
      EXPECT_GT(material_of(b, section, lower).vp, material_of(a, section, upper).vp) << x << ' ' << depth;
    }
  }
  EXPECT_GT(grown, 5000);
}

}  // namespace slipwave::model_marmousi_structure_test
