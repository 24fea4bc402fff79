// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube_shot.hpp"
#include "long_form.hpp"

// A point source in a full space against Stokes' solution (1849; Aki & Richards 2002, eq. 4.23 and 4.29).
// Planes of symmetry stand for most of the space: a source on a mirror is one of twice its strength in the
// whole.
namespace slipwave::solver::cube_full_space_test {
namespace {

constexpr Rock rock{4500, 2600, 2500};
constexpr double spacing_m = 5, interval_s = 0.001, amplitude = 1e9;
/// 22 cells a dominant P wavelength, 17 cells a dominant S wavelength.
constexpr RickerForm p_wavelet{40}, s_wavelet{30};

/// Velocity at r from a force `amplitude` w along `axis`.
double force_velocity(const Point<3>& r, int axis, int component, double t) {
  const double distance = std::hypot(r[0], r[1], r[2]), tp = distance / rock.vp, ts = distance / rock.vs;
  const double along = r[std::size_t(axis)] * r[std::size_t(component)] / (distance * distance);
  const double same = axis == component;
  // The integral of s w'(t - s) from tp to ts.
  const double near = tp * s_wavelet(t - tp) - ts * s_wavelet(t - ts) + s_wavelet.integral(t - tp) -
                      s_wavelet.integral(t - ts);
  return amplitude / (4 * std::numbers::pi * rock.rho) *
         ((3 * along - same) * near / std::pow(distance, 3) +
          along * s_wavelet.slope(t - tp) / (rock.vp * rock.vp * distance) -
          (along - same) * s_wavelet.slope(t - ts) / (rock.vs * rock.vs * distance));
}

/// Radial velocity at a distance from an explosion whose moment grows at the rate `amplitude` w, and pressure
/// (minus the mean of the normal stresses).
double explosion_velocity(double distance, double t, const RickerForm& wavelet = p_wavelet) {
  const double delayed = t - distance / rock.vp;
  return amplitude / (4 * std::numbers::pi * rock.rho * rock.vp * rock.vp) *
         (wavelet(delayed) / (distance * distance) + wavelet.slope(delayed) / (rock.vp * distance));
}
double explosion_pressure(double distance, double t) {
  const double bulk = rock.lambda() + 2 * rock.mu() / 3;
  return bulk * amplitude * p_wavelet.slope(t - distance / rock.vp) /
         (4 * std::numbers::pi * rock.rho * std::pow(rock.vp, 4) * distance);
}

/// From 0.7 to 1.5 S wavelengths away, in the near field and beyond.
const std::vector<Point<3>> receivers = {{41, 27, 33}, {7, 11, 117}, {103, 61, 22}, {71, 77, 82}};

/// Of what `count` components record at a receiver, all of them together: relative L2 error of the solution
/// over its images.
template <class Exact>
double error_at(const Gather& gather, std::size_t receiver, std::size_t first, std::size_t count,
                double images, Exact&& exact) {
  std::vector<double> found, wanted;
  for (std::size_t component = first; component < first + count; ++component) {
    const auto& samples = gather.traces[component * receivers.size() + receiver].samples;
    for (std::size_t n = 0; n < samples.size(); ++n) {
      found.push_back(samples[n] / images);
      wanted.push_back(exact(component, double(n) * interval_s));
    }
  }
  return relative_error(found, wanted);
}

// Proves (E3).
TEST(CubeFullSpace, ExplosionMovesAndPressesTheRockAsInTheClosedForm) {
  // Nothing is back from the far edges before the last sample.
  const std::int64_t n = 62;
  auto scene = scene_of(uniform_cube({n, n, n}, spacing_m, rock), edges_all_3d(EdgeLaw::mirror), {0, 0, 0},
                        "explosion", "ricker:40", receivers,
                        {Component::vx, Component::vy, Component::vz, Component::p}, 0.1, interval_s);
  scene.numerics.order = 7;
  scene.numerics.cfl = 0.6;
  check(scene);
  const auto gather = shoot(scene, 1);
  for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver) {
    const auto& r = receivers[receiver];
    const double distance = std::hypot(r[0], r[1], r[2]);
    EXPECT_LT(error_at(gather, receiver, 0, 3, 8,
                       [&](std::size_t axis, double t) {
                         return r[axis] / distance * explosion_velocity(distance, t);
                       }),
              0.01)
        << "velocity of receiver " << receiver;
    EXPECT_LT(error_at(gather, receiver, 3, 1, 8,
                       [&](std::size_t, double t) { return explosion_pressure(distance, t); }),
              0.02)
        << "pressure of receiver " << receiver;
  }
}

// Proves (A8).
TEST(CubeFullSpace, NearFieldOfAnExplosionStandsTenCellsAway) {
  // The edges beyond absorb. P waves are 50 cells long.
  auto edges = edges_all_3d(EdgeLaw::mirror);
  for (int axis = 0; axis < 3; ++axis) edges[axis][1] = EdgeLaw::absorbing;
  const std::vector<Point<3>> places = {{50, 0, 0}, {2, 3, 50}, {36, 4, 35}, {29, 29, 29}};
  auto scene = scene_of(uniform_cube({16, 16, 16}, spacing_m, rock), edges, {0, 0, 0}, "explosion",
                        "ricker:18", places, {Component::vx, Component::vy, Component::vz}, 0.17, interval_s);
  check(scene);
  const auto gather = shoot(scene, 1);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto& r = places[n];
    const double distance = std::hypot(r[0], r[1], r[2]);
    EXPECT_LT(error_at(gather, n, 0, 3, 8,
                       [&](std::size_t axis, double t) {
                         return r[axis] / distance * explosion_velocity(distance, t, {18});
                       }),
              0.035)
        << "receiver " << n;
  }
}

// The axes are alike (SweepsOfACube.AreAlikeAlongAllAxes): the short form checks one.
// Proves (E3).
TEST(CubeFullSpace, ForcesAlongAllAxesMoveTheRockAsInTheClosedForm) {
  const char* const forces[] = {"force:1,0,0", "force:0,1,0", "force:0,0,1"};
  const bool all = long_form();
  for (int axis = all ? 0 : 1; axis < (all ? 3 : 2); ++axis) {
    const std::int64_t n = 40;
    Index<3> shape = {n, n, n};
    Point<3> origin{};
    shape[std::size_t(axis)] = 2 * n;  // across the force there are planes of symmetry, along it not
    origin[std::size_t(axis)] = -double(n) * spacing_m;
    auto edges = edges_all_3d(EdgeLaw::absorbing);
    for (int other = 0; other < 3; ++other)
      if (other != axis) edges[other][0] = EdgeLaw::mirror;
    auto scene =
        scene_of(uniform_cube(shape, spacing_m, rock, origin), edges, {0, 0, 0}, forces[axis], "ricker:30",
                 receivers, {Component::vx, Component::vy, Component::vz}, 0.13, interval_s);
    scene.numerics.order = 7;
    scene.numerics.zone_cells = 12;
    scene.numerics.cfl = 0.6;
    check(scene);
    const auto gather = shoot(scene, 1);
    for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver)
      EXPECT_LT(error_at(gather, receiver, 0, 3, 4,
                         [&](std::size_t component, double t) {
                           return force_velocity(receivers[receiver], axis, int(component), t);
                         }),
                0.02)
          << "velocity of receiver " << receiver << ", " << forces[axis];
  }
}

}  // namespace
}  // namespace slipwave::solver::cube_full_space_test
