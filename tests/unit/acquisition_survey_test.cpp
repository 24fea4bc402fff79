// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/survey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace slipwave::acquisition_survey_test {
namespace {

template <int D>
Source<D> source(const std::string& kind, double amplitude = 1) {
  return {{}, parse_mechanism<D>(kind), parse_wavelet("ricker:30"), amplitude};
}

// Proves (A5).
TEST(Mechanism, IsReadFromItsNotation) {
  EXPECT_TRUE(std::holds_alternative<Explosion>(parse_mechanism<2>("explosion")));
  EXPECT_EQ(std::get<PointForce<2>>(parse_mechanism<2>("force:0.5,-2")).vector, (Point<2>{0.5, -2}));
  const auto moment = std::get<MomentTensor<2>>(parse_mechanism<2>("moment:1,2,3")).tensor;
  EXPECT_EQ(moment(0, 0), 1);
  EXPECT_EQ(moment(1, 1), 2);
  EXPECT_EQ(moment(0, 1), 3);
  EXPECT_EQ(moment(1, 0), 3);
  const auto moment3 = std::get<MomentTensor<3>>(parse_mechanism<3>("moment:1,2,3,4,5,6")).tensor;
  EXPECT_EQ(moment3(2, 2), 3);
  EXPECT_EQ(moment3(0, 1), 4);
  EXPECT_EQ(moment3(2, 0), 5);
  EXPECT_EQ(moment3(1, 2), 6);
  EXPECT_STREQ(name_of<2>(parse_mechanism<2>("moment:1,2,3")), "moment");
  EXPECT_STREQ(name_of<3>(parse_mechanism<3>("plane:0")), "plane");
}

TEST(Mechanism, RefusesWhatIsNoSource) {
  for (const auto& text :
       {"", "bang", "explosion:1", "force", "force:", "force:1", "force:1,2,3", "force:0,0", "force:1,x",
        "force:1,nan", "moment:1,2", "moment:0,0,0", "moment:1,2,3,4", "plane", "plane:", "plane:down",
        "plane:361", "plane:inf", "plane:1,2"}) {
    try {
      parse_mechanism<2>(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
      EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parse_mechanism<3>("force:1,2"), Error);
}

// Proves (A7).
TEST(PlaneWave, TravelsDownAtZeroAndTowardsXAtNinety) {
  const auto direction = [](const std::string& text) {
    return std::get<PlaneWave<2>>(parse_mechanism<2>(text)).direction;
  };
  EXPECT_EQ(direction("plane:0"), (Point<2>{0, 1}));
  EXPECT_EQ(direction("plane:90"), (Point<2>{1, 0}));
  EXPECT_EQ(direction("plane:180"), (Point<2>{0, -1}));
  EXPECT_EQ(direction("plane:-90"), (Point<2>{-1, 0}));
  EXPECT_EQ(direction("plane:270"), (Point<2>{-1, 0}));
  EXPECT_EQ(direction("plane:-360"), (Point<2>{0, 1}));
  EXPECT_NEAR(direction("plane:30")[0], 0.5, 1e-15);
  EXPECT_NEAR(direction("plane:30")[1], std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(direction("plane:-30")[0], -0.5, 1e-15);
  EXPECT_NEAR(direction("plane:150")[1], -std::sqrt(0.75), 1e-15);
  EXPECT_EQ((std::get<PlaneWave<3>>(parse_mechanism<3>("plane:90")).direction), (Point<3>{1, 0, 0}));
  EXPECT_EQ((std::get<PlaneWave<3>>(parse_mechanism<3>("plane:0")).direction), (Point<3>{0, 0, 1}));
}

// Proves (A15).
TEST(PlaneWave, TurnsFromXTowardsYByItsAzimuth) {
  const auto wave = [](const std::string& text) { return std::get<PlaneWave<3>>(parse_mechanism<3>(text)); };
  EXPECT_EQ(wave("plane:90,90").direction, (Point<3>{0, 1, 0}));
  EXPECT_EQ(wave("plane:-90,90").direction, (Point<3>{0, -1, 0}));
  EXPECT_EQ(wave("plane-s:0,90").direction, (Point<3>{0, 0, 1}));
  EXPECT_EQ(wave("plane-s:0,90").along, (std::array<double, 2>{0, 1}));
  EXPECT_EQ(wave("plane:30,0").direction, wave("plane:30").direction);
  EXPECT_NEAR(wave("plane:30,60").direction[0], 0.25, 1e-15);
  EXPECT_NEAR(wave("plane:30,60").direction[1], std::sqrt(3) / 4, 1e-15);
  EXPECT_NEAR(wave("plane:-40,-75").across(), std::sin(-40 * std::acos(-1) / 180), 1e-15);
  EXPECT_THROW(parse_mechanism<2>("plane:30,60"), Error);
  EXPECT_THROW(parse_mechanism<3>("plane:30,60,0"), Error);
  EXPECT_THROW(parse_mechanism<3>("plane:30,361"), Error);
}

// Proves (A6).
TEST(PointInjection, OfAnExplosionIsTheMomentTensorThatIsTheUnitMatrix) {
  const auto explosion = *point_injection(source<3>("explosion", 7));
  EXPECT_EQ(explosion.moment_rate, point_injection(source<3>("moment:1,1,1,0,0,0", 7))->moment_rate);
  EXPECT_EQ(explosion.moment_rate(1, 1), 7);
  EXPECT_EQ(explosion.moment_rate(0, 1), 0);
  EXPECT_EQ(explosion.force, (Point<3>{}));
}

// Proves (A4), (A5).
TEST(PointInjection, ScalesWithTheAmplitude) {
  EXPECT_EQ(point_injection(source<2>("force:3,-4", 2))->force, (Point<2>{6, -8}));
  EXPECT_EQ(point_injection(source<2>("moment:1,0,2", 3))->moment_rate(0, 1), 6);
  EXPECT_FALSE(point_injection(source<2>("plane:10")).has_value());
}

TEST(Survey, MustLieInTheModel) {
  const Grid<2> grid{{100, 50}, 5, {-100, 0}};
  Survey<2> survey{{source<2>("explosion")}, {{-100, 0}, {400, 250}}};
  EXPECT_NO_THROW(check(survey, grid));
  survey.receivers_m.push_back({400.1, 3});
  try {
    check(survey, grid);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "receiver 3 at x=400.1 z=3 lies outside the model, expected x=-100..400 z=0..250");
    EXPECT_EQ(error.kind(), ErrorKind::data);
  }
  survey.receivers_m.clear();
  survey.sources[0].position_m = {0, -1};
  EXPECT_THROW(check(survey, grid), Error);
  survey.sources[0].mechanism = parse_mechanism<2>("plane:0");
  EXPECT_NO_THROW(check(survey, grid));
  survey.receivers_m.push_back({std::numeric_limits<double>::quiet_NaN(), 3});
  EXPECT_THROW(check(survey, grid), Error);
}

}  // namespace
}  // namespace slipwave::acquisition_survey_test
