#include <gtest/gtest.h>

#include "base/parallel.hpp"
#include "cube_shot.hpp"

namespace slipwave::solver {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000};

/// Water over two rocks.
Rock reef_at(std::int64_t along, std::int64_t count, std::int64_t depth) {
  if (depth < 12 + std::abs(2 * along + 1 - count) / 20) return water;
  return depth > 38 ? soft : rock;
}

/// The same in 3-D, not the same from row to row, with a source and receivers all over it.
Scene<3> reef(const EdgeLaws<3>& edges, const char* mechanism) {
  const Index<3> shape = {40, 36, 48};
  auto medium = uniform_cube(shape, 5, rock);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    put(medium, at, reef_at(at[0] + at[1] / 3, shape[0], at[2]));
  }
  return scene_of(medium, edges, {91, 87, 121}, mechanism, "ricker:40",
                  {{21, 30, 13}, {133, 71.3, 62.2}, {71, 160, 187}},
                  {Component::vx, Component::vy, Component::syz, Component::p}, 0.06, 0.001);
}

TEST(CubeTraces, DoNotDependOnHowPassesThroughMemoryAreCut) {
  struct Cut {
    const char* name;
    EdgeLaw sides;
    int order, time_order;
    const char* mechanism;
  };
  for (const auto& [name, sides, order, time_order, mechanism] :
       {Cut{"matched layer", EdgeLaw::absorbing, 5, 2, "explosion"},
        Cut{"free sides", EdgeLaw::free, 7, 2, "force:1,2,3"},
        Cut{"mirror, order 4 in time", EdgeLaw::mirror, 3, 4, "moment:1,0,0,2,0,1"}}) {
    SCOPED_TRACE(name);
    auto edges = edges_all_3d(sides);
    edges[2][0] = EdgeLaw::free;
    auto scene = reef(edges, mechanism);
    scene.numerics.order = order;
    scene.numerics.time_order = time_order;
    scene.numerics.zone_cells = 6;
    scene.numerics.passage = {1, 1 << 20, true};
    const auto whole = [&] {
      const ThreadLimit one(1);
      return samples_of(shoot(scene, 1));
    }();
    double largest = 0;
    for (const double sample : whole) largest = std::max(largest, std::abs(sample));
    EXPECT_GT(largest, 0);
    for (const auto& passage : {Passage{0, 0}, Passage{1, 7}, Passage{3, 12, true}})
      for (const int threads : {1, 3}) {
        const ThreadLimit limit(threads);
        scene.numerics.passage = passage;
        EXPECT_TRUE(samples_of(shoot(scene, 1)) == whole)
            << passage.steps << " steps, " << passage.stripe_cells << " rows, " << threads << " threads";
      }
  }
}

TEST(CubeTraces, DoNotDependOnWhoElseIsLooking) {
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[2][0] = EdgeLaw::free;
  auto scene = reef(edges, "explosion");
  const auto all = samples_of(shoot(scene, 1));
  scene.snapshot_every_s = 0.007;
  int taken = 0;
  const auto watched = samples_of(shoot<3>(scene, 1, {}, [&](double, const FieldReader<3>& field) {
    taken += std::int64_t(field(Component::vy).size()) == scene.model.grid().size();
  }));
  EXPECT_EQ(all, watched);
  EXPECT_EQ(taken, 8);
  scene.survey.receivers_m.resize(1);
  const auto alone = shoot(scene, 1);
  EXPECT_TRUE(std::equal(alone.traces[0].samples.begin(), alone.traces[0].samples.end(), all.begin()));
}

/// A scene in 2-D, which stretches along one axis of a scene in 3-D one cell thick between mirrors.
struct Extruded {
  Scene<2> flat;
  Scene<3> deep;
};

