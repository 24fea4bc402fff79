// SPDX-License-Identifier: BSD-3-Clause
// Single fractures, lines that cells beside them share, against boundary elements (docs/theory.md (S30)).
#include <gtest/gtest.h>

#include <complex>
#include <cstdlib>
#include <map>
#include <numbers>

#include "lab.hpp"
#include "line_fractures.hpp"
#include "model/single_fracture.hpp"
#include "samples.hpp"
#include "scene_of_faces.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::single_fracture_test {
namespace {

using Complex = std::complex<double>;
constexpr Rock rock{4500, 2250, 2500};
constexpr double pi = std::numbers::pi, slow_m = 75;  // of S waves at the peak
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Curve {
  FractureTrace<2> trace;
  double z_n, z_t;
  bool on_faces = false;
};
constexpr double middle = 450;
const Point<2> source{250, 200};

/// With so many cells in a wavelength of S waves at the peak.
Scene<2> scene_with(const std::vector<Curve>& curves, int cells) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(12 * cells, 12 * cells, slow_m / cells, rock);
  for (const auto& [trace, z_n, z_t, on_faces] : curves) {
    SlipSystem<2> system{normal_between_tips(trace), 0, 0, 0, false, FrictionLaw::none};
    system.compliance = {z_n, z_t, 0, 0, 0};
    add_single_fractures(scene.model, {"one", {system}, {trace}, on_faces});
  }
  scene.survey.sources = {{source, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e6}};
  for (double at = -225; at <= 225; at += 75)
    for (const double side : {-225., 225.})
      for (const Point<2> place :
           {Point<2>{middle + at, middle + side}, Point<2>{middle + side, middle + at}})
        scene.survey.receivers_m.push_back(place);
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.order = 7;
  scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
  return scene;
}

Complex spectrum(const std::vector<double>& samples, double omega) {
  Complex sum = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    sum += samples[n] * std::polar(1., omega * double(n) * 0.001);
  return sum * 0.001;
}

void add_to(LineFractures& exact, const Curve& curve) {
  const auto& trace = curve.trace;
  for (std::size_t n = 1; n < trace.size(); ++n) {
    auto from = trace[n - 1], to = trace[n];
    const double elements_a_wavelength = curve.on_faces ? 40 : 30;
    const int count = std::max(1, int(length_of({from, to}) * elements_a_wavelength / slow_m));
    // A crack of elements is longer by a quarter of one at each tip (LineFractures.*Griffith*).
    const double share = std::isinf(curve.z_n) ? 0.25 / (count + 0.5) : 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double all = to[axis] - from[axis];
      from[axis] += share * all, to[axis] -= share * all;
    }
    exact.add(from, to, count, {curve.z_n, curve.z_t});
  }
}

/// Of what the fractures scatter, all receivers and both components, at 20, 30 and 40 Hz.
double error_of(const std::vector<Curve>& curves, int cells = 16) {
  const auto scene = scene_with(curves, cells);
  static std::map<int, Gather> intact;
  if (!intact.contains(cells)) intact[cells] = shoot(scene_with({}, cells), 1);
  const auto with = shoot(scene, 1), &without = intact[cells];
  double off = 0, all = 0;
  for (const double hz : {20., 30., 40.}) {
    const double omega = 2 * pi * hz;
    LineFractures exact(rock, omega);
    for (const auto& curve : curves) add_to(exact, curve);
    const auto u = exact.scattered(source, scene.survey.receivers_m);
    // Velocity of an explosion of the moment rate w is the displacement of one of the moment w.
    std::vector<double> wavelet;
    for (int n = 0; n < 200; ++n) wavelet.push_back(scene.survey.sources[0].wavelet(n * 0.001));
    const Complex strength = 1e6 * spectrum(wavelet, omega);
    const auto count = u.size();
    for (std::size_t n = 0; n < 2 * count; ++n) {
      const auto found = spectrum(with.traces[n].samples, omega) - spectrum(without.traces[n].samples, omega);
      const auto wanted = strength * u[n % count][n / count];
      off += std::norm(found - wanted);
      all += std::norm(wanted);
    }
  }
  return std::sqrt(off / all);
}

