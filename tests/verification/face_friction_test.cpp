// SPDX-License-Identifier: BSD-3-Clause
// Planes with friction on faces between cells under plane waves, against closed forms and equations solved in
// small steps (docs/theory/fractures.md, (S40) to (S43)).
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "lab.hpp"

namespace slipwave::solver::face_friction_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};
constexpr double pi = std::numbers::pi, depth_m = 1200, face_m = 600, long_m = 240;
using L = Lab<double>;

/// Traction of one period of a wave of that largest size, within a second from 0 to 1.
double period(double peak, double at) {
  if (at <= 0 || at >= 1) return 0;
  return peak / 1.299 * std::sin(2 * pi * at) * (1 - std::cos(2 * pi * at));
}

/// The mean size of it over the largest.
constexpr double mean_of_period = 0.49;

/// A wave straight onto a face: of shear (pair 1) or of pressure (pair 0).
struct Case {
  std::size_t pair = 1;
  SplitFace<2> face;
  double peak_pa = 1e5;
  Rock below = rock;
  int order = 5;
  double h = 5, courant = 0.9;  // of P waves
};

double speed_of(const Rock& of, std::size_t pair) { return pair == 0 ? of.vp : of.vs; }
double impedance_of(const Rock& of, std::size_t pair) { return of.rho * speed_of(of, pair); }
/// Traction of the incident wave at the face.
double incident(const Case& of, double time_s) {
  return period(of.peak_pa, time_s * speed_of(rock, of.pair) / long_m);
}
/// What the face would carry if it were welded, prestress included.
double welded(const Case& of, double time_s) {
  const double z = impedance_of(rock, of.pair), z_below = impedance_of(of.below, of.pair);
  return 2 * z_below / (z + z_below) * incident(of, time_s) + of.face.law.prestress_pa[of.pair];
}
/// Z of both sides together (S35).
double both(const Case& of) {
  return 1 / (1 / impedance_of(rock, of.pair) + 1 / impedance_of(of.below, of.pair));
}

/// Tractions of the waves down below the face and up above it, 20 m away.
struct Waves {
  std::vector<double> times_s, down, up;
  double heat_j_m2 = 0, out_of_waves_j_m2 = 0;
};
double way_m(const Case& of) { return (double(std::int64_t(20 / of.h)) - 0.5) * of.h; }

Waves solved(const Case& of) {
  const auto behind = std::int64_t(face_m / of.h), cells = std::int64_t(depth_m / of.h);
  auto medium = uniform_medium(2, cells, of.h, rock);
  std::vector<SplitFace<2>> faces;
  for (const std::int64_t i : {0, 1}) {
    for (auto k = behind; k < cells; ++k) put(medium, {i, k}, of.below);
    faces.push_back(of.face);
    faces.back().axis = 1, faces.back().behind = {i, behind};
  }
  const double dt_s = of.courant * of.h / std::max(rock.vp, of.below.vp);
  L lab(medium, edges_all(EdgeLaw::rigid), of.order, dt_s, 2, faces);
  const bool pressure = of.pair == 0;
  const auto velocity = pressure ? L::vz : L::vx, traction = pressure ? L::szz : L::sxz;
  const double c = speed_of(rock, of.pair), z = impedance_of(rock, of.pair);
  const double early_s = 60 / c;  // before it arrives
  for (std::int64_t k = 0; k < behind; ++k)
    for (const std::int64_t i : {0, 1}) {
      const double s = incident(of, (face_m - lab.grid().centre(1, k)) / c - early_s);
      lab(traction, i, k) = s;
      if (pressure) lab(L::sxx, i, k) = (1 - 2 * std::pow(rock.vs / rock.vp, 2)) * s;
      lab(velocity, i, k) = -s / z;
    }
  const auto away = std::int64_t(20 / of.h);
  const double z_below = impedance_of(of.below, of.pair);
  const double end_s = (long_m + 120) / c + 20 / std::min(c, speed_of(of.below, of.pair));
  Waves waves;
  for (std::int64_t n = 0; double(n) * dt_s < end_s; ++n) {
    waves.times_s.push_back(double(n) * dt_s - early_s);
    const auto below = behind + away - 1, above = behind - away;
    waves.down.push_back((lab(traction, 0, below) - z_below * lab(velocity, 0, below)) / 2);
    waves.up.push_back((lab(traction, 0, above) + z * lab(velocity, 0, above)) / 2);
    lab.sweep(1, 1);
  }
  ShotReport report;
  lab.split()->report(report);
  const auto slip = report.slip.value_or(SlipTotals{});
  waves.heat_j_m2 = slip.dissipated / (2 * of.h), waves.out_of_waves_j_m2 = slip.out_of_waves / (2 * of.h);
  return waves;
}

