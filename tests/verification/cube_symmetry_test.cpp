// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube_shot.hpp"
#include "long_form.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver::cube_symmetry_test {
namespace {

TEST(CubeSymmetry, OfMirrorImagesAlongAllAxesIsKept) {
  // Sums in the mirror round otherwise: a hundred sweeps of 1e-16.
  using Rows = FieldRows<3>;
  const Index<3> shape = {25, 21, 28};
  const auto medium = lumps(shape, 5, 4);
  const double dt_s = 0.9 * 5 / 5500;
  for (const auto law : {EdgeLaw::free, EdgeLaw::absorbing})
    for (int axis = 0; axis < 3; ++axis) {
      auto image = medium;
      const auto mirrored = [&](Index<3> at, const Grid<3>& grid) {
        at[std::size_t(axis)] = grid.shape[std::size_t(axis)] - 1 - at[std::size_t(axis)];
        return at;
      };
      for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
        const auto at = medium.grid().index(n);
        put(image, mirrored(at, medium.grid()), {medium.vp(at), medium.vs(at), medium.rho(at)});
      }
      const auto edges = edges_all_3d(law);
      Cube<double> cube(medium, edges, 5, dt_s), other(image, edges, 5, dt_s);
      if (law == EdgeLaw::free) cube.shake(2);
      if (law == EdgeLaw::absorbing)
        cube(0, {12, 10, 14}) = cube(1, {12, 10, 15}) = cube(2, {13, 10, 14}) = 1;
      const auto sign = [&](int row) {
        bool odd = row == Rows::velocity(axis);
        for (int along = 0; along < 3; ++along)
          odd |= along != axis && row == Rows::shear_stress(axis, along);
        return odd ? -1 : 1;
      };
      const auto each = [&](auto&& what) {
        for (std::int64_t n = 0; n < cube.grid().size(); ++n)
          for (int row = 0; row < Rows::count; ++row)
            what(row, cube.grid().index(n), mirrored(cube.grid().index(n), cube.grid()));
      };
      each([&](int row, const Index<3>& at, const Index<3>& there) {
        other(row, there) = sign(row) * cube(row, at);
      });
      cube.steps(20);
      other.steps(20);
      double difference = 0, largest = 0;
      each([&](int row, const Index<3>& at, const Index<3>& there) {
        const double unit = row < 3 ? 1 : 1e7;
        difference = std::max(difference, std::abs(other(row, there) - sign(row) * cube(row, at)) / unit);
        largest = std::max(largest, std::abs(cube(row, at)) / unit);
      });
      EXPECT_GT(largest, 1e-3);
      EXPECT_LT(difference, 1e-12 * largest) << "axis " << axis << ", law " << int(law);
    }
}

TEST(CubeEnergy, NeverRisesBetweenRigidWallsOrMirrors) {
  const auto medium = lumps({20, 17, 22}, 5, 6);
  for (const auto law : {EdgeLaw::rigid, EdgeLaw::mirror})
    for (const int order : orders)
      for (const int time_order : {2, 4}) {
        // In the short form each order in space and time between edges of one kind.
        if (!long_form() && (law == EdgeLaw::mirror) == (order % 4 + time_order == 5)) continue;
        Cube<double> cube(medium, edges_all_3d(law), order, 0.99 * 5 / 5500, time_order);
        cube.shake(8);
        double least = cube.energy();
        for (int n = 0; n < 25; ++n) {
          cube.steps(1);
          const double now = cube.energy();
          EXPECT_LT(now, least * (1 + 1e-11)) << "order " << order << ", step " << n;
          least = std::min(least, now);
        }
        EXPECT_GT(least, 0);
      }
}

// Proves (E11).
TEST(CubeEnergy, BetweenFreeEdgesFallsInTheLongRun) {
  // Free surfaces of solids correct the images of the fields: energy may rise a little in some steps.
  const auto medium = lumps({24, 22, 26}, 5, 6);
  for (const int order : {3, 5, 7}) {
    Cube<double> cube(medium, edges_all_3d(EdgeLaw::free), order, 0.99 * 5 / 5500);
    cube.shake(8);
    double least = cube.energy();
    const double first = least;
    for (int n = 0; n < 30; ++n) {
      cube.steps(10);
      const double now = cube.energy();
      EXPECT_LT(now, least * 1.002) << "order " << order << ", step " << 10 * n;
      least = std::min(least, now);
    }
    EXPECT_LT(least, 0.5 * first);
  }
}

TEST(CubeReciprocity, OfForcesHoldsThroughWaterAndRock) {
  // G_ij(A, B) = G_ji(B, A); S waves of the wavelet's peak hold 16 cells, of its highest frequency 6.
  const Index<3> shape = {36, 32, 42};
  auto medium = uniform_cube(shape, 5, {4500, 2600, 2500});
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    if (at[2] < 8) put(medium, at, {1500, 0, 1000});
    if (at[2] > 30 && at[0] + at[1] > 40) put(medium, at, {3500, 2000, 2200});
  }
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[2][0] = EdgeLaw::free;
  const Point<3> a = {38, 46, 92}, b = {126, 103, 163};
  const char* const forces[] = {"force:1,0,0", "force:0,1,0", "force:0,0,1"};
  const auto traces = [&](const Point<3>& from, const Point<3>& to, int axis) {
    auto scene = scene_of(medium, edges, from, forces[axis], "ricker:25", {to},
                          {Component::vx, Component::vy, Component::vz}, 0.15, 0.001);
    return shoot(scene, 1);
  };
  std::array<Gather, 3> there, back;
  for (int axis = 0; axis < 3; ++axis) {
    there[std::size_t(axis)] = traces(a, b, axis);
    back[std::size_t(axis)] = traces(b, a, axis);
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_LT(relative_error(there[i].traces[j].samples, back[j].traces[i].samples), 0.03) << i << j;
}

}  // namespace
}  // namespace slipwave::solver::cube_symmetry_test
