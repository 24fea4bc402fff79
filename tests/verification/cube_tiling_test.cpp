// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "cube.hpp"
#include "parallel/threads.hpp"
#include "solver/schedule/tiled.hpp"

namespace slipwave::solver::cube_tiling_test {
namespace {

/// Sweeps alone.
template <class Real>
TimeStep<3, Real> sweeps_of(Cube<Real>& cube, double dt_s, int time_order, std::int64_t steps) {
  std::vector<Entry<3, Real>> entries;
  for (const auto& [axis, fraction] : splitting(3, time_order))
    entries.push_back(Sweep<3, Real>{axis, fraction, {}});
  return {cube.state().layout, dt_s, std::move(entries), {}, true, steps};
}

/// Time tiles end with a whole sweep along x, which belongs to the next step, too: here as many sweeps one
/// after the other, each through all of the memory.
template <class Real>
void sweep_by_sweep(Cube<Real>& cube, std::int64_t steps, int time_order) {
  const auto parts = splitting(3, time_order);
  cube.sweep(0, parts.front().fraction);
  for (std::int64_t n = 0; n < steps; ++n) {
    for (std::size_t inner = 1; inner + 1 < parts.size(); ++inner)
      cube.sweep(parts[inner].axis, parts[inner].fraction);
    cube.sweep(0, 2 * parts.front().fraction);
  }
}

template <class Real>
std::vector<Real> fields_of(Cube<Real>& cube) {
  std::vector<Real> all;
  const auto& shape = cube.grid().shape;
  for (std::int64_t k = 0; k < shape[2]; ++k)
    for (std::int64_t j = 0; j < shape[1]; ++j)
      for (int row = 0; row < FieldRows<3>::count; ++row) {
        const Real* const first = &cube(row, {0, j, k});
        all.insert(all.end(), first, first + shape[0]);
      }
  return all;
}

/// A setting and some ways to tile it.
struct TilingCase {
  const char* name;
  EdgeLaw edges;
  int order, time_order;
};
using TilingAndThreads = std::pair<Tiling, int>;

/// The fields of some steps in time tiles are those of whole sweeps.
void expect_same_as_sweeps(const Medium<3>& medium, const TilingCase& of,
                           const std::vector<TilingAndThreads>& tilings) {
  SCOPED_TRACE(of.name);
  const double dt_s = 0.9 * 5 / 5500;
  const std::int64_t steps = 4;
  const auto edges = edges_all_3d(of.edges);
  Cube<float> one(medium, edges, of.order, dt_s, of.time_order);
  one.shake(1);
  const auto& fields = one.state().fields;
  const std::vector<float> begun(fields.data(), fields.data() + fields.size());
  sweep_by_sweep(one, steps, of.time_order);
  const auto expected = fields_of(one);
  for (const auto& [tiling, threads] : tilings) {
    const ThreadLimit limit(threads);
    Cube<float> cube(medium, edges, of.order, dt_s, of.time_order);
    std::copy(begun.begin(), begun.end(), cube.state().fields.data());
    auto step = sweeps_of(cube, dt_s, of.time_order, steps);
    TiledExecutor<3, float> executor(cube.sweeps(), cube.state(), step, tiling);
    executor.fields_changed();
    executor.run(0, steps);
    EXPECT_TRUE(fields_of(cube) == expected)
        << tiling.steps << " steps, " << tiling.stripe_cells << " rows, " << threads << " threads";
  }
}

TEST(TilingOfACube, DoesWhatSweepsOneAfterTheOtherDo) {
  // More planes than two bands, rows for several stripes.
  const auto medium = lumps({17, 29, 72}, 5, 3);
  for (const auto& of :
       {TilingCase{"free edges", EdgeLaw::free, 5, 2}, TilingCase{"free edges, order 3", EdgeLaw::free, 3, 2},
        TilingCase{"free edges, order 4 in time", EdgeLaw::free, 7, 4},
        TilingCase{"rigid", EdgeLaw::rigid, 1, 2},
        TilingCase{"mirrors, order 4 in time", EdgeLaw::mirror, 3, 4},
        TilingCase{"mirrors", EdgeLaw::mirror, 7, 2}})
    expect_same_as_sweeps(medium, of,
                          of.time_order == 4 || of.order == 1
                              ? std::vector<TilingAndThreads>{{{1, 100, true}, 3}, {{2, 7}, 1}}
                              : std::vector<TilingAndThreads>{{{3, 12, true}, 3}, {{0, 0}, 1}});
}

/// A medium of gently different cells: no interfaces and no uniform runs, so that all rows are fused.
Medium<3> grains(const Index<3>& shape) {
  auto medium = lumps(shape, 5, 3);
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> size(0.93F, 1);
  for (std::size_t n = 0; n < medium.vp.size(); ++n) {
    const float here = size(engine);
    medium.vp[n] = 4500 * here, medium.vs[n] = 2250 * here, medium.rho[n] = 2500 * here;
  }
  return medium;
}

TEST(TilingOfACube, HasNoSeamsBetweenColumnsSweptTogetherAndBlocksOfPlanes) {
  // More columns than are swept together, fewer rows and planes than stencils and blocks, whole blocks and
  // none.
  for (const auto& shape : {Index<3>{130, 9, 35}, Index<3>{128, 4, 3}, Index<3>{257, 1, 2}})
    for (const auto& medium : {grains(shape), lumps(shape, 5, 3)})
      for (const auto& of : {TilingCase{"free edges", EdgeLaw::free, 5, 2},
                             TilingCase{"mirrors, order 11", EdgeLaw::mirror, 11, 2},
                             TilingCase{"rigid, order 1, 4 in time", EdgeLaw::rigid, 1, 4}})
        expect_same_as_sweeps(medium, of, {{{0, 0}, 1}, {{2, 5, true}, 2}});
}

TEST(TilingOfACube, KeepsWhatTheSweepBeforeReadsAtFlanksOfThinSlabs) {
  // Too thin along x for corrections there: two sweeps along y follow each other closely.
  for (const auto& shape : {Index<3>{5, 13, 9}, Index<3>{5, 30, 30}})
    for (const int order : {3, 5, 11})
      expect_same_as_sweeps(uniform_cube(shape, 5, {4500, 2250, 2500}),
                            {"free edges", EdgeLaw::free, order, 2}, {{{0, 0}, 1}, {{2, 5, true}, 2}});
}

/// Fields where the axes of `from` are those that `axis_of` says.
void turn(Cube<double>& from, const std::array<std::size_t, 3>& axis_of, Cube<double>& to) {
  using Rows = FieldRows<3>;
  for (std::int64_t n = 0; n < from.grid().size(); ++n) {
    const auto at = from.grid().index(n);
    const Index<3> there = {at[axis_of[0]], at[axis_of[1]], at[axis_of[2]]};
    for (int a = 0; a < 3; ++a) {
      const int b = int(axis_of[std::size_t(a)]);
      to(Rows::velocity(a), there) = from(Rows::velocity(b), at);
      to(Rows::normal_stress(a), there) = from(Rows::normal_stress(b), at);
      for (int other = a + 1; other < 3; ++other) {
        const int c = int(axis_of[std::size_t(other)]);
        to(Rows::shear_stress(a, other), there) = from(Rows::shear_stress(b, c), at);
      }
    }
  }
}

// Proves (E11).
TEST(SweepsOfACube, AreAlikeAlongAllAxes) {
  const Index<3> shape = {20, 15, 24};
  const auto medium = lumps(shape, 5, 9);
  const double dt_s = 0.9 * 5 / 5500;
  const EdgeLaw laws[3][2] = {
      {EdgeLaw::free, EdgeLaw::rigid}, {EdgeLaw::mirror, EdgeLaw::free}, {EdgeLaw::free, EdgeLaw::free}};
  for (const int order : orders)
    for (const auto& axis_of : {std::array<std::size_t, 3>{1, 2, 0}, std::array<std::size_t, 3>{2, 0, 1},
                                std::array<std::size_t, 3>{0, 2, 1}, std::array<std::size_t, 3>{2, 1, 0}}) {
      EdgeLaws<3> edges, turned_edges;
      Index<3> turned_shape;
      for (int axis = 0; axis < 3; ++axis) edges[axis] = {laws[axis][0], laws[axis][1]};
      for (int axis = 0; axis < 3; ++axis) {
        turned_edges[axis] = edges[int(axis_of[std::size_t(axis)])];
        turned_shape[std::size_t(axis)] = shape[axis_of[std::size_t(axis)]];
      }
      auto turned = uniform_cube(turned_shape, 5, {4500, 2250, 2500});
      for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
        const auto at = medium.grid().index(n);
        put(turned, {at[axis_of[0]], at[axis_of[1]], at[axis_of[2]]},
            {medium.vp(at), medium.vs(at), medium.rho(at)});
      }
      Cube<double> cube(medium, edges, order, dt_s), other(turned, turned_edges, order, dt_s);
      cube.shake(5);
      turn(cube, axis_of, other);
      for (int axis = 0; axis < 3; ++axis) {
        cube.sweep(int(axis_of[std::size_t(axis)]), 0.7);
        other.sweep(axis, 0.7);
      }
      Cube<double> expected(turned, turned_edges, order, dt_s);
      turn(cube, axis_of, expected);
      double difference = 0, largest = 0;
      for (std::int64_t n = 0; n < other.grid().size(); ++n)
        for (int row = 0; row < FieldRows<3>::count; ++row) {
          const auto at = other.grid().index(n);
          const double unit = row < 3 ? 1 : 1e7;
          difference = std::max(difference, std::abs(other(row, at) - expected(row, at)) / unit);
          largest = std::max(largest, std::abs(expected(row, at)) / unit);
        }
      EXPECT_LT(difference, 1e-13 * largest) << "order " << order << ", " << axis_of[0] << axis_of[1];
    }
}

}  // namespace
}  // namespace slipwave::solver::cube_tiling_test
