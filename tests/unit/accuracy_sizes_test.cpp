// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace slipwave::accuracy_sizes_test {
namespace {

/// A trace that is exact but for errors of two orders.
std::vector<Gather> traces_in(double spacing_m, double first, double second) {
  Gather gather;
  gather.traces.resize(1);
  gather.traces[0].header.component = Component::vz;
  for (int n = 0; n < 100; ++n)
    gather.traces[0].samples.push_back(std::sin(0.1 * n) + first * spacing_m * std::sin(0.2 * n) +
                                       second * spacing_m * spacing_m * std::cos(0.17 * n));
  return {gather};
}

ErrorOfSizes measured_in(const std::vector<double>& sizes_m, double first, double second) {
  std::vector<std::vector<Gather>> traces;
  for (const double size_m : sizes_m) traces.push_back(traces_in(size_m, first, second));
  std::vector<SizedTraces> sizes;
  for (std::size_t n = 0; n < sizes_m.size(); ++n) sizes.push_back({sizes_m[n], &traces[n]});
  return error_of_sizes(sizes);
}

double largest_difference(const std::vector<Gather>& a, const std::vector<Gather>& b) {
  double most = 0;
  const auto difference = sum_of(a, b, -1);
  for (const auto& trace : difference[0].traces)
    for (const double sample : trace.samples) most = std::max(most, std::abs(sample));
  return most;
}

}  // namespace

TEST(ErrorOfSizes, IsTheErrorOfTheFirstWhereItHasOneOrder) {
  const auto exact = traces_in(0, 0, 0);
  for (const auto& sizes : {std::vector{2., 3., 4.5}, {2., 3.1, 5.}, {3., 2., 1.4}}) {
    const auto second = measured_in(sizes, 0, 0.01);
    EXPECT_NEAR(second.order, 2, 1e-6);
    EXPECT_LT(largest_difference(second.wrong, sum_of(traces_in(sizes[0], 0, 0.01), exact, -1)), 1e-9);
    const auto first = measured_in(sizes, 0.01, 0);
    EXPECT_NEAR(first.order, 1, 1e-6);
    EXPECT_LT(largest_difference(first.wrong, sum_of(traces_in(sizes[0], 0.01, 0), exact, -1)), 1e-9);
  }
}

TEST(ErrorOfSizes, HasAnOrderBetweenThoseOfItsParts) {
  const auto both = measured_in({2, 3, 4.5}, 0.01, 0.005);
  EXPECT_GT(both.order, 1);
  EXPECT_LT(both.order, 2);
}

TEST(ErrorOfSizes, IsTakenAsOfFirstOrderWhereThereAreTwo) {
  EXPECT_EQ(measured_in({2, 3}, 0, 0.01).order, 1);
}

TEST(ErrorOfSizes, IsTheLesserOfTwoBounds) {
  // Of second order, and of fifth, which is derived, in waves that share nothing.
  const double second = 0.002, fifth = 0.0003;
  const auto traces = [&](double h) {
    Gather gather;
    gather.traces.resize(1);
    gather.traces[0].header.component = Component::vz;
    const auto wave = [](int periods, int n) { return std::sin(2 * std::numbers::pi * periods * n / 100); };
    for (int n = 0; n < 100; ++n)
      gather.traces[0].samples.push_back(wave(2, n) + second * h * h * wave(3, n) +
                                         fifth * std::pow(h, 5) * wave(5, n));
    return std::vector<Gather>{gather};
  };
  std::vector<std::vector<Gather>> all;
  std::vector<SizedTraces> sizes;
  const double h = 2, sizes_m[] = {h, 3, 4.5};
  for (const double size_m : sizes_m) all.push_back(traces(size_m));
  const double norm = size_of_error(traces(0), all[0]).whole;  // of the exact ones
  for (std::size_t n = 0; n < 3; ++n)
    sizes.push_back({sizes_m[n], &all[n], fifth * std::pow(sizes_m[n], 5) * norm});
  const auto found = error_of_sizes(sizes);
  EXPECT_NEAR(found.share, 1, 1e-9);
  EXPECT_NEAR(found.order, 2, 1e-6);
  EXPECT_NEAR(found.error, (fifth * std::pow(h, 5) + second * h * h) * norm, 1e-9);
  EXPECT_NEAR(size_of_error(found.wrong, all[0]).whole, found.error, 1e-9);
  // Nothing known of it: all is taken to be of second order.
  for (auto& size : sizes) size.derived = 0;
  const auto blind = error_of_sizes(sizes);
  EXPECT_EQ(blind.share, 0);
  EXPECT_NEAR(blind.error, size_of_error(sum_of(all[1], all[0], -1), all[0]).whole / 1.25, 1e-9);
  EXPECT_GT(blind.error, found.error);
  // More derived than there is: less of it counts, and no more is wrong than without.
  for (auto& size : sizes) size.derived = std::pow(size.spacing_m, 5);
  EXPECT_LT(error_of_sizes(sizes).share, 1);
  EXPECT_LE(error_of_sizes(sizes).error, blind.error);
}

TEST(OrderOfSizes, StaysWithinItsBounds) {
  EXPECT_EQ(order_of_sizes(1, 30, 1.5, 2.25), 2);  // higher orders hide what is not
  EXPECT_EQ(order_of_sizes(1, 1.1, 1.5, 2.25), 1);
  EXPECT_EQ(order_of_sizes(0, 0, 1.5, 2.25), 2);
  EXPECT_NEAR(order_of_sizes(std::pow(1.5, 1.4) - 1, std::pow(2.25, 1.4) - 1, 1.5, 2.25), 1.4, 1e-6);
}

}  // namespace slipwave::accuracy_sizes_test
