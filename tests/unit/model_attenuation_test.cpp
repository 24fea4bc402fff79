// SPDX-License-Identifier: BSD-3-Clause
#include "rock/attenuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geology/layers.hpp"
#include "model/model.hpp"
#include "refusal.hpp"
#include "rock/averaging.hpp"
#include "rock/bulk_part.hpp"
#include "rock/relations.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave::model_attenuation_test {
namespace {

constexpr double peak_hz = 20, infinite = PropertyRow::infinite;

Medium<2> one_cell(double vp, double vs, double qp, double qs) {
  const Grid<2> grid{{1, 1}, 5, {0, 0}};
  Medium<2> medium(Field<2>(grid, float(vp)), Field<2>(grid, float(vs)), Field<2>(grid, 2000));
  medium[Property::qp] = Field<2>(grid, float(qp));
  medium[Property::qs] = Field<2>(grid, float(qs));
  return medium;
}

/// Q and phase speed over the unrelaxed one, of the sum of mechanisms itself.
struct Wave {
  double q, speed;
};
Wave wave_of(const Mechanisms& mechanisms, const RelaxedShares& shares, double hz) {
  std::complex<double> modulus = 1;
  for (int l = 0; l < mechanisms.count(); ++l)
    modulus -= shares[std::size_t(l)] /
               (1. + std::complex<double>(0, 2 * std::numbers::pi * hz) / mechanisms.rate(l));
  return {modulus.real() / modulus.imag(), 1 / (1. / std::sqrt(modulus)).real()};
}

// Proves (Q1), (Q3).
TEST(Mechanisms, GiveTheQualityWantedWithinThreePercentOverTheBand) {
  for (const int count : {3, 4, 5}) {
    const Mechanisms mechanisms(count, peak_hz / 5, 2.5 * peak_hz);
    double worst = 0;
    for (const double q : {5., 8., 20., 50., 200., 1000.}) {
      const auto shares = mechanisms.shares(q);
      for (double hz = peak_hz / 5; hz <= 2.5 * peak_hz; hz *= 1.01)
        worst = std::max(worst, std::abs(wave_of(mechanisms, shares, hz).q / q - 1));
    }
    EXPECT_LT(worst, count == 3 ? 0.03 : 0.01) << count;
    EXPECT_GT(worst, 0);
  }
}

// Steps of relaxation, as (Q7) and (Q8) take them under a strain that oscillates: stress of its frequency.
// Proves (Q8a).
TEST(Mechanisms, HaveTheModulusOfTheirStepsOfRelaxation) {
  const Mechanisms mechanisms(3, 5, 62.5);
  const auto shares = mechanisms.shares(20);
  constexpr double hz = 25, omega = 2 * std::numbers::pi * hz;
  constexpr int in_a_step = 400, steps = 2000;
  for (const double interval_s : {0.005, 0.0013}) {
    std::array<double, 3> parts{}, kept_parts{};
    double left = 1;
    for (std::size_t l = 0; l < 3; ++l) {
      const double a = mechanisms.rate(int(l)) * interval_s / 2;
      parts[l] = std::tanh(a) / a;
      left -= shares[l] * (1 - parts[l]);
    }
    for (std::size_t l = 0; l < 3; ++l) kept_parts[l] = shares[l] * parts[l] / left;
    std::array<std::complex<double>, 3> let_go{};
    std::complex<double> sum = 0;
    for (int step = 0; step < steps; ++step) {
      const double start = step * interval_s;
      for (std::size_t l = 0; l < 3; ++l)
        let_go[l] += (1 - std::exp(-mechanisms.rate(int(l)) * interval_s)) *
                     (kept_parts[l] * std::polar(1., omega * start) - let_go[l]);
      if (step < steps / 2) continue;
      for (int n = 0; n < in_a_step; ++n) {
        const double time = start + (n + 0.5) * interval_s / in_a_step;
        sum += left * (std::polar(1., omega * time) - let_go[0] - let_go[1] - let_go[2]) *
               std::polar(1., -omega * time);
      }
    }
    const auto found = sum / double(steps / 2 * in_a_step);
    const auto stated = mechanisms.stepwise_modulus(shares, hz, interval_s);
    EXPECT_LT(std::abs(found - stated), 0.05 * std::abs(found - mechanisms.modulus(shares, hz)))
        << interval_s;
    EXPECT_GT(std::abs(found - mechanisms.modulus(shares, hz)), interval_s > 0.002 ? 5e-4 : 5e-6);
  }
}

// Proves (Q2), (Q3).
TEST(Mechanisms, AreOfPositiveSharesBelowTheWholeModulus) {
  for (const int count : {2, 3, 4, 5}) {
    const Mechanisms mechanisms(count, 4, 50);
    for (double q = mechanisms.least_quality(); q < 2000; q *= 1.3) {
      const auto shares = mechanisms.shares(q);
      double sum = 0;
      for (int l = 0; l < count; ++l) {
        EXPECT_GE(shares[std::size_t(l)], 0) << count << ' ' << q;
        sum += shares[std::size_t(l)];
      }
      EXPECT_LT(sum, 1);
    }
    EXPECT_LE(mechanisms.least_quality(), count == 2 ? 8 : 5);
  }
}

// Proves (Q4).
TEST(UnrelaxedMedium, HasTheSpeedsGivenAtTheReferenceFrequency) {
  const Attenuation attenuation{Mechanisms(3, 4, 50), 13};
  auto medium = one_cell(3000, 1600, 40, 20);
  EXPECT_EQ(unrelax(medium, attenuation), "");
  const auto& mechanisms = attenuation.mechanisms;
  EXPECT_NEAR(medium.vp[0] * wave_of(mechanisms, mechanisms.shares(40), 13).speed, 3000, 0.01);
  EXPECT_NEAR(medium.vs[0] * wave_of(mechanisms, mechanisms.shares(20), 13).speed, 1600, 0.01);
  EXPECT_GT(medium.vp[0], 3000);
  // Dispersion of constant Q: c grows by ln(f2/f1)/(pi Q) (Aki & Richards 2002, eq. 5.88).
  const auto shares = mechanisms.shares(100);
  EXPECT_NEAR(wave_of(mechanisms, shares, 40).speed / wave_of(mechanisms, shares, 5).speed - 1,
              std::log(8) / (100 * std::numbers::pi), 0.0008);
}

// Proves (Q4a).
TEST(UnrelaxedMedium, HasTheSpeedsOfAConstantQOfALogAtKilohertz) {
  const Mechanisms mechanisms(3, 4, 50);
  for (const double log_hz : {0.5, 200., 1e4}) {
    auto medium = one_cell(3000, 1600, 50, 25);
    EXPECT_EQ(unrelax(medium, {mechanisms, log_hz}), "");
    for (const double hz : {5., 14., 40.}) {
      const auto lower = [&](double q) { return std::pow(hz / log_hz, std::atan(1 / q) / std::numbers::pi); };
      const double p = medium.vp[0] * wave_of(mechanisms, mechanisms.shares(50), hz).speed,
                   s = medium.vs[0] * wave_of(mechanisms, mechanisms.shares(25), hz).speed;
      EXPECT_NEAR(p / (3000 * lower(50)), 1, 6e-4) << log_hz << ' ' << hz;
      EXPECT_NEAR(s / (1600 * lower(25)), 1, 12e-4) << log_hz << ' ' << hz;
    }
  }
  EXPECT_NEAR(faster_by_constant_quality(25, 1e4, 50), 0.935, 5e-4);
}

// Proves (Q6).
TEST(UnrelaxedMedium, LosesNoLessInPWavesThanShearDoes) {
  const Attenuation attenuation{Mechanisms(3, 4, 50), 20};
  auto medium = one_cell(3000, 1500, 1000, 20);
  EXPECT_EQ(unrelax(medium, attenuation),
            "qp at x=2.5 z=2.5 is 1000, more than its qs of 20 allows: 80 is used; a lower qp or a higher qs "
            "of the model (sw-layers --layer, sw-import --qp --qs) is taken as it is");
  EXPECT_EQ(medium[Property::qp][0], 80);
  auto no_own = one_cell(3000, 1500, infinite, 20);
  EXPECT_EQ(unrelax(no_own, attenuation), "");
  EXPECT_EQ(no_own[Property::qp][0], 80);
  for (const auto& shares : {StepwiseRelaxation<2>(medium, attenuation.mechanisms, 0).shares(0)})
    for (const double share : shares.bulk) EXPECT_LT(share, 0.002);
}

// Proves (Q3).
TEST(UnrelaxedMedium, RefusesAQualityThatIsNotFitted) {
  const Attenuation attenuation{Mechanisms(3, 4, 50), 20};
  for (const bool of_p : {true, false}) {
    auto medium = one_cell(3000, 1500, of_p ? 1.5 : 5, of_p ? 50 : 1.5);
    EXPECT_NE(refusal([&] { unrelax(medium, attenuation); })
                  .find(std::string(of_p ? "qp" : "qs") +
                        " at x=2.5 z=2.5 is 1.5, too low: 3 mechanisms give Q within 3 % from "),
              std::string::npos);
  }
  EXPECT_NE(refusal([] { Mechanisms(6, 4, 50); }).find("found 6 mechanisms, expected 2 to 5"),
            std::string::npos);
  EXPECT_NE(refusal([] { Mechanisms(3, 50, 4); }).find("found a band of 50 to 4 Hz"), std::string::npos);
}

// Proves (Q5), (Q8).
TEST(StepwiseRelaxation, LeavesTheModulusAtRestAndTakesOfTheUnrelaxedOne) {
  const Mechanisms mechanisms(3, 4, 50);
  auto medium = one_cell(3000, 1600, 20, 15);
  const StepwiseRelaxation<2> always(medium, mechanisms, 0), by_steps(medium, mechanisms, 0.003);
  const auto sum = [](const RelaxedShares& shares) { return shares[0] + shares[1] + shares[2]; };
  const auto stepped = by_steps.medium();
  const double mu = std::pow(medium.vs[0], 2), mu_stepped = std::pow(stepped.vs[0], 2);
  EXPECT_LT(mu_stepped, mu);
  EXPECT_NEAR(mu_stepped * (1 - sum(by_steps.shares(0).shear)), mu * (1 - sum(always.shares(0).shear)),
              1e-6 * mu);
  const double bulk = std::pow(medium.vp[0], 2) - mu, bulk_stepped = std::pow(stepped.vp[0], 2) - mu_stepped;
  EXPECT_NEAR(bulk_stepped * (1 - sum(by_steps.shares(0).bulk)), bulk * (1 - sum(always.shares(0).bulk)),
              1e-6 * bulk);
}

/// A cell of anisotropic rock, or one that an interface cuts.
Medium<2> one_cell(const Material& rock, double qp, double qs, bool cut) {
  auto medium = one_cell(rock.vp, rock.vs, qp, qs);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(medium.grid());
  add_tilted_means(medium);
  auto isotropic = rock;
  isotropic.epsilon = isotropic.delta = isotropic.tilt = 0;
  put(medium, 0, cut ? isotropic : rock);
  if (cut) put_tilted_mean(medium, 0, rock, rock.tilt * std::numbers::pi / 180);
  return medium;
}

// Proves (Q9).
TEST(UnrelaxedMedium, HasThePhaseSpeedsOfAnisotropicRockAtTheReferenceFrequency) {
  const Attenuation attenuation{Mechanisms(3, 4, 50), 13};
  const Material rocks[] = {{3000, 1600, 2000, 0.2, 0.1, 30}, {3200, 1700, 2000, -0.05, 0.2}};
  for (const auto& rock : rocks)
    for (const bool cut : {false, true}) {
      auto medium = one_cell(rock, 60, 30, cut);
      EXPECT_EQ(unrelax(medium, attenuation), "");
      const StepwiseRelaxation<2> relaxation(medium, attenuation.mechanisms, 0);
      const auto stiffness = relaxation.stiffness(0, 13);
      for (int angle = 0; angle <= 90; angle += 15) {
        const double rad = angle * std::numbers::pi / 180;
        const auto given =
            phase_speeds<2>(upright_elasticity<2>(rock), rock.rho, {std::sin(rad), std::cos(rad)});
        const auto found = lossy_waves(stiffness, rock.rho, rad);
        EXPECT_NEAR(found.speed.p, given[0], 2e-4 * given[0]) << angle;
        EXPECT_NEAR(found.speed.s, given[1], 2e-4 * given[1]) << angle;
        // Along and across the beds Q is what is given, in between not far off.
        const bool axis = angle % 90 == 0;
        EXPECT_NEAR(found.quality.p, 60, axis ? 0.5 : 7) << angle;
        EXPECT_NEAR(found.quality.s, 30, axis ? 0.5 : 1) << angle;
      }
    }
}

// Proves (Q10).
TEST(StepwiseRelaxation, LeavesTheStiffnessOfAnisotropicRockAtRest) {
  const Mechanisms mechanisms(3, 4, 50);
  const auto medium = one_cell({3000, 1600, 2000, 0.2, 0.1, 30}, 30, 20, false);
  const StepwiseRelaxation<2> always(medium, mechanisms, 0), by_steps(medium, mechanisms, 0.003);
  const auto stepped = by_steps.medium();
  EXPECT_LT(stepped.vp[0], medium.vp[0]);
  // At a frequency far below the band: what is left at rest.
  const auto sum = [](const RelaxedShares& shares) { return shares[0] + shares[1] + shares[2]; };
  const auto shares = by_steps.shares(0);
  const auto rest = always.stiffness(0, 1e-9);
  const auto of = upright_elasticity<2>(material_of(stepped, 0));
  const double along = std::sqrt(of(1, 1) / of(3, 3)), mean = of(3, 3) * along;
  const double bulk = (mean + of(1, 3)) / 2 * (1 - sum(shares.bulk)),
               shear = (mean - of(1, 3)) / 2 * (1 - sum(shares.shear));
  EXPECT_NEAR(bulk + shear, rest.c33.real() * along, 1e-6 * mean);
  EXPECT_NEAR(bulk - shear, rest.c13.real(), 1e-6 * mean);
  EXPECT_NEAR(of(5, 5) * (1 - sum(shares.shear)), rest.c55.real(), 1e-6 * mean);
}

/// The speed of none of its axes is another's.
const Material cracked =
    material_of(orthorhombic({2300 * 9e6, 2300 * 9.84e6, 2300 * 5.9375e6, 2300 * 2e6, 2300 * 1.6e6,
                              2300 * 2.182e6, 2300 * 3.6e6, 2300 * 2.25e6, 2300 * 2.4e6}),
                2300);

// Proves (Q11).
TEST(BulkPart, IsTheLargestThatLeavesAPositiveRest) {
  const Material isotropic{3000, 1600, 2300}, shale{3000, 1600, 2300, 0.2, 0.1, 0, 0.15};
  const auto of_isotropic = bulk_part(upright_elasticity<3>(isotropic));
  EXPECT_NEAR(of_isotropic.share, 1 - 4. / 3 * std::pow(1600. / 3000, 2), 1e-12);
  for (const double weight : of_isotropic.weights) EXPECT_NEAR(weight, 1. / 3, 1e-12);
  for (const auto& rock : {isotropic, shale, cracked}) {
    const auto c = upright_elasticity<3>(rock);
    const auto part = bulk_part(c);
    // The rest takes nothing from the strain that belongs to the weights, and is positive.
    std::array<Point<3>, 3> rest{};
    for (std::size_t a = 0; a < 3; ++a) {
      double none = 0;
      for (std::size_t b = 0; b < 3; ++b) {
        rest[a][b] = c.voigt[a][b] / std::sqrt(c.voigt[a][a] * c.voigt[b][b]) - part.share;
        none += rest[a][b] * part.weights[b];
      }
      EXPECT_NEAR(none, 0, 1e-12);
      EXPECT_GT(rest[a][a], 0.1);
    }
    EXPECT_GT(rest[0][0] * rest[1][1] - rest[0][1] * rest[1][0], 0.01);
    // The tensors of turned axes are those of the axes, turned.
    auto turned = rock;
    turned.tilt = 90;  // axis 1 along z, axis 3 along -x
    const auto upright = bulk_tensors(rock), lying = bulk_tensors(turned);
    EXPECT_FALSE(upright.are_turned());
    EXPECT_FALSE(lying.are_turned());
    for (const auto& [one, other] : {std::pair{0, 2}, {1, 1}, {2, 0}}) {
      EXPECT_NEAR(lying.stress[std::size_t(one)], upright.stress[std::size_t(other)], 1e-12);
      EXPECT_NEAR(lying.weights[std::size_t(one)], upright.weights[std::size_t(other)], 1e-12);
    }
    turned.tilt = 30, turned.azimuth = 40, turned.rotation = 50;
    const auto any = bulk_tensors(turned);
    EXPECT_EQ(any.are_turned(), rock.is_anisotropic());
    double one = 0;
    for (std::size_t n = 0; n < 6; ++n) one += any.weights[n] * any.stress[n];
    EXPECT_NEAR(one, 1, 1e-12);
  }
}

// Proves (Q12).
TEST(UnrelaxedMedium, HasTheStiffnessOfOrthorhombicRockAtTheReferenceFrequency) {
  const Attenuation attenuation{Mechanisms(3, 4, 50), 13};
  const Material shale{3000, 1600, 2300, 0.2, 0.1, 0, 0.15};
  for (const auto& rock : {shale, cracked}) {
    Medium<3> medium(Grid<3>{{1, 1, 1}, 5, {0, 0, 0}});
    medium[Property::epsilon1] = Field<3>(medium.grid());
    complete_anisotropy(medium);
    put(medium, 0, rock);
    medium[Property::qp] = Field<3>(medium.grid(), 60), medium[Property::qs] = Field<3>(medium.grid(), 30);
    EXPECT_EQ(unrelax(medium, attenuation), "");
    // A rock that is alike in all horizontal directions stays so.
    EXPECT_EQ(is_orthorhombic(medium, 0), rock.orthorhombic.has_value());
    const auto p = attenuation.mechanisms.modulus(attenuation.mechanisms.shares(60), 13),
               s = attenuation.mechanisms.modulus(attenuation.mechanisms.shares(30), 13);
    const auto speed = [](std::complex<double> modulus) { return 1 / (1. / std::sqrt(modulus)).real(); };
    const auto given = upright_elasticity<3>(rock), now = upright_elasticity<3>(material_of(medium, 0));
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        if (a == b) {
          EXPECT_NEAR(speed(now(a, a, a, a) * p), std::sqrt(given(a, a, a, a)), 1e-6 * speed(now(1, 1)));
          continue;
        }
        EXPECT_NEAR(speed(now(a, b, a, b) * s), std::sqrt(given(a, b, a, b)), 1e-6 * speed(now(1, 1)));
        const double root = std::sqrt(now(a, a, a, a) * now(b, b, b, b));
        const auto mixed = root * p - (root - now(a, a, b, b)) * s;
        EXPECT_NEAR(mixed.real(), given(a, a, b, b), 2e-3 * given(a, a, b, b)) << a << b;
      }
    // Of a stepwise medium what is left at rest is the same.
    const StepwiseRelaxation<3> always(medium, attenuation.mechanisms, 0),
        by_steps(medium, attenuation.mechanisms, 0.003);
    const auto stepped = upright_elasticity<3>(material_of(by_steps.medium(), 0));
    EXPECT_LT(stepped(3, 3), now(3, 3));
    const auto at_rest = [](const StepwiseRelaxation<3>& relaxation, const Elasticity<3>& c, int a, int b) {
      const auto shares = relaxation.shares(0);
      const auto left = [](const RelaxedShares& of) { return 1 - of[0] - of[1] - of[2]; };
      const double kappa = bulk_part(c).share, root = std::sqrt(c(a, a, a, a) * c(b, b, b, b));
      return kappa * root * left(shares.bulk) + (c(a, a, b, b) - kappa * root) * left(shares.shear);
    };
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        EXPECT_NEAR(at_rest(by_steps, stepped, a, b), at_rest(always, now, a, b), 1e-6 * now(1, 1)) << a << b;
  }
}

