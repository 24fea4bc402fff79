#include "model/fracture_network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/noise.hpp"

namespace slipwave {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw Error(sentence, ErrorKind::usage); }

bool within(const Grid<2>& grid, const Point<2>& at) {
  const auto place = grid.row_coordinates(at);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (!(place[axis] >= grid.origin_m[axis] && place[axis] <= grid.end(int(axis)))) return false;
  return true;
}

/// The end of a fracture, or where it leaves the model on its way from the centre.
Point<2> cut_off(const Grid<2>& grid, const Point<2>& centre, const Point<2>& end) {
  if (within(grid, end)) return end;
  double inside = 0, outside = 1;
  const auto at = [&](double share) {
    return Point<2>{centre[0] + share * (end[0] - centre[0]), centre[1] + share * (end[1] - centre[1])};
  };
  for (int n = 0; n < 50; ++n) {
    const double share = (inside + outside) / 2;
    (within(grid, at(share)) ? inside : outside) = share;
  }
  return at(inside);
}

/// Of the cells whose centres are in the region, m2.
double area_of(const Grid<2>& grid, const Region& region) {
  double sum = 0;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    if (region.contains({grid.centre(0, at[0]), grid.depth(at)})) sum += grid.spacing_m * grid.height(at);
  }
  return sum;
}

}  // namespace

void check(const FractureNetwork& of) {
  if (of.count < 0) refuse("--network: found " + std::to_string(of.count) + ", expected at least 1");
  if (of.count == 0 && !(of.intensity_per_m > 0))
    refuse("--intensity: found " + shown(of.intensity_per_m) +
           ", expected metres of fractures in a square metre above zero");
  if (!(of.least_m > 0 && of.most_m >= of.least_m))
    refuse("--length: found " + shown(of.least_m) + " to " + shown(of.most_m) +
           " m, expected lengths above zero, the shortest first");
  if (of.concentration && !(*of.concentration >= 0))
    refuse("--concentration: found " + shown(*of.concentration) + ", expected it not below zero");
}

double drawn_length(const FractureNetwork& of, double share) {
  const double power = 1 - of.exponent, ratio = of.most_m / of.least_m;
  // The limit of an exponent of 1.
  if (std::abs(power) < 1e-9) return of.least_m * std::pow(ratio, share);
  return of.least_m * std::pow(1 + share * (std::pow(ratio, power) - 1), 1 / power);
}

double drawn_turn(double concentration, double share) {
  constexpr std::size_t steps = 2048;
  std::array<double, steps + 1> sum{};
  const auto density = [&](std::size_t n) {
    return std::exp(concentration * (std::cos(2 * std::numbers::pi * (double(n) / steps - 0.5)) - 1));
  };
  for (std::size_t n = 0; n < steps; ++n) sum[n + 1] = sum[n] + (density(n) + density(n + 1)) / 2;
  const double wanted = share * sum[steps];
  const auto above = std::clamp<std::size_t>(
      std::size_t(std::lower_bound(sum.begin(), sum.end(), wanted) - sum.begin()), 1, steps);
  const double part = (wanted - sum[above - 1]) / (sum[above] - sum[above - 1]);
  return 180 * ((double(above - 1) + part) / steps - 0.5);
}

std::vector<FractureTrace<2>> drawn_fractures(const Grid<2>& grid, const Region& region,
                                              const FractureNetwork& of) {
  check(of);
  const double wanted_m = of.count > 0 ? 0 : of.intensity_per_m * area_of(grid, region);
  const auto &low = region.bounds.low_m, &high = region.bounds.high_m;
  constexpr std::int64_t numbers_a_try = 4, tries_a_fracture = 10000;
  std::vector<FractureTrace<2>> all;
  double length_m = 0;
  // Each try draws numbers of its own, so that a fracture does not depend on how many there are.
  for (std::int64_t n = 0;; n += numbers_a_try) {
    if (of.count > 0 ? all.size() == std::size_t(of.count) : length_m >= wanted_m) break;
    if (n / numbers_a_try > tries_a_fracture * (std::int64_t(all.size()) + 1))
      throw Error("found no place for a fracture in the region, expected it to fill more of its bounds");
    const Point<2> centre = {uniform(of.seed, n, low[0], high[0]), uniform(of.seed, n + 1, low[1], high[1])};
    if (!region.contains(centre) || !within(grid, centre)) continue;
    const double turn = of.concentration ? drawn_turn(*of.concentration, uniform(of.seed, n + 3, 0, 1)) : 0;
    const double dip = (of.dip_deg + turn) * std::numbers::pi / 180;
    const double half = drawn_length(of, uniform(of.seed, n + 2, 0, 1)) / 2;
    const double x = half * std::cos(dip), z = half * std::sin(dip);
    FractureTrace<2> trace = {cut_off(grid, centre, {centre[0] - x, centre[1] - z}),
                              cut_off(grid, centre, {centre[0] + x, centre[1] + z})};
    const double longer = length_of(trace);
    if (of.count == 0 && !all.empty() && length_m + longer / 2 > wanted_m) break;
    length_m += longer;
    all.push_back(std::move(trace));
  }
  return all;
}

}  // namespace slipwave
