// SPDX-License-Identifier: BSD-3-Clause
// The same ground as an edge, below void on faces and as rows that follow it, level, upright and in steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drawn_scene.hpp"
#include "fitted_medium.hpp"
#include "shared_out.hpp"

namespace slipwave::solver::surface_test {
namespace {

const char* const mechanisms[] = {"force:0.4,1", "explosion", "moment:1,-0.5,0.3"};

/// Points along ground of which one is on it, one within half a cell and one below.
std::vector<Point<2>> points_below(double depth_m, Draw& draw) {
  return {{52 + draw.between(0, 1), depth_m},
          {60, depth_m + draw.between(0.01, 0.5)},
          {70.3, depth_m + draw.between(0.5, 4)}};
}

// Proves (E11), (E11b), (E11c).
TEST(SameGround, AsEdgeAndBelowVoidGivesTheSameTraces) {
  for (const unsigned seed : seeds(3))
    for (const bool upright : {false, true}) {
      Draw draw(seed);
      const Rock rock = draw.rock(draw.between(8, 20)), below = draw.rock(25);
      const auto layer = draw.whole(14, 25), above = draw.whole(3, 9);
      const char* const mechanism = mechanisms[seed % 3];
      const double depth_m = draw.between(0, 2) * double(draw.whole(0, 1));
      auto points = points_below(0, draw);
      std::vector<std::vector<double>> found;
      for (const auto voids : {std::int64_t(0), above}) {
        const auto depths = voids + 45;
        const auto filling = [&](std::int64_t down) {
          return down < voids ? nothing : down < voids + layer ? rock : below;
        };
        auto scene = upright ? scene_of(depths, 100, [&](auto i, auto) { return filling(i); })
                             : scene_of(100, depths, [&](auto, auto k) { return filling(k); });
        if (voids == 0) scene.edges[upright ? 0 : 1][0] = EdgeLaw::free;
        const auto place = [&](double along, double down) {
          down += double(voids);
          return upright ? Point<2>{down, along} : Point<2>{along, down};
        };
        std::vector<Point<2>> receivers;
        for (const auto& point : points) receivers.push_back(place(point[0], point[1]));
        shoot_from(scene, place(48.2, depth_m), mechanism, receivers);
        found.push_back(traces_of(scene));
      }
      EXPECT_LT(difference(found[1], found[0]), rounding)
          << "seed " << seed << (upright ? ", upright, " : ", level, ") << mechanism;
    }
}

TEST(SameGround, ThatRowsFollowOffFacesGivesTheTracesOfTheEdge) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock rock = draw.rock(draw.between(18, 24));
    const double off = draw.between(0.05, 0.45);
    std::vector<std::vector<double>> found;
    for (const double depth_m : {0., 10 + off}) {
      auto scene = scene_of(100, depth_m > 0 ? 61 : 50, [&](auto, auto) { return rock; });
      if (depth_m > 0)
        scene.model.medium =
            fitted_medium<2>(scene.model.grid(),
                             {{[&](double, double) { return depth_m; }, rock.vp, rock.vs, rock.rho}}, true);
      scene.edges[1][0] = EdgeLaw::free;
      shoot_from(scene, {40.3, depth_m + 3.2}, "force:0.4,1",
                 {{52, depth_m}, {60.4, depth_m}, {65, depth_m + 2.3}});
      found.push_back(traces_of(scene));
    }
    // Of the second order in the height of rows, which differs by half a cell at most.
    EXPECT_LT(difference(found[1], found[0]), 0.02) << "seed " << seed << ", off by " << off;
  }
}

TEST(SameBed, OfOneOrTwoCellsGivesTheTracesOfSmallCells) {
  for (const unsigned seed : seeds(1, 10)) {
    Draw draw(seed);
    const Rock upper = draw.rock(24), lower = draw.rock(30), bed = draw.rock(draw.between(11, 16));
    // On faces of the small cells, in quarters of a large one.
    const auto top = draw.whole(81, 83), bottom = top + draw.whole(4, 8);
    const auto filling = [&](auto, std::int64_t k) { return k < top ? upper : k < bottom ? bed : lower; };
    auto small = scene_of(400, 200, filling, 0.06 * 4, 0.25);
    auto scene = scene_of(100, 50, [&](auto, auto) { return lower; });
    const auto below = [](double depth_m, const Rock& rock) {
      return Below{[=](double, double) { return depth_m; }, rock.vp, rock.vs, rock.rho};
    };
    scene.model.medium = fitted_medium<2>(
        scene.model.grid(), {below(0, upper), below(double(top) / 4, bed), below(double(bottom) / 4, lower)});
    shoot_from(scene, {30.3, 6.2}, "explosion", {{50, 8}, {65.4, 10}, {75, 35.3}});
    small.recording = scene.recording;
    small.survey = scene.survey;
    scene.numerics.zone_cells = 10, small.numerics.zone_cells = 40;
    EXPECT_LT(difference(traces_of(scene), traces_of(small)), 0.02) << "seed " << seed;
  }
}