/// L2 error of the waves that leave the face, where it has that traction, over the incident wave.
double error_of(const Case& of, const std::function<double(double)>& traction) {
  const auto waves = solved(of);
  double off = 0, all = 0;
  for (std::size_t n = 0; n < waves.times_s.size(); ++n) {
    const double down_s = waves.times_s[n] - way_m(of) / speed_of(of.below, of.pair),
                 up_s = waves.times_s[n] - way_m(of) / speed_of(rock, of.pair);
    const double resting = of.face.law.prestress_pa[of.pair];
    off += std::pow(waves.down[n] - (traction(down_s) - resting), 2);
    off += std::pow(waves.up[n] - (traction(up_s) - resting - incident(of, up_s)), 2);
    all += std::pow(incident(of, up_s), 2);
  }
  return std::sqrt(off / all);
}

/// The same of the momentum that the wave downwards has brought so far, the largest in time over that of the
/// incident wave in all.
double error_of_momentum(const Case& of, const std::function<double(double)>& traction) {
  const auto waves = solved(of);
  double off = 0, all = 0, most = 0;
  for (std::size_t n = 0; n < waves.times_s.size(); ++n) {
    const double at_s = waves.times_s[n] - way_m(of) / speed_of(of.below, of.pair);
    off += waves.down[n] - (traction(at_s) - of.face.law.prestress_pa[of.pair]);
    all += std::abs(incident(of, at_s));
    most = std::max(most, std::abs(off));
  }
  return most / all;
}

/// A history from the beginning of the wave on, solved in small steps; `next` gives the state after one.
template <class State, class Next>
std::function<double(double)> in_small_steps(State state, const Next& next, double end_s = 0.4) {
  constexpr double step_s = 1e-6;
  std::vector<double> values;
  for (double t = 0; t < end_s; t += step_s) {
    state = next(state, t, step_s);
    values.push_back(state.traction);
  }
  return [values, resting = values.front()](double t) {
    return t < 0 ? resting : values.at(std::size_t(t / step_s));
  };
}

SplitFace<2> sliding(double friction, double pressure_pa, double shear_pa = 0, double viscosity_s_m = 0) {
  SplitFace<2> face;
  face.law.friction_law = FrictionLaw::coulomb;
  face.law.friction.friction = friction;
  face.law.prestress_pa = {-pressure_pa, shear_pa};
  face.law.viscosity_s_m = viscosity_s_m;
  return face;
}

/// Of a wave of 48 cells a period.
constexpr double aim = 0.02;

/// Errors within the aim that fall about as the cells do: sticks and slides are met within a step.
void expect_to_converge(Case of, const std::function<double(double)>& traction) {
  const double coarse = error_of(of, traction);
  of.h /= 4;
  const double fine = error_of(of, traction);
  EXPECT_LT(coarse, aim);
  EXPECT_LT(fine, coarse / 3);
}

// Proves (S41), (S43).
TEST(FaceUnderAShearWave, CarriesItsStrengthAtMostWhereItIsDry) {
  for (const double shear : {0., 2e4, -5e4}) {
    SCOPED_TRACE(shear);
    const Case dry{1, sliding(0.5, 1e5, shear)};
    expect_to_converge(dry, [&](double t) { return std::clamp(welded(dry, t), -5e4, 5e4); });
  }
  const Case over_soft{1, sliding(0.5, 1e5), 1e5, {2500, 1200, 2000}};
  expect_to_converge(over_soft, [&](double t) { return std::clamp(welded(over_soft, t), -5e4, 5e4); });
  // Under no pressure it carries none.
  const Case loose{1, sliding(0.5, 0)};
  EXPECT_LT(error_of(loose, [](double) { return 0; }), 1e-3);
}

// Proves (S41).
TEST(FaceUnderAShearWave, CarriesWhatItsViscosityDragsBesides) {
  const double strength = 3e4;
  for (const double drag : {0.1, 1., 10.}) {
    SCOPED_TRACE(drag);
    Case slow{1, {}};
    slow.face = sliding(0.3, 1e5, 0, drag * both(slow) / strength);
    expect_to_converge(slow, [&](double t) {
      const double s = welded(slow, t);
      return std::abs(s) <= strength ? s : (std::copysign(strength, s) + drag * s) / (1 + drag);
    });
  }
}

// Proves (S44).
TEST(FaceUnderAShearWave, FollowsTheEquationsOfStrengthThatFallsWithSlip) {
  const double friction = 0.5, dynamic = 0.1, pressure = 1e5, resting = 2e4;
  for (const double distance_m : {3e-4, 2e-3})
    for (const auto& [compliance, drag] : {std::pair{0., 0.}, {1e-9, 0.}, {0., 0.5}}) {
      SCOPED_TRACE(std::to_string(distance_m * 1e3) + " mm, " + std::to_string(compliance * 1e9) +
                   " nm/Pa, drag " + std::to_string(drag));
      Case of{1, {}};
      const double z = both(of), viscosity_s_m = drag * z / (friction * pressure);
      of.face = sliding(friction, pressure, resting, viscosity_s_m);
      of.face.tangential_m_per_pa = compliance;
      of.face.law.friction_law = FrictionLaw::slip_weakening;
      of.face.law.friction.friction_drop = friction - dynamic;
      of.face.law.friction.per_distance = 1 / distance_m;
      struct State {
        double traction, path_m;
      };
      // (S40), the slip implicit at the strength of the step before.
      expect_to_converge(
          of, in_small_steps(State{resting, 0}, [&, c = compliance](State before, double t, double step_s) {
            const double w = welded(of, t + step_s);
            const double fallen = (friction - dynamic) * std::min(before.path_m / distance_m, 1.);
            const double strength = (friction - fallen) * pressure;
            const double stuck = (c / step_s * before.traction + w / z) / (c / step_s + 1 / z);
            if (std::abs(stuck) <= strength) return State{stuck, before.path_m};
            const double excess = std::abs(stuck) - strength, flows = viscosity_s_m * strength;
            const double rate = excess / (1 / (c / step_s + 1 / z) + flows);
            return State{std::copysign(strength + flows * rate, stuck), before.path_m + rate * step_s};
          }));
    }
}

