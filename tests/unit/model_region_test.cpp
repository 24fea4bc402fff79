// SPDX-License-Identifier: BSD-3-Clause
#include "geology/region.hpp"

#include <cmath>

#include "model_cases.hpp"

namespace slipwave::model_region_test {
namespace {

/// Area of a region, by counting points `step_m` apart in twice its bounds; every point inside must lie
/// within them.
double counted_area(const Region& region, double step_m = 0.5) {
  const auto& low = region.bounds.low_m;
  const auto& high = region.bounds.high_m;
  const double more_x = (high[0] - low[0]) / 2, more_z = (high[1] - low[1]) / 2;
  double area = 0;
  for (double x = low[0] - more_x + step_m / 2; x < high[0] + more_x; x += step_m)
    for (double z = low[1] - more_z + step_m / 2; z < high[1] + more_z; z += step_m) {
      if (!region.contains({x, z})) continue;
      area += step_m * step_m;
      EXPECT_TRUE(region.bounds.contains({x, z})) << x << ' ' << z;
    }
  return area;
}

constexpr double pi = 3.141592653589793;
const Region square = region_of_box({{0, 0}, {1000, 1000}});

}  // namespace

TEST(Region, OfAPolygonFollowsTheEvenOddRule) {
  const auto notched = region_of_polygon({{0, 0}, {10, 0}, {10, 10}, {5, 5}, {0, 10}});
  EXPECT_TRUE(notched.contains({2, 5}));
  EXPECT_TRUE(notched.contains({8, 5}));
  EXPECT_FALSE(notched.contains({5, 8}));
  EXPECT_FALSE(notched.contains({-1, 5}));
  EXPECT_THROW(region_of_polygon({{0, 0}, {1, 1}}), Error);
}

TEST(Region, OfAnEllipseHasItsAreaAndItsDip) {
  const auto ellipse = parse_ellipse("300,200:80,20:30");
  EXPECT_NEAR(counted_area(ellipse), pi * 80 * 20, 15);
  // Its long axis deepens towards +x.
  const double x = 79 * std::cos(pi / 6), z = 79 * std::sin(pi / 6);
  EXPECT_TRUE(ellipse.contains({300 + x, 200 + z}));
  EXPECT_TRUE(ellipse.contains({300 - x, 200 - z}));
  EXPECT_FALSE(ellipse.contains({300 + x, 200 - z}));
}

TEST(Region, OfASlabHasItsAreaAndItsDip) {
  const auto slab = parse_slab("300,200:160,40:-20");
  EXPECT_NEAR(counted_area(slab), 160 * 40, 15);
  const double x = 79 * std::cos(pi / 9), z = 79 * std::sin(pi / 9);
  EXPECT_TRUE(slab.contains({300 + x, 200 - z}));
  EXPECT_FALSE(slab.contains({300 + x, 200 + z}));
}

/// Sum over the cells of a grid over bounds of the shares that lie in a region, times their volume.
template <int D>
double volume_by_shares(const RegionIn<D>& region, double step_m) {
  Grid<D> cells;
  cells.spacing_m = step_m;
  for (std::size_t axis = 0; axis < D; ++axis) {
    cells.origin_m[axis] = region.bounds.low_m[axis] - 0.3 * step_m;
    cells.shape[axis] = std::int64_t((region.bounds.high_m[axis] - cells.origin_m[axis]) / step_m) + 1;
  }
  double volume = 0;
  for (std::int64_t n = 0; n < cells.size(); ++n) {
    const auto at = cells.index(n);
    Box<D> cell;
    for (int axis = 0; axis < D; ++axis) {
      const auto a = std::size_t(axis);
      cell.low_m[a] = cells.centre(axis, at[a]) - step_m / 2, cell.high_m[a] = cell.low_m[a] + step_m;
    }
    volume += share_within(region, cell) * std::pow(step_m, D);
  }
  return volume;
}

TEST(SharesOfCells, AddUpToTheAreaOfARegion) {
  EXPECT_NEAR(volume_by_shares(region_of_box({{3.1, 7.7}, {61.4, 23.2}}), 5), 58.3 * 15.5, 1e-9);
  EXPECT_NEAR(volume_by_shares(parse_slab("300,200:160,40:-20"), 7), 160 * 40, 1e-8);
  EXPECT_NEAR(volume_by_shares(parse_slab("300,200:160,0.5:33"), 10), 80, 1e-8);  // thinner than a cell
  const auto notched = region_of_polygon({{0, 0}, {10, 0}, {10, 10}, {5, 5}, {0, 10}});
  EXPECT_NEAR(volume_by_shares(notched, 3), 75, 1e-10);
  EXPECT_NEAR(volume_by_shares(parse_ellipse("300,200:80,20:30"), 10) / (pi * 80 * 20), 1, 1e-3);
  // Edges that cross each other are sampled: two triangles by the even-odd rule.
  const auto hourglass = region_of_polygon({{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  EXPECT_NEAR(volume_by_shares(hourglass, 3), 50, 1);
}

TEST(SharesOfCells, AddUpToTheVolumeOfARegionInSpace) {
  const auto box = region_of_box<3>({{3.1, 7.7, 1.2}, {61.4, 23.2, 9.9}});
  EXPECT_NEAR(volume_by_shares(box, 5), 58.3 * 15.5 * 8.7, 1e-9);
  EXPECT_NEAR(volume_by_shares(parse_slab<3>("300,200,100:60,40,17:30:25"), 6) / (60 * 40 * 17), 1, 2e-3);
  EXPECT_NEAR(
      volume_by_shares(parse_ellipse<3>("300,200,100:40,20,15:30:25"), 6) / (4 * pi / 3 * 40 * 20 * 15), 1,
      2e-3);
}

TEST(SharesOfCells, OfASlabAreThoseOfItsPoints) {
  const auto slab = parse_slab("5,5:20,6:40");
  for (const double x : {-4., 1.5, 6.})
    for (const double z : {-1., 2., 6.5}) {
      const Box<2> cell{{x, z}, {x + 4, z + 4}};
      double inside = 0;
      constexpr int n = 200;
      for (int i = 0; i < n * n; ++i)
        inside += slab.contains({x + 4 * (i % n + 0.5) / n, z + 4 * (i / n + 0.5) / n});
      EXPECT_NEAR(share_within(slab, cell), inside / (n * n), 0.005) << x << ' ' << z;
    }
}

TEST(Scatter, IsTheSameForASeedAndAnotherForTheNext) {
  const auto a = scattered_in(square, {30, 7, 100, 10, 40}),
             again = scattered_in(square, {30, 7, 100, 10, 40}),
             other = scattered_in(square, {30, 8, 100, 10, 40});
  int differ = 0;
  for (double x = 2; x < 1000; x += 5)
    for (double z = 2; z < 1000; z += 5) {
      EXPECT_EQ(a.contains({x, z}), again.contains({x, z}));
      differ += a.contains({x, z}) != other.contains({x, z});
    }
  EXPECT_GT(differ, 500);
}

TEST(Scatter, OnlyAddsSlabsWhereTheCountGrows) {
  const auto few = scattered_in(square, {20, 7, 100, 10, 40}),
             many = scattered_in(square, {60, 7, 100, 10, 40});
  int more = 0;
  for (double x = 2; x < 1000; x += 5)
    for (double z = 2; z < 1000; z += 5) {
      EXPECT_LE(few.contains({x, z}), many.contains({x, z}));
      more += few.contains({x, z}) != many.contains({x, z});
    }
  EXPECT_GT(more, 300);
}

TEST(Scatter, CoversWhatIndependentSlabsCover) {
  // Of a large region n slabs of mean area a leave exp(-n a/A) free. Slabs of 10 m x 4 m in 1000 m x 1000 m,
  // so hardly any reaches the border; n a/A = 0.4. Points 2 m apart tell the share to a thousandth.
  const auto slabs = scattered_in(square, {10000, 3, 10, 4, 70});
  EXPECT_NEAR(counted_area(slabs, 2) / 1e6, 1 - std::exp(-0.4), 0.01);
}

TEST(Scatter, StaysInItsRegion) {
  const auto ellipse = parse_ellipse("500,500:300,100:45");
  const auto slabs = scattered_in(ellipse, {40, 1, 200, 20, 0});
  int inside = 0;
  for (double x = 2; x < 1000; x += 5)
    for (double z = 2; z < 1000; z += 5) {
      if (!slabs.contains({x, z})) continue;
      ++inside;
      EXPECT_TRUE(ellipse.contains({x, z}));
    }
  EXPECT_GT(inside, 500);
}

TEST(Scatter, GivesUpWhereARegionIsNextToNothing) {
  const Region empty{{{0, 0}, {10, 10}}, [](const Point<2>&) { return false; }};
  EXPECT_EQ(sentence_of([&] {
              scattered_in(empty, {1, 1, 10, 1, 0});
            }),
            "found no place for a slab in the region, expected it to fill more of its bounds");
}

}  // namespace slipwave::model_region_test
