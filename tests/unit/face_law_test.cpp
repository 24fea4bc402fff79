// SPDX-License-Identifier: BSD-3-Clause
// The law of a plane on a face, against its equations in ten thousand small steps (docs/theory/fractures.md,
// (S40) to (S43)).
#include "fracture/face_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace slipwave::face_law_test {
namespace {

constexpr int small_steps = 10000;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A sweep in small steps, each of them implicit in the traction t: spring t' C + jump' = welded - t, and
/// what the plane makes of it. `jump_of` gives the slip or opening of a step for a traction before it moves.
struct Found {
  double mean = 0, end = 0, moved = 0;
};

/// The slip of a small step: the excess over the strength, by the length of the slip so far, that viscosity
/// and what holds the tip do not carry.
Found slide_slowly(const FaceLoad& load, double slip, const std::function<double(double)>& strength_after,
                   double drag) {
  double path = 0;
  const double dt = 1. / small_steps, compliance = load.relaxation == infinite ? 0 : 1 / load.relaxation;
  Found found{0, load.before, 0};
  for (int n = 0; n < small_steps; ++n) {
    // Of a slip d in the step: (C/dt + 1) t = welded + C/dt t_0 - d/dt.
    const double a = compliance / dt + 1;
    const double stuck = (load.welded + compliance / dt * found.end) / a;
    const double excess = stuck - load.held * (slip + found.moved);
    const double strength = strength_after(path);
    double d = 0;
    if (std::abs(excess) > strength)
      d = (excess - std::copysign(strength, excess)) / (1 / (a * dt) + load.held + drag / dt);
    found.end = stuck - d / (a * dt);
    found.moved += d;
    path += std::abs(d);
    found.mean += found.end * dt;
  }
  return found;
}
Found slide_slowly(const FaceLoad& load, double slip, double strength, double drag) {
  return slide_slowly(
      load, slip, [strength](double) { return strength; }, drag);
}

Found part_slowly(const FaceLoad& load, double opening) {
  const double dt = 1. / small_steps, compliance = load.relaxation == infinite ? 0 : 1 / load.relaxation;
  Found found{0, load.before, 0};
  for (int n = 0; n < small_steps; ++n) {
    const double a = compliance / dt + 1;
    const double shut = (load.welded + compliance / dt * found.end) / a;
    const double gap = opening + found.moved;
    // With an opening g of the end, t = held g, or shut with t below zero.
    const double wide = (shut + gap / (a * dt)) / (load.held + 1 / (a * dt));
    const double now = std::max(wide, 0.);
    found.end = shut - (now - gap) / (a * dt);
    found.moved += now - gap;
    found.mean += found.end * dt;
  }
  return found;
}

void expect_same(const FaceMotion& exact, const Found& found, double size) {
  EXPECT_NEAR(exact.mean, found.mean, 2e-3 * size);
  EXPECT_NEAR(exact.end, found.end, 2e-3 * size);
  EXPECT_NEAR(exact.moved, found.moved, 2e-3 * size);
}

/// Loads of about 1, softer and stiffer springs, or none.
class Draw {
 public:
  double size(double most = 2) { return std::uniform_real_distribution<double>(-most, most)(engine_); }
  double above_zero() { return std::exp(size(2.5)); }
  bool coin() { return engine_() % 2 == 0; }