// Proves (S43).
TEST(FaceUnderAShearWave, TurnsIntoHeatWhatItTakesFromTheWavesAndThePrestress) {
  const double resting = 2e4, strength = 5e4;
  const Case dry{1, sliding(0.5, 1e5, resting)};
  const auto found = solved(dry);
  double heat = 0, out_of_waves = 0;
  constexpr double step_s = 1e-6;
  for (double t = 0; t < 0.15; t += step_s) {
    const double w = welded(dry, t), carried = std::clamp(w, -strength, strength);
    const double slip = (w - carried) / both(dry) * step_s;
    heat += carried * slip, out_of_waves += (carried - resting) * slip;
  }
  EXPECT_NEAR(found.heat_j_m2, heat, aim * heat);
  EXPECT_NEAR(found.out_of_waves_j_m2, out_of_waves, aim * heat);
}

// Proves (S41).
TEST(FaceUnderAShearWave, FollowsTheEquationsOfASpringBeforeASlider) {
  for (const double compliance : {1e-10, 1e-9})
    for (const double drag : {0., 0.5}) {
      SCOPED_TRACE(std::to_string(compliance * 1e9) + " nm/Pa, drag " + std::to_string(drag));
      Case of{1, {}};
      const double strength = 3e4, z = both(of);
      of.face = sliding(0.3, 1e5, 1e4, drag * z / strength);
      of.face.tangential_m_per_pa = compliance;
      struct State {
        double traction;
      };
      // (S40), implicit in the traction.
      expect_to_converge(
          of, in_small_steps(State{1e4}, [&](State before, double t, double step_s) {
            const double c = compliance / step_s, w = welded(of, t + step_s);
            const double stuck = (c * before.traction + w / z) / (c + 1 / z);
            if (std::abs(stuck) <= strength) return State{stuck};
            const double bound = std::copysign(strength, stuck);
            if (drag == 0) return State{bound};
            return State{(c * before.traction + (w + bound / drag) / z) / (c + (1 + 1 / drag) / z)};
          }));
    }
}

// Proves (S41).
TEST(FaceUnderAPressureWave, CarriesNoTensionAndOpens) {
  for (const double pressure : {1e4, 3e4, 9e4}) {
    SCOPED_TRACE(pressure);
    Case of{0, sliding(0.5, pressure)};
    of.face.law.opens = true;
    struct State {
      double traction, gap;
    };
    const auto traction = in_small_steps(State{-pressure, 0}, [&](State before, double t, double step_s) {
      // Open, both sides leave as from free surfaces; shut, the wave passes.
      const double w = welded(of, t + step_s);
      const double gap = std::max(before.gap + w / both(of) * step_s, 0.);
      return gap > 0 ? State{0, gap} : State{std::min(w, 0.), 0};
    });
    // It shuts with a shock of the wave and the pressure at most: within a step of its time.
    for (const double h : {5., 1.25}) {
      of.h = h;
      const double step = of.courant * h / long_m, of_period = mean_of_period * of.peak_pa;
      EXPECT_LT(error_of_momentum(of, traction), step * (of.peak_pa + pressure) / of_period) << h;
    }
  }
}

// Proves (S41).
TEST(FaceUnderAPressureWave, LetsPressureThroughAndTensionBelowThePrestress) {
  Case of{0, sliding(0.5, 1.01e5)};
  of.face.law.opens = true;
  EXPECT_LT(error_of(of, [&](double t) { return welded(of, t); }), 1e-3);
}

// Proves (S43).
TEST(FaceThatSticks, IsRockThatIsWhole) {
  for (const std::size_t pair : {0, 1}) {
    Case of{pair, sliding(1, 1e6)};
    of.face.law.opens = true;
    const auto stuck = solved(of);
    of.face = {};
    of.face.law = {};
    const auto whole = solved(of);
    for (std::size_t n = 0; n < whole.down.size(); ++n) {
      EXPECT_NEAR(stuck.down[n], whole.down[n], 1e-5 * of.peak_pa);
      EXPECT_NEAR(stuck.up[n], whole.up[n], 1e-5 * of.peak_pa);
    }
  }
}

}  // namespace
}  // namespace slipwave::solver::face_friction_test
