// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/band_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver::solver_band_columns_test {
namespace {

constexpr BandColumns<double>::Images even = {1, 1}, odd = {-1, -1}, mixed = {1, -1};

std::vector<double> random_values(std::int64_t count) {
  std::mt19937 engine(3);
  std::vector<double> values;
  for (std::int64_t n = 0; n < count; ++n)
    values.push_back(std::uniform_real_distribution<double>(-1, 1)(engine));
  return values;
}

double squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

std::vector<double> narrow(BandColumns<double>& columns, const std::vector<double>& wide,
                           const BandColumns<double>::Images& images) {
  std::vector<double> to(std::size_t(columns.narrow()));
  columns.to_narrow(wide.data(), 1, to.data(), 1, 1, images);
  return to;
}

class BandColumnsOf : public testing::TestWithParam<int> {};

// Proves (B2).
TEST_P(BandColumnsOf, KeepSumsOfSquaresAndComeBackAsTheyWere) {
  for (const std::int64_t wide : {3, 20, 101})
    for (const auto& images : {even, odd, mixed}) {
      BandColumns<double> columns(GetParam(), wide);
      const auto values = random_values(wide);
      const auto found = narrow(columns, values, images);
      EXPECT_NEAR(squares(found), GetParam() * squares(values), 1e-12 * squares(values) * double(wide));
      std::vector<double> back(values.size());
      columns.to_wide(found.data(), 1, back.data(), 1, 1, images);
      for (std::size_t n = 0; n < back.size(); ++n) EXPECT_NEAR(back[n], values[n], 1e-12);
    }
}

// Proves (B3): the way back is the transpose over the ratio.
TEST_P(BandColumnsOf, GoBackByTheTranspose) {
  BandColumns<double> columns(GetParam(), 30);
  const auto wide = random_values(30), fine = random_values(columns.narrow());
  std::vector<double> back(30);
  columns.to_wide(fine.data(), 1, back.data(), 1, 1, mixed);
  const auto there = narrow(columns, wide, mixed);
  double one = 0, other = 0;
  for (std::size_t n = 0; n < fine.size(); ++n) one += fine[n] * there[n];
  for (std::size_t n = 0; n < wide.size(); ++n) other += GetParam() * wide[n] * back[n];
  EXPECT_NEAR(one, other, 1e-12);
}

// Proves (B1).
TEST_P(BandColumnsOf, InterpolateWavesAtHighOrder) {
  // Of 12 wide columns a wavelength; halving them shows the order.
  const auto error = [](int ratio, double columns_a_wave) {
    BandColumns<double> columns(ratio, 120);
    std::vector<double> wave;
    const double k = 2 * std::numbers::pi / columns_a_wave;
    for (int n = 0; n < 120; ++n) wave.push_back(std::cos(k * (n + 0.5)));
    const auto found = narrow(columns, wave, even);
    double largest = 0;
    for (std::size_t n = 0; n < found.size(); ++n)
      largest = std::max(largest, std::abs(found[n] - std::cos(k * (double(n) + 0.5) / ratio)));
    return largest;
  };
  EXPECT_LT(error(GetParam(), 12), 1e-3);
  EXPECT_GT(error(GetParam(), 12) / error(GetParam(), 24), 20);
}

TEST_P(BandColumnsOf, KeepConstants) {
  BandColumns<double> columns(GetParam(), 9);
  for (const double value : narrow(columns, std::vector<double>(9, 2.5), even))
    EXPECT_NEAR(value, 2.5, 1e-12);
}

TEST_P(BandColumnsOf, TakeLanesSideBySide) {
  BandColumns<double> columns(GetParam(), 12);
  const auto values = random_values(24);
  std::vector<double> both(std::size_t(2 * columns.narrow())), first;
  columns.to_narrow(values.data(), 2, both.data(), 2, 2, even);
  for (std::size_t n = 0; n < values.size(); n += 2) first.push_back(values[n]);
  const auto alone = narrow(columns, first, even);
  for (std::size_t n = 0; n < alone.size(); ++n) EXPECT_EQ(both[2 * n], alone[n]);
}

INSTANTIATE_TEST_SUITE_P(Ratios, BandColumnsOf, testing::Values(2, 3, 4));

TEST(ImageSign, IsThatOfTheLawOfTheEdge) {
  EXPECT_EQ(image_sign<2>(EdgeLaw::free, 0, FieldRows<2>::velocity(0)), 1);
  EXPECT_EQ(image_sign<2>(EdgeLaw::free, 0, FieldRows<2>::shear_stress(0, 1)), -1);
  EXPECT_EQ(image_sign<2>(EdgeLaw::rigid, 0, FieldRows<2>::velocity(1)), -1);
  EXPECT_EQ(image_sign<2>(EdgeLaw::mirror, 0, FieldRows<2>::velocity(0)), -1);
  EXPECT_EQ(image_sign<2>(EdgeLaw::mirror, 0, FieldRows<2>::velocity(1)), 1);
  EXPECT_EQ(image_sign<2>(EdgeLaw::mirror, 0, FieldRows<2>::normal_stress(1)), 1);
  EXPECT_EQ(image_sign<3>(EdgeLaw::mirror, 1, FieldRows<3>::shear_stress(1, 2)), -1);
  EXPECT_EQ(image_sign<3>(EdgeLaw::absorbing, 1, FieldRows<3>::shear_stress(1, 2)), 1);
}

}  // namespace
}  // namespace slipwave::solver::solver_band_columns_test
