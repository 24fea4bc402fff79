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
  const auto difference = [&](std::size_t n) { return sum_of(*sizes[n].traces, found, -1); };
  const auto ratio = [&](std::size_t n) { return sizes[n].spacing_m / sizes[0].spacing_m; };
  const auto derived = [&](std::size_t n) { return std::abs(sizes[n].derived - sizes[0].derived); };
  ErrorOfSizes of;
  of.wrong = difference(1);
  of.apart = size_of_error(of.wrong, found).whole;
  if (derived(1) > of.apart) of.share = of.apart / derived(1);
  const auto rest_of = [&](double apart, std::size_t n) {
    return std::sqrt(std::max(0., apart * apart - std::pow(of.share * derived(n), 2)));
  };
  const double rest = rest_of(of.apart, 1);
  of.order = order_of_two;
  if (sizes.size() > 2)
    of.order =
        order_of_sizes(rest, rest_of(size_of_error(difference(2), found).whole, 2), ratio(1), ratio(2), kept);
  const double grown = std::pow(ratio(1), of.order) - 1;  // below 0 in smaller cells
  of.rest = rest / std::abs(grown);
  of.error = std::hypot(of.share * sizes[0].derived, of.rest);
  const double factor = of.apart > 0 ? std::copysign(of.error / of.apart, grown) : 0;
  for (auto& gather : of.wrong)
    for (auto& trace : gather.traces)
      for (auto& sample : trace.samples) sample *= factor;
  return of;
}

}  // namespace slipwave
