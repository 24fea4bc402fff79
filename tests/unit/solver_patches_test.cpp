// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scene/edges.hpp"
#include "solver/schedule/patches.hpp"

namespace slipwave::solver::solver_patches_test {
namespace {

/// Patches of a model of these columns whose second row has fractures in these cells.
class PatchesOf {
 public:
  PatchesOf(std::int64_t nx, const std::vector<IndexRange>& fractured, EdgeLaw sides = EdgeLaw::rigid) {
    const Grid<2> grid{{nx, 3}, 5, {0, 0}};
    model_.medium = {Field<2>(grid, 3000), Field<2>(grid, 1500), Field<2>(grid, 2000)};
    model_.fracture = Field<2, std::uint8_t>(grid);
    model_.fracture_sets = {{"cracks", {{{0, 1}, 0.3}}}};
    for (const auto& columns : fractured)
      for (auto x = columns.first; x < columns.last; ++x) model_.fracture({x, 1}) = 1;
    EdgeLaws<2> edges;
    edges[0] = {sides, sides};
    edges[1] = {EdgeLaw::rigid, EdgeLaw::rigid};
    const auto domain = make_domain(model_.medium, edges, 20);
    const Layout<2> layout(domain.grid.shape, FieldRows<2>::count);
    patches_ = Patches<2>(layout, domain, model_);
  }
  /// First and last columns of the cells, and of the blocks round them.
  std::vector<std::vector<std::int64_t>> found(std::int64_t line = 1) const {
    std::vector<std::vector<std::int64_t>> all;
    for (const auto& patch : patches_.of(line))
      all.push_back({patch.cells.first, patch.cells.last, patch.blocks.first, patch.blocks.last});
    return all;
  }
  bool whole() const { return !patches_.whole_lines().empty(); }

 private:
  Model<2> model_;
  Patches<2> patches_;
};

using Found = std::vector<std::vector<std::int64_t>>;

TEST(Patches, HoldFracturesAndWhatASweepSpreadsThemTo) {
  const PatchesOf one(400, {{200, 210}});
  EXPECT_EQ(one.found(), (Found{{196, 214, 192, 224}}));
  EXPECT_EQ(one.found(0), Found{});
  EXPECT_FALSE(one.whole());
}

TEST(Patches, AreOneWhereTheyWouldReadEachOther) {
  EXPECT_EQ(PatchesOf(600, {{200, 210}, {281, 282}}).found(), (Found{{196, 286, 192, 288}}));
  EXPECT_EQ(PatchesOf(600, {{200, 210}, {282, 283}}).found(),
            (Found{{196, 214, 192, 224}, {278, 287, 272, 288}}));
}

TEST(Patches, OfAMirroredModelAreMirrored) {
  const auto left = PatchesOf(600, {{130, 143}, {222, 230}}).found();
  const auto right = PatchesOf(600, {{370, 378}, {457, 470}}).found();
  ASSERT_EQ(left.size(), 2u);
  ASSERT_EQ(right.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(left[n][0], 600 - right[1 - n][1]);
    EXPECT_EQ(left[n][1], 600 - right[1 - n][0]);
  }
}

TEST(Patches, AreWholeLinesNearTheirEndsAndWhereTheySaveNothing) {
  // The first cell a patch may begin with is 64 from an end without a layer, 32 from a layer.
  EXPECT_TRUE(PatchesOf(400, {{67, 68}}).whole());
  EXPECT_FALSE(PatchesOf(400, {{68, 69}}).whole());
  EXPECT_TRUE(PatchesOf(400, {{332, 333}}).whole());
  EXPECT_FALSE(PatchesOf(400, {{331, 332}}).whole());
  EXPECT_TRUE(PatchesOf(400, {{43, 44}}, EdgeLaw::absorbing).whole());
  EXPECT_FALSE(PatchesOf(400, {{48, 49}}, EdgeLaw::absorbing).whole());
  EXPECT_EQ(PatchesOf(400, {{67, 68}}).found(), Found{});
  EXPECT_FALSE(PatchesOf(400, {{130, 258}}).whole());
  EXPECT_TRUE(PatchesOf(400, {{130, 259}}).whole());
}

}  // namespace
}  // namespace slipwave::solver::solver_patches_test
