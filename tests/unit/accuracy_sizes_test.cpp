// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slipwave {
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

TEST(OrderOfSizes, StaysWithinItsBounds) {
  EXPECT_EQ(order_of_sizes(1, 30, 1.5, 2.25), 2);  // higher orders hide what is not
  EXPECT_EQ(order_of_sizes(1, 1.1, 1.5, 2.25), 1);
  EXPECT_EQ(order_of_sizes(0, 0, 1.5, 2.25), 2);
  EXPECT_NEAR(order_of_sizes(std::pow(1.5, 1.4) - 1, std::pow(2.25, 1.4) - 1, 1.5, 2.25), 1.4, 1e-6);
}

}  // namespace slipwave