/// Rock below ground in steps up and down, with an overhang.
Filling steps(Draw& draw, const Rock& rock) {
  std::vector<std::int64_t> tops;
  std::int64_t top = 12;
  while (tops.size() < 400) {
    top = std::clamp<std::int64_t>(top + draw.whole(-3, 3), 6, 20);
    tops.insert(tops.end(), std::size_t(draw.whole(1, 14)), top);
  }
  return [tops, rock](std::int64_t i, std::int64_t k) {
    const bool cave = i >= 30 && i < 36 && k >= 22 && k < 31;
    return k < tops[std::size_t(i)] || cave ? nothing : rock;
  };
}

Scene<2> stepped(unsigned seed, std::int64_t nx = 100) {
  Draw draw(seed);
  const Rock rock = draw.rock(12);
  auto scene = scene_of(nx, 60, steps(draw, rock));
  shoot_from(scene, {48.2, 22.3}, mechanisms[seed % 3], {{20, 25}, {37.2, 26}, {70.5, 23.1}});
  return scene;
}

TEST(SameGround, InStepsTurnedByARightAngleGivesTheSameTraces) {
  for (const unsigned seed : seeds()) {
    auto scene = stepped(seed);
    scene.survey.sources[0].mechanism = parse_mechanism<2>("force:0,1");
    const auto upright = traces_of(scene);
    auto turned = scene_of(60, 100, [&](auto i, auto k) {
      const auto& medium = scene.model.medium;
      const Index<2> from{k, i};
      return Rock{medium.vp(from), medium.vs(from), medium.rho(from)};
    });
    const auto turn = [](const Point<2>& at) { return Point<2>{at[1], at[0]}; };
    std::vector<Point<2>> receivers;
    for (const auto& at : scene.survey.receivers_m) receivers.push_back(turn(at));
    shoot_from(turned, turn(scene.survey.sources[0].position_m), "force:1,0", receivers);
    turned.recording.components = {Component::vx, Component::vz};
    // Sweeps come in another order: an error of the splitting, which falls with the step.
    const double whole = difference(traces_of(turned), upright);
    scene.numerics.cfl /= 2, turned.numerics.cfl /= 2;
    const double half = difference(traces_of(turned), traces_of(scene));
    EXPECT_GT(std::log2(whole / half), 0.5) << "seed " << seed << ": " << whole << ", " << half;
  }
}

/// What differs between ground below void, or below water, and the same turned upright, which sweeps pass in
/// another order, with so many cells in the shortest wave.
double of_turned_ground(unsigned seed, bool below_water, double cells) {
  Draw draw(seed);
  const double rho = draw.between(1800, 2400), ratio = draw.between(1.6, 2.2);
  const Rock water{draw.between(1.05, 1.3) * 100 * cells, 0, 1000};
  const Rock rock{ratio * 100 * cells, 100 * cells, rho};
  const double size = cells / 20, ground = std::round(45 * size);
  const auto n = std::int64_t(std::round(110 * size));
  std::vector<std::vector<double>> found;
  for (const bool upright : {false, true}) {
    auto scene = scene_of(n, n, [&](auto i, auto k) {
      return double(upright ? i : k) >= ground ? rock : below_water ? water : nothing;
    });
    const auto place = [&](double along, double down) {
      down = ground + down * size;
      along *= size;
      return upright ? Point<2>{down, along} : Point<2>{along, down};
    };
    shoot_from(scene, place(25.3, below_water ? -6.2 : 6.2), "explosion",
               {place(60, 0), place(75.4, 3), place(85, below_water ? -4 : 0.6)});
    if (upright) scene.recording.components = {Component::vx, Component::vz};
    found.push_back(traces_of(scene));
  }
  return difference(found[1], found[0]);
}

// Proves (E11a), (A23).
TEST(SameGround, TurnedByARightAngleDiffersToSecondOrder) {
  for (const bool below_water : {false, true})
    for (const unsigned seed : seeds()) {
      const double coarse = of_turned_ground(seed, below_water, 20),
                   fine = of_turned_ground(seed, below_water, 40);
      SCOPED_TRACE(testing::Message() << (below_water ? "below water" : "below void") << ", seed " << seed);
      EXPECT_LT(coarse, 0.01);
      EXPECT_GT(std::log2(coarse / fine), 1.7) << coarse << ", " << fine;
    }
}

