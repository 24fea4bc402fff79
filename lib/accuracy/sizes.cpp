// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/sizes.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave {

double order_of_sizes(double d1, double d2, double r1, double r2, double kept) {
  constexpr double lowest = 1;
  const double highest = kept;
  if (!(d1 > 0)) return highest;
  const auto ratio = [&](double p) { return (std::pow(r2, p) - 1) / (std::pow(r1, p) - 1); };
  double low = lowest, high = highest;
  // It rises with the order for larger cells, and falls for smaller ones.
  const double rising = ratio(high) >= ratio(low) ? 1 : -1;
  const auto below = [&](double p) { return rising * ratio(p) < rising * d2 / d1; };
  if (!below(low)) return low;
  if (below(high)) return high;
  for (int n = 0; n < 40; ++n) {
    const double middle = (low + high) / 2;
    (below(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

ErrorOfSizes error_of_sizes(std::span<const SizedTraces> sizes, double order_of_two, double kept) {
  const auto& found = *sizes[0].traces;
  const auto ratio = [&](std::size_t n) { return sizes[n].spacing_m / sizes[0].spacing_m; };
  const auto derived = [&](std::size_t n) { return std::abs(sizes[n].derived - sizes[0].derived); };
  ErrorOfSizes of;
  of.wrong = sum_of(*sizes[1].traces, found, -1);
  std::vector<double> apart = {0, size_of_error(of.wrong, found).whole};
  if (sizes.size() > 2) apart.push_back(size_of_error(sum_of(*sizes[2].traces, found, -1), found).whole);
  double most = 1;
  for (std::size_t n = 1; n < apart.size(); ++n)
    if (most * derived(n) > apart[n]) most = apart[n] / derived(n);
  // The bound that takes off a share of what is derived.
  const auto bound = [&](double share) {
    const auto rest = [&](std::size_t n) {
      return std::sqrt(std::max(0., std::pow(apart[n], 2) - std::pow(share * derived(n), 2)));
    };
    of.share = share;
    of.order = apart.size() > 2 ? order_of_sizes(rest(1), rest(2), ratio(1), ratio(2), kept) : order_of_two;
    of.rest = rest(1) / std::abs(std::pow(ratio(1), of.order) - 1);
    of.error = share * sizes[0].derived + of.rest;
    return of.error;
  };
  // What is too large by that much is known no better: as much again may be something else.
  std::vector<double> shares = {0, most * most};
  const double without = bound(0);
  if (apart.size() > 2 && kept > 1 && of.order == kept) {
    // Two differences, two unknowns: the share, and the rest of the order that is kept.
    const auto of_rest = [&](std::size_t n) { return std::pow(std::pow(ratio(n), kept) - 1, 2); };
    const auto squared = [&](double value) { return value * value; };
    const double square = (squared(apart[1]) * of_rest(2) - squared(apart[2]) * of_rest(1)) /
                          (squared(derived(1)) * of_rest(2) - squared(derived(2)) * of_rest(1));
    if (square > 0 && square * squared(derived(1)) <= squared(apart[1])) shares.push_back(std::sqrt(square));
  }
  double least_share = 0, least = without;
  for (const double share : shares)
    if (const double error = bound(share); error < least) least_share = share, least = error;
  bound(least_share);
  of.apart = apart[1];
  // Smaller cells differ the other way.
  const double factor = of.apart > 0 ? std::copysign(of.error / of.apart, ratio(1) - 1) : 0;
  for (auto& gather : of.wrong)
    for (auto& trace : gather.traces)
      for (auto& sample : trace.samples) sample *= factor;
  return of;
}

}  // namespace slipwave
