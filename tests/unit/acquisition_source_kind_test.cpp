// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/source_kind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave::acquisition_source_kind_test {
namespace {

template <int D>
Source<D> source_of(const std::string& kind) {
  return {{}, parse_mechanism<D>(kind), parse_wavelet("ricker:30"), 1};
}

/// The kind with numbers 1, 2, ... for its parameters.
template <int D>
std::string typed(const SourceKind<D>& kind) {
  std::string text = kind.name;
  if (*kind.parameters != '\0')
    for (std::size_t n = 0; n < split(kind.parameters, ',').size(); ++n)
      text += (n == 0 ? ':' : ',') + std::to_string(n + 1);
  return text;
}

template <int D>
void expect_rows_agree() {
  for (const auto& kind : source_kinds<D>()) {
    const auto source = source_of<D>(typed(kind));
    const auto& mechanism = source.mechanism;
    const bool shear = std::string(kind.name) == "plane-s";
    EXPECT_STREQ(name_of<D>(mechanism), shear ? kind.name : source_kinds<D>()[mechanism.index()].name);
    EXPECT_EQ(point_injection(source).has_value(), kind.inject != nullptr) << kind.name;
  }
}

TEST(SourceKinds, AreReadAsTheyAreWritten) {
  expect_rows_agree<2>();
  expect_rows_agree<3>();
}

TEST(SourceKinds, SayTheirUnits) {
  EXPECT_EQ(
      amplitude_help(),
      "explosion, moment, double-couple: N m/s per m; force: N/m; plane, plane-s: m/s; in 3-D N m/s and N");
}

/// d n^T + n d^T of the slip d of the upper side and the normal n that points into it.
SymmetricTensor<3, double> of_fault(double strike_deg, double dip_deg, double rake_deg) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  const double s = radians(strike_deg), d = radians(dip_deg), r = radians(rake_deg);
  const double along[] = {std::cos(s), std::sin(s), 0};
  const double down_dip[] = {-std::sin(s) * std::cos(d), std::cos(s) * std::cos(d), std::sin(d)};
  const double normal[] = {-std::sin(s) * std::sin(d), std::cos(s) * std::sin(d), -std::cos(d)};
  SymmetricTensor<3, double> moment;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const auto slip = [&](int k) { return std::cos(r) * along[k] - std::sin(r) * down_dip[k]; };
      moment(i, j) = slip(i) * normal[j] + slip(j) * normal[i];
    }
  return moment;
}

// Proves (A14).
TEST(DoubleCouple, SlipsOnItsPlane) {
  for (const double strike : {0., 33., 120., 270.})
    for (const double dip : {0., 20., 45., 90.})
      for (const double rake : {-90., 0., 25., 90., 160.}) {
        const auto list = std::to_string(strike) + "," + std::to_string(dip) + "," + std::to_string(rake);
        const auto moment = point_injection(source_of<3>("double-couple:" + list))->moment_rate;
        const auto expected = of_fault(strike, dip, rake);
        for (std::size_t n = 0; n < moment.values.size(); ++n)
          EXPECT_NEAR(moment.values[n], expected.values[n], 1e-12) << list << ", " << n;
      }
}

// Proves (A14).
TEST(DoubleCouple, OfThePlaneIsAReverseFaultThatDipsTowardsX) {
  for (const double dip : {-30., 0., 45., 60.}) {
    const auto flat = point_injection(source_of<2>("double-couple:" + std::to_string(dip)))->moment_rate;
    const auto expected = of_fault(270, dip, 90);
    for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 1}})
      EXPECT_NEAR(flat(i, j), expected(2 * i, 2 * j), 1e-12) << dip;
  }
}

TEST(DoubleCouple, SaysWhichAngleIsWrong) {
  EXPECT_THROW(parse_mechanism<3>("double-couple:30"), Error);
  EXPECT_THROW(parse_mechanism<3>("double-couple:30,91,0"), Error);
  EXPECT_THROW(parse_mechanism<3>("double-couple:30,nan,0"), Error);
  EXPECT_THROW(parse_mechanism<2>("double-couple:30,40,0"), Error);
  EXPECT_THROW(parse_mechanism<2>("double-couple"), Error);
}

TEST(SourceKinds, AreIsotropicWhereAllDirectionsAreAlike) {
  EXPECT_TRUE(point_injection(source_of<2>("explosion"))->isotropic);
  EXPECT_FALSE(point_injection(source_of<2>("moment:1,1,0"))->isotropic);
}

}  // namespace
}  // namespace slipwave::acquisition_source_kind_test