/// 150 m long: two wavelengths of S waves.
FractureTrace<2> line(double dip_deg, const Point<2>& centre = {middle, middle}) {
  const double c = 75 * std::cos(dip_deg * pi / 180), s = 75 * std::sin(dip_deg * pi / 180);
  return {{centre[0] - c, centre[1] - s}, {centre[0] + c, centre[1] + s}};
}
/// A quarter of a circle.
FractureTrace<2> arc() {
  FractureTrace<2> all;
  for (int n = 0; n <= 24; ++n) {
    const double angle = pi / 4 + n * pi / 48;
    all.push_back({middle + 95 * std::cos(angle), middle + 67 - 95 * std::sin(angle)});
  }
  return all;
}

TEST(LineFractures, OpenAsGriffithsCrackDoes) {
  // The jump is 2 (1 - nu)/mu sqrt(a^2 - x^2) times the traction, for tension as for shear.
  LineFractures crack(rock, 2 * pi * 0.1);
  const int count = 80;
  crack.add({-100, 0}, {100, 0}, count, {infinite, infinite});
  const double nu = rock.lambda() / (2 * (rock.lambda() + rock.mu()));
  const auto jumps = crack.jumps_under({1, 1});
  double along = 0, across = 0, wanted = 0;
  for (int n = 0; n < count; ++n) {
    const double x = -100 + (n + 0.5) * 200 / count;
    along += jumps[std::size_t(n)][0].real(), across += jumps[std::size_t(n)][1].real();
    wanted += 2 * (1 - nu) / rock.mu() * std::sqrt(1e4 - x * x);
  }
  EXPECT_NEAR(along / wanted, 1, 0.02);
  EXPECT_NEAR(across / wanted, 1, 0.02);
}

// Proves (S30).
TEST(SingleFracture, ScattersAsBoundaryElementsSay) {
  // At any angle, wherever it lies among the cells; curved ones, and two that cross.
  const double z = 1e-10, h = slow_m / 16;
  EXPECT_LT(error_of({{line(0), z, z}}), 0.03);
  EXPECT_LT(error_of({{line(0, {middle + h / 3, middle + h / 2}), z, z}}), 0.03);
  EXPECT_LT(error_of({{line(30), z, z / 2}}), 0.03);
  EXPECT_LT(error_of({{arc(), z, z}}), 0.03);
  EXPECT_LT(error_of({{line(30), z, z}, {line(-60, {middle + 10, middle + 15}), z, z}}), 0.03);
}

// Proves (S36), (S37).
TEST(FractureOnFaces, ScattersAsBoundaryElementsSayWhenItIsOpen) {
  // Wherever its tips lie among the faces.
  const double h = slow_m / 16;
  EXPECT_LT(error_of({{line(0), infinite, infinite, true}}), 0.03);
  EXPECT_LT(error_of({{line(90), infinite, infinite, true}}), 0.03);
  EXPECT_LT(error_of({{line(0, {middle + h / 2, middle}), infinite, infinite, true}}), 0.03);
  EXPECT_LT(error_of({{line(90, {middle, middle + h / 4}), 1e-9, 1e-9, true}}), 0.03);
}

// Proves (S35), (S36).
TEST(FractureOnFaces, IsNothingWhereItIsStiffAsRock) {
  // What is left falls with the compliance.
  const auto scattered = [](double z) {
    const auto with = shoot(scene_with({{line(0), z, z, true}}, 8), 1), without = shoot(scene_with({}, 8), 1);
    double off = 0, all = 0;
    for (std::size_t n = 0; n < with.traces.size(); ++n)
      for (std::size_t k = 0; k < with.traces[n].samples.size(); ++k) {
        off = std::max(off, std::abs(double(with.traces[n].samples[k]) - without.traces[n].samples[k]));
        all = std::max(all, std::abs(double(without.traces[n].samples[k])));
      }
    return off / all;
  };
  const double stiff = scattered(1e-12);
  EXPECT_LT(stiff, 5e-3);
  EXPECT_LT(scattered(1e-16), 1e-3);
  EXPECT_GT(scattered(1e-10), 5 * stiff);
}