TEST(QualityRules, FollowTheirSources) {
  const Grid<2> grid{{3, 1}, 5, {0, 0}};
  Medium<2> medium(grid);
  const float vs[] = {0, 1000, 2000};
  for (std::size_t cell = 0; cell < 3; ++cell)
    medium.vp[cell] = 2 * vs[cell] + 1500, medium.vs[cell] = vs[cell], medium.rho[cell] = 2000;
  add_q_from_vs(medium, "vs/10");
  EXPECT_EQ(medium[Property::qs][0], infinite);
  EXPECT_EQ(medium[Property::qp][0], infinite);
  EXPECT_EQ(medium[Property::qs][1], 100);
  EXPECT_EQ(medium[Property::qp][1], 200);
  add_q_from_vs(medium, "olsen");
  EXPECT_FLOAT_EQ(medium[Property::qs][1], 20);
  EXPECT_FLOAT_EQ(medium[Property::qp][1], 30);
  EXPECT_FLOAT_EQ(medium[Property::qs][2], 200);
  add_q_from_vs(medium, "brocher");
  EXPECT_FLOAT_EQ(medium[Property::qs][1], -16 + 104.13 - 25.225 + 8.2184);
  EXPECT_NE(refusal([&] { add_q_from_vs(medium, "vs/0"); }).find("found 'vs/0', expected vs/N"),
            std::string::npos);
  add_constant(medium, Property::qs, 40);
  EXPECT_EQ(medium[Property::qs][0], infinite);
  EXPECT_EQ(medium[Property::qs][1], 40);
}