 private:
  std::mt19937 engine_{7};
};

// Proves (S40).
TEST(SlidingFace, FollowsItsEquationsThroughSticksAndSlides) {
  Draw draw;
  for (int n = 0; n < 300; ++n) {
    FaceLoad load{draw.size(), draw.size(), draw.coin() ? draw.above_zero() : infinite,
                  draw.coin() ? draw.above_zero() : 0};
    const double strength = n % 10 == 0 ? 0 : std::abs(draw.size(1));
    // What both springs, viscosity and a tip do together is of first order in the sweep.
    const double drag = load.relaxation < infinite && load.held > 0 ? 0 : draw.coin() ? draw.above_zero() : 0;
    const double slip = load.held > 0 ? draw.size(0.3) : 0;
    SCOPED_TRACE(::testing::Message()
                 << n << ": " << load.welded << ' ' << load.before << ' ' << load.relaxation << ' '
                 << load.held << ' ' << strength << ' ' << drag << ' ' << slip);
    expect_same(slide_face(load, slip, strength, drag), slide_slowly(load, slip, strength, drag), 2);
  }
}

// Proves (S42).
TEST(SlidingFace, AtATipWithSpringAndViscosityConvergesAsSweepsGetShort) {
  const FaceLoad load{1.5, 0.2, 0.02, 0.03};
  const double strength = 0.1, drag = 0.5, slip = 0.1;
  const auto wanted = slide_slowly(load, slip, strength, drag);
  const auto error_of = [&](int parts) {
    // The units are those of a sweep: of a shorter one springs are softer and slip is more.
    double traction = load.before, moved = 0;
    for (int n = 0; n < parts; ++n) {
      const auto motion = slide_face({load.welded, traction, load.relaxation / parts, load.held / parts},
                                     (slip + moved) * parts, strength, drag);
      traction = motion.end, moved += motion.moved / parts;
    }
    return std::abs(traction - wanted.end) + std::abs(moved - wanted.moved);
  };
  EXPECT_LT(error_of(1), 0.1 * wanted.moved);
  EXPECT_LT(error_of(10), 0.15 * error_of(1));
}

// Proves (S41).
TEST(SlidingFace, WithoutStrengthIsFreeAndWithALotOfItWelded) {
  EXPECT_EQ(slide_face({3, 1, infinite, 0}, 0, 0, 0).mean, 0);
  EXPECT_EQ(slide_face({3, 1, infinite, 0}, 0, 1e12, 1e12).mean, 3);
  const FaceLoad spring{3, 1, 0.7, 0};
  EXPECT_EQ(slide_face(spring, 0, 1e12, 0).mean, give_face(spring).mean);
  EXPECT_EQ(slide_face(spring, 0, 1e12, 5).mean, give_face(spring).mean);
  EXPECT_NEAR(slide_face(spring, 0, 0, 0).mean, 0, 1e-15);
}

TEST(SlidingFace, WithoutStrengthSlidesOnWhateverRoundingLeavesOfItsTraction) {
  // Held by a tip behind a spring its traction is that of the tip, a little more or less of it.
  Draw draw;
  for (int n = 0; n < 300; ++n) {
    const double held = draw.above_zero(), slip = draw.size(0.3), off = draw.size(1e-15);
    const FaceLoad load{draw.size(), held * slip * (1 + off), draw.above_zero(), held};
    const auto motion = slide_face(load, slip, 0, 0);
    EXPECT_TRUE(motion.loose) << n;
    EXPECT_NEAR(motion.end, held * (slip + motion.moved), 1e-12) << n;
  }
}

TEST(SlidingFace, ThatSticksHasNotMovedAtAll) {
  Draw draw;
  for (int n = 0; n < 300; ++n) {
    const FaceLoad load{draw.size(), draw.size(), draw.above_zero(), 0};
    for (const double drag : {0., 0.5}) EXPECT_EQ(slide_face(load, 0, 3, drag).moved, 0);
  }
}

/// Friction that falls from q to a share of that over a slip, at a pressure of 1 where Z is 1.
struct Weak {
  FaceLaw law;
  FaceMotion pressed{-1, -1, 0, false};