/// Points within two cells of a fracture read and act on their own side of it: as in cells of a third. Sweeps
/// across an upright one end a step, and what half of one leaves lies off.
// Proves (S36).
TEST(FractureOnFaces, IsFeltOnTheirOwnSideByPointsBesideIt) {
  for (const double dip : {0., 90.})
    for (const char* const mechanism : {"explosion", "force:0.4,1"}) {
      std::vector<std::vector<double>> found;
      for (const int cells : {20, 60}) {
        auto scene = scene_with({{line(dip), 1e-10, 2e-10, true}}, cells);
        const auto place = [&](double along, double off_cells) {
          const double off_m = off_cells * slow_m / 20;
          return dip == 0 ? Point<2>{middle + along, middle + off_m}
                          : Point<2>{middle + off_m, middle + along};
        };
        scene.survey.sources[0].position_m = place(-30, -0.7);
        scene.survey.sources[0].mechanism = parse_mechanism<2>(mechanism);
        scene.survey.receivers_m.clear();
        for (const double off_cells : {-1.2, 0.8, 1.6})
          scene.survey.receivers_m.push_back(place(30, off_cells));
        scene.recording.duration_s = 0.15;
        found.push_back(samples_of(shoot(scene, 1)));
      }
      EXPECT_LT(relative_error(found[0], found[1]), dip == 0 ? 0.01 : 0.03) << dip << ", " << mechanism;
    }
}

// The table of docs/slip.md.
TEST(FractureOnFaces, ErrsLessTheSofterItIsAndInSmallCellsLong) {
  const double h = slow_m / 16;
  for (const double z : {1e-10, 3e-10, 1e-9, 1e-8, infinite}) {
    const double level = error_of({{line(0), z, z, true}}), upright = error_of({{line(90), z, z, true}}),
                 quarter = error_of({{line(0, {middle + h / 4, middle}), z, z, true}}),
                 half = error_of({{line(0, {middle + h / 2, middle}), z, z, true}}),
                 finer = error_of({{line(0), z, z, true}}, 32);
    std::printf("%g m/Pa: %.1f %.1f, tips by a quarter and half a cell %.1f %.1f, 32 cells %.1f %%\n", z,
                100 * level, 100 * upright, 100 * quarter, 100 * half, 100 * finer);
    const double most = z < 2e-10 ? 0.05 : 0.03;
    for (const double error : {level, upright, quarter, half}) EXPECT_LT(error, most);
    EXPECT_LT(finer, 0.8 * level);
  }
}

// The table of docs/slip.md.
TEST(SingleFracture, ErrsMoreTheSofterItIsAndLessInSmallCellsLong) {
  for (const double z : {1e-11, 1e-10, 3e-10, 1e-9, 1e-8}) {
    std::printf("%g m/Pa:", z);
    for (const double dip : {0., 30., 90.}) {
      const double error = error_of({{line(dip), z, z}});
      std::printf(" %.1f", 100 * error);
      EXPECT_LT(error, z <= 1e-10 ? 0.03 : z <= 3e-10 ? 0.045 : z <= 1e-9 ? 0.08 : 0.35);
      if (dip != 30) continue;
      const double finer = error_of({{line(dip), z, z}}, 32);
      std::printf(" (%.1f)", 100 * finer);
      EXPECT_LT(finer, 0.6 * error);
    }
    std::printf(" %%\n");
  }
}

TEST(FractureOnFaces, IsTheSameInSingleAndDoublePrecision) { expect_same_in_double_precision(cracked()); }

}  // namespace
}  // namespace slipwave::solver::single_fracture_test