/// A slice one cell thick between mirrors stands for ground that continues along y, and its point source for
/// a line of them.
TEST(SameGround, ThatContinuesInSpaceGivesTheTracesOfALineSource) {
  for (const unsigned seed : seeds()) {
    auto scene = stepped(seed);
    const bool explodes = seed % 2 == 0;
    scene.survey.sources[0].mechanism = parse_mechanism<2>(explodes ? "explosion" : "force:0.4,1");
    const auto& plane = scene.model.medium;
    const auto& shape = plane.grid().shape;
    Scene<3> slice;
    auto& medium = slice.model.medium = Medium<3>(Grid<3>{{shape[0], 1, shape[1]}, 1, {0, 0, 0}});
    for (const Property property : plane.properties())
      std::copy(plane[property].begin(), plane[property].end(), medium[property].begin());
    slice.edges[0] = scene.edges[0], slice.edges[2] = scene.edges[1];
    slice.edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
    slice.numerics = scene.numerics;
    slice.recording = scene.recording;
    const auto place = [](const Point<2>& at) { return Point<3>{at[0], 0.5, at[1]}; };
    const auto& source = scene.survey.sources[0];
    slice.survey.sources = {{place(source.position_m),
                             parse_mechanism<3>(explodes ? "explosion" : "force:0.4,0,1"), source.wavelet,
                             source.amplitude}};
    for (const auto& at : scene.survey.receivers_m) slice.survey.receivers_m.push_back(place(at));
    EXPECT_LT(difference(samples_of(shoot(slice, 1)), traces_of(scene)), rounding) << "seed " << seed;
  }
}

/// Ground across an axis in a cube, at the edge of the grid or below so many layers of void. Places are given
/// by how far they are along both other axes, and how deep.
struct GroundInSpace {
  int axis;
  std::int64_t voids;
  Scene<3> scene{};

  GroundInSpace(const Rock& rock, int axis_of_it, std::int64_t voids_above, std::int64_t cells)
      : axis(axis_of_it), voids(voids_above) {
    Grid<3> grid{{cells, cells, cells}, 1, {0, 0, 0}};
    grid.shape[std::size_t(axis)] += voids;
    Medium<3> medium{Field<3>(grid), Field<3>(grid), Field<3>(grid)};
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      if (grid.index(n)[std::size_t(axis)] < voids) continue;
      const auto cell = std::size_t(n);
      medium.vp[cell] = float(rock.vp), medium.vs[cell] = float(rock.vs), medium.rho[cell] = float(rock.rho);
    }
    scene.model.medium = std::move(medium);
    for (int of = 0; of < 3; ++of) scene.edges[of] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
    if (voids == 0) scene.edges[axis][0] = EdgeLaw::free;
    scene.numerics.double_precision = true;
    scene.numerics.tiling = {2, 16};
  }
  Point<3> place(double along, double down) const {
    Point<3> at{along, along, along};
    at[std::size_t(axis)] = down + double(voids);
    return at;
  }
  std::vector<double> traces(const Point<3>& source, const std::string& mechanism, double duration_s) {
    scene.survey.sources = {{source, parse_mechanism<3>(mechanism), parse_wavelet("ricker:100"), 1e6}};
    const std::array all{Component::vx, Component::vy, Component::vz};
    scene.recording = {
        {all[std::size_t(axis)], all[std::size_t((axis + 1) % 3)], all[std::size_t((axis + 2) % 3)]},
        duration_s,
        0.0005};
    return samples_of(shoot(scene, 1));
  }
};

TEST(SameGround, InSpaceAsEdgeAndBelowVoidGivesTheSameTraces) {
  for (const unsigned seed : seeds(1, 3))
    for (const int axis : {0, 1, 2}) {
      Draw draw(seed);
      const Rock rock = draw.rock(10);
      std::vector<std::vector<double>> found;
      for (const std::int64_t voids : {0, 5}) {
        GroundInSpace of(rock, axis, voids, 20);
        of.scene.numerics.zone_cells = 6;
        of.scene.survey.receivers_m = {of.place(14, 0), of.place(17.2, 0.3), of.place(18, 3)};
        found.push_back(of.traces(of.place(10.3, 0.4), "force:0.4,-0.3,1", 0.03));
      }
      EXPECT_LT(difference(found[1], found[0]), rounding) << "seed " << seed << ", axis " << axis;
    }
}

// Proves (A23).
TEST(SameGround, InSpaceTurnedByRightAnglesGivesNearlyTheSameTraces) {
  for (const unsigned seed : seeds(1, 5)) {
    Draw draw(seed);
    const Rock rock = draw.rock(40);
    std::vector<std::vector<double>> found;
    for (const int axis : {2, 0, 1}) {
      GroundInSpace of(rock, axis, 5, 24);
      // No edges absorb, which do so along one axis after the other, too.
      for (int other = 0; other < 3; ++other) of.scene.edges[other] = {EdgeLaw::mirror, EdgeLaw::mirror};
      of.scene.survey.receivers_m = {of.place(14, 0), of.place(17.2, 0.3), of.place(19.1, 0.6)};
      found.push_back(of.traces(of.place(9.3, 12.2), "explosion", 0.04));
    }
    // Waves of 40 cells: what is left is of the second order.
    for (const std::size_t n : {1U, 2U})
      EXPECT_LT(difference(found[n], found[0]), 0.002) << "seed " << seed << ", axis " << n - 1;
  }
}

}  // namespace
}  // namespace slipwave::solver::surface_test