TEST(LayerText, NamesFurtherProperties) {
  for (const char* text : {"100:3000:1500:2200 qp=80 qs=40", "100:3000:1500:2200:qp=80:qs=40",
                           "100:3000:1500:2200:5 qs=40 qp=80"}) {
    const auto layer = parse_layer(text);
    EXPECT_EQ(layer.material.rho, 2200) << text;
    EXPECT_EQ(layer.value(Property::qp), 80) << text;
    EXPECT_EQ(layer.value(Property::qs), 40) << text;
  }
  EXPECT_EQ(parse_layer("0:1:0:1 qp=inf").value(Property::qp), infinite);
  EXPECT_EQ(parse_layer("0:1:0:1").value(Property::qp), infinite);
  EXPECT_NE(refusal([] {
              parse_layer("0:1:0:1 colour=3");
            }).find("found 'colour=3', expected NAME=VALUE, NAME one of qp, qs, epsilon, delta"),
            std::string::npos);
  EXPECT_NE(refusal([] { parse_layer("0:1:0:1 qp=3 qp=4"); }).find("found qp twice"), std::string::npos);
  EXPECT_NE(refusal([] { parse_layer("0:1:0:1 qp=many"); }).find("found 'many', expected a number"),
            std::string::npos);
}

TEST(LayeredMedium, AveragesLossesOfTheLayersThatCutACell) {
  const auto grid = grid_of_size<2>({10, 20}, 10);
  const auto medium =
      layered_medium(grid, {parse_layer("0:3000:1500:2200 qs=40"), parse_layer("5:3000:1500:2200 qs=20"),
                            parse_layer("10:2000:1000:2200")});
  EXPECT_FLOAT_EQ(medium[Property::qs][0], float(2 / (1 / 40. + 1 / 20.)));
  EXPECT_EQ(medium[Property::qs][1], infinite);
  EXPECT_FALSE(medium.has(Property::qp));
}

TEST(ModelCheck, KnowsWhereQualityFactorsMayBe) {
  Model<2> model;
  model.medium = one_cell(3000, 1500, 50, 40);
  check(model);
  model.medium[Property::qp][0] = 0;
  EXPECT_EQ(refusal([&] { check(model); }),
            "qp at x=2.5 z=2.5 is 0, expected a number of at least 1, or inf");
  model.medium[Property::qp][0] = float(infinite);
  check(model);
  model.medium.vs[0] = 0;
  EXPECT_EQ(refusal([&] { check(model); }),
            "qs at x=2.5 z=2.5 is 40, expected inf in fluid, which carries no S waves");
}

}  // namespace
}  // namespace slipwave::model_attenuation_test