/// `axes`: those of 3-D that x and z of 2-D become.
Extruded extruded(const std::array<int, 2>& axes, const EdgeLaws<2>& edges, const char* mechanism,
                  const char* mechanism_3d, const std::vector<Component>& components,
                  const std::vector<Component>& components_3d) {
  constexpr std::int64_t nx = 90, nz = 70;
  constexpr double h = 5;
  Extruded both;
  both.flat.model.medium = uniform_medium(nx, nz, h, rock);
  Index<3> shape = {1, 1, 1};
  shape[std::size_t(axes[0])] = nx;
  shape[std::size_t(axes[1])] = nz;
  auto medium = uniform_cube(shape, h, rock);
  const auto at = [&](std::int64_t i, std::int64_t k) {
    Index<3> cell{};
    cell[std::size_t(axes[0])] = i;
    cell[std::size_t(axes[1])] = k;
    return cell;
  };
  const auto point = [&](const Point<2>& flat) {
    Point<3> deep = {h / 2, h / 2, h / 2};
    for (std::size_t n = 0; n < 2; ++n) deep[std::size_t(axes[n])] = flat[n];
    return deep;
  };
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      put(both.flat.model.medium, {i, k}, reef_at(i, nx, k));
      put(medium, at(i, k), reef_at(i, nx, k));
    }
  both.flat.edges = edges;
  EdgeLaws<3> deep_edges = edges_all_3d(EdgeLaw::mirror);
  for (int n = 0; n < 2; ++n) deep_edges[axes[std::size_t(n)]] = edges[n];
  const Point<2> source = {221, 131};
  both.flat.survey.sources = {{source, parse_mechanism<2>(mechanism), parse_wavelet("ricker:25"), 1e9}};
  both.flat.survey.receivers_m = {{101, 33}, {302.5, 201.3}, {420, 60}, {201, 313}};
  both.flat.recording = {components, 0.2, 0.001};
  both.flat.numerics.double_precision = true;
  both.deep =
      scene_of(medium, deep_edges, point(source), mechanism_3d, "ricker:25", {}, components_3d, 0.2, 0.001);
  // A point source in a slice one cell thick is a line source of as much per metre.
  both.deep.survey.sources[0].amplitude *= h;
  for (const auto& receiver : both.flat.survey.receivers_m)
    both.deep.survey.receivers_m.push_back(point(receiver));
  both.deep.numerics.double_precision = true;
  return both;
}

double largest_error(const Extruded& both) {
  const auto flat = shoot(both.flat, 1), deep = shoot(both.deep, 1);
  double largest = 0;
  for (std::size_t n = 0; n < flat.traces.size(); ++n)
    largest = std::max(largest, relative_error(deep.traces[n].samples, flat.traces[n].samples));
  return largest;
}

EdgeLaws<2> edges_of(EdgeLaw top, EdgeLaw sides, EdgeLaw bottom) {
  EdgeLaws<2> edges;
  edges[0] = {sides, sides};
  edges[1] = {top, bottom};
  return edges;
}

const std::vector<Component> all = {Component::vx, Component::vz, Component::sxx, Component::szz,
                                    Component::sxz};

TEST(ExtrudedScene, AlongYGivesTheTracesOf2D) {
  // The same sweeps: only rounding differs.
  for (const auto& edges : {edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing),
                            edges_of(EdgeLaw::free, EdgeLaw::free, EdgeLaw::rigid),
                            edges_of(EdgeLaw::absorbing, EdgeLaw::mirror, EdgeLaw::free)})
    for (const auto& [mechanism, in_3d] :
         {std::pair("explosion", "explosion"), std::pair("force:1,2", "force:1,0,2"),
          std::pair("moment:1,2,3", "moment:1,0,2,0,3,0")}) {
      if (std::string(mechanism) != "explosion" && edges[1][0] == EdgeLaw::absorbing) continue;
      EXPECT_LT(largest_error(extruded({0, 2}, edges, mechanism, in_3d, all, all)), 1e-9) << mechanism;
    }
}

TEST(ExtrudedScene, AlongXOrZGivesTheTracesOf2D) {
  // The sweeps of a step are others: of the second order, at 12 cells an S wavelength of the softest rock.
  const auto edges = edges_of(EdgeLaw::free, EdgeLaw::free, EdgeLaw::mirror);
  const std::vector<Component> of_yz = {Component::vy, Component::vz, Component::syy, Component::szz,
                                        Component::syz},
                               of_xy = {Component::vx, Component::vy, Component::sxx, Component::syy,
                                        Component::sxy};
  auto along_x = extruded({1, 2}, edges, "force:1,2", "force:0,1,2", all, of_yz);
  auto along_z = extruded({0, 1}, edges, "force:1,2", "force:1,2,0", all, of_xy);
  for (auto* both : {&along_x, &along_z}) {
    both->flat.numerics.cfl = both->deep.numerics.cfl = 0.5;
    EXPECT_LT(largest_error(*both), 0.02);
  }
}

}  // namespace
}  // namespace slipwave::solver