  Weak(double strength, double share, double distance_m) {
    law.friction_law = FrictionLaw::slip_weakening;
    law.friction = {strength, 0, (1 - share) * strength, 1 / distance_m};
  }
  double strength_after(double path_m) const { return law.friction.friction - drop(path_m); }
  double drop(double path_m) const {
    return law.friction.friction_drop * std::min(path_m * law.friction.per_distance, 1.);
  }
  /// The same load over so many sweeps.
  Found in_sweeps(const FaceLoad& load, int sweeps) const {
    Found found{0, load.before, 0};
    double path_m = 0;
    for (int n = 0; n < sweeps; ++n) {
      const auto motion =
          slide_face(law, {load.welded, found.end, load.relaxation / sweeps, load.held / sweeps}, pressed,
                     {found.moved * sweeps, path_m, 1. / sweeps, 1});
      found.mean += motion.mean / sweeps;
      found.end = motion.end;
      found.moved += motion.moved / sweeps, path_m += std::abs(motion.moved) / sweeps;
    }
    return found;
  }
};

// Proves (S43).
TEST(SlidingFace, NeverGivesWavesEnergy) {
  // The jump of a sweep times the traction, less what the spring and the tip gain.
  Draw draw;
  for (int n = 0; n < 2000; ++n) {
    FaceLoad load{draw.size(), draw.size(), draw.coin() ? draw.above_zero() : infinite,
                  draw.coin() ? draw.above_zero() : 0};
    const double strength = std::abs(draw.size(1)), drag = draw.coin() ? draw.above_zero() : 0;
    const double slip = load.held > 0 ? draw.size(0.3) : 0;
    // At a strength that stays, and at one that falls fast or slowly with slip.
    Weak weak(strength, std::abs(draw.size(1)), 1e-3 * draw.above_zero());
    weak.law.viscosity_s_m = strength > 0 ? drag / strength : 0;
    const auto motion =
        draw.coin() ? slide_face(load, slip, strength, drag)
                    : slide_face(weak.law, load, weak.pressed, {slip, std::abs(draw.size(1e-3)), 1e-3, 1});
    const double compliance = 1 / load.relaxation;
    const double springs = compliance * (motion.end * motion.end - load.before * load.before) / 2;
    const double tip = load.held * motion.moved * (2 * slip + motion.moved) / 2;
    if (load.relaxation == infinite) {
      EXPECT_GE((motion.mean - load.held * (slip + motion.moved / 2)) * motion.moved, -1e-12);
    } else {
      // Work of the face: the integral of t (welded - t), at most that of the mean.
      EXPECT_LE(springs + tip, motion.mean * (load.welded - motion.mean) + 1e-9) << n;
    }
  }
}

// Proves (S17), (S44).
TEST(WeakeningFace, SlipsExponentiallyWithSecondOrderInTheSweep) {
  // u' = w - S + (S - S_d)/D_c u under a load that stays.
  const double load = 1.3, strength = 1, share = 0.2, distance_m = 0.4,
               rate = (1 - share) * strength / distance_m;
  const Weak weak(strength, share, distance_m);
  const double time = 0.3;
  const double exact = (load - strength) / rate * std::expm1(rate * time);
  ASSERT_LT(exact, distance_m);
  for (const int sweeps : {4, 8, 16}) {
    double slip = 0;
    for (int n = 0; n < sweeps; ++n)
      slip += slide_face(weak.law, {load, load, infinite, 0}, weak.pressed,
                         {slip * sweeps / time, slip, time / sweeps, 1})
                  .moved *
              time / sweeps;
    // What the midpoint rule leaves.
    const double pace = rate * time / sweeps,
                 left = (load - strength) * time * std::exp(rate * time) * pace * pace / 12;
    EXPECT_NEAR(std::abs(slip - exact), left, 0.05 * left) << sweeps;
  }
}

// Proves (S40), (S44).
TEST(WeakeningFace, FollowsItsEquationsAsSweepsGetShort) {
  Draw draw;
  double coarse = 0, fine = 0;
  for (int n = 0; n < 200; ++n) {
    const double strength = std::abs(draw.size(1)), share = std::abs(draw.size(1));
    const FaceLoad load{draw.size(), draw.size(strength), draw.coin() ? draw.above_zero() : infinite,
                        draw.coin() ? draw.above_zero() : 0};
    // Behind a softer spring it snaps.
    const double compliance = 1 / load.relaxation,
                 distance_m = (1 - share) * strength * (0.3 + 2 * compliance);
    const Weak weak(strength, share, distance_m);
    const auto wanted = slide_slowly(
        load, 0, [&](double path_m) { return weak.strength_after(path_m); }, 0);
    SCOPED_TRACE(n);
    const auto found = weak.in_sweeps(load, 640);
    expect_same({found.mean, found.end, found.moved, false}, wanted, 2);
    coarse += std::abs(weak.in_sweeps(load, 10).moved - wanted.moved);
    fine += std::abs(weak.in_sweeps(load, 40).moved - wanted.moved);
  }
  EXPECT_LT(fine, coarse / 3);
}

// Proves (S44).
TEST(WeakeningFace, FallsToDynamicFrictionAtOnceBehindASoftSpringOrInALongSweep) {
  for (const double relaxation : {infinite, 1.}) {
    const Weak weak(1, 0.2, 1e-3);
    EXPECT_NEAR(slide_face(weak.law, {1.1, 1, relaxation, 0}, weak.pressed, {0, 0, 1, 1}).end, 0.2, 1e-12);
  }
}

// Proves (S17).
TEST(WeakeningFace, WithoutADropOrOverAnEndlessDistanceIsCoulombToTheBit) {
  Draw draw;
  for (int n = 0; n < 300; ++n) {
    const FaceLoad load{draw.size(), draw.size(), draw.coin() ? draw.above_zero() : infinite,
                        draw.coin() ? draw.above_zero() : 0};
    const FaceMotion across{draw.size(), 0, 0, draw.coin()};
    const FaceSlip so_far{draw.size(0.3), 1e-3, 1e-6, 1};
    FaceLaw law;
    law.friction_law = FrictionLaw::coulomb;
    law.friction = {std::abs(draw.size()), std::abs(draw.size(0.1))};
    law.viscosity_s_m = draw.coin() ? draw.above_zero() : 0;
    const auto coulomb = slide_face(law, load, across, so_far);
    law.friction_law = FrictionLaw::slip_weakening;
    for (const auto& [drop, per_distance] : {std::pair{0., 1e3}, {0.5 * law.friction.friction, 0.}}) {
      law.friction.friction_drop = drop, law.friction.per_distance = per_distance;
      const auto weak = slide_face(law, load, across, so_far);
      EXPECT_EQ(weak.mean, coulomb.mean);
      EXPECT_EQ(weak.end, coulomb.end);
      EXPECT_EQ(weak.moved, coulomb.moved);
      EXPECT_EQ(weak.loose, coulomb.loose);
    }
  }
}

// Proves (S40).
TEST(PartingFace, FollowsItsEquationsAsItOpensAndShuts) {
  Draw draw;
  for (int n = 0; n < 300; ++n) {
    const bool spring = draw.coin(), tip = draw.coin(), open = draw.coin();
    FaceLoad load{draw.size(), 0, spring ? draw.above_zero() : infinite, tip ? draw.above_zero() : 0};
    const double opening = open ? std::abs(draw.size(0.5)) : 0;
    load.before = open ? load.held * opening : -std::abs(draw.size());
    SCOPED_TRACE(::testing::Message() << n << ": " << load.welded << ' ' << load.before << ' '
                                      << load.relaxation << ' ' << load.held << ' ' << opening);
    expect_same(part_face(load, opening), part_slowly(load, opening), 2);
  }
}

// Proves (S41).
TEST(PartingFace, CarriesPressureAndNoTension) {
  EXPECT_EQ(part_face({-3, 0, infinite, 0}, 0).mean, -3);
  const auto open = part_face({2, 0, infinite, 0}, 0);
  EXPECT_EQ(open.mean, 0);
  EXPECT_EQ(open.moved, 2);
  EXPECT_TRUE(open.loose);
  const auto shut = part_face({-3, 0, infinite, 0}, 1);
  EXPECT_NEAR(shut.mean, -2, 1e-12);
  EXPECT_EQ(shut.moved, -1);
  EXPECT_FALSE(shut.loose);
}

}  // namespace
}  // namespace slipwave::face_law_test
