// SPDX-License-Identifier: BSD-3-Clause
#include "model/fracture_network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "geology/noise.hpp"
#include "model/planar_fracture.hpp"

namespace slipwave {
namespace {

template <int D>
bool within(const Grid<D>& grid, const Point<D>& at) {
  const auto place = grid.row_coordinates(at);
  for (std::size_t axis = 0; axis < D; ++axis)
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

/// The integral of x^power from 1 to `ratio`.
double integral_of_power(double ratio, double power) {
  const double above = power + 1;
  return std::abs(above) < 1e-9 ? std::log(ratio) : (std::pow(ratio, above) - 1) / above;
}

/// The mean length, in 3-D area, of the fractures of a network before the model cuts any off (S31).
template <int D>
double mean_size(const FractureNetwork& of) {
  const double ratio = of.most_m / of.least_m,
               size = D == 2 ? of.least_m : std::numbers::pi * of.least_m * of.least_m;
  if (ratio == 1) return size;
  return size * integral_of_power(ratio, D - 1 - of.exponent) / integral_of_power(ratio, -of.exponent);
}

/// No fracture is larger when the model has cut it off: the diagonal, in 3-D its square.
template <int D>
double largest_size(const Grid<D>& grid) {
  double square = std::pow(grid.end(D - 1) - grid.origin_m[D - 1], 2);
  for (int axis = 0; axis + 1 < D; ++axis)
    square += std::pow(grid.end(axis) - grid.origin_m[std::size_t(axis)], 2);
  return D == 2 ? std::sqrt(square) : square;
}

/// Throws a usage Error where an intensity means more fractures than a network may have, or none.
void check_number(const FractureNetwork& of, double expected) {
  const bool many = expected > most_fractures;
  if (!many && !(expected < 0.5)) return;
  refuse("--intensity: found " + shown(of.intensity_per_m) + ", which is about " + shown(expected, 2) +
         " fractures in the region, expected 1 to " + std::to_string(most_fractures) + "; choose a " +
         (many ? "lower intensity or larger fractures" : "higher intensity or a larger region"));
}

/// Returns the size of the cells whose centres are in the region, in m2, in 3-D m3.
template <int D>
double size_of(const Grid<D>& grid, const RegionIn<D>& region) {
  double sum = 0;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    Point<D> centre{};
    for (std::size_t axis = 0; axis < D; ++axis) centre[axis] = grid.centre(int(axis), at[axis]);
    centre[D - 1] = grid.depth(at);
    if (region.contains(centre)) sum += std::pow(grid.spacing_m, D - 1) * grid.height(at);
  }
  return sum;
}

/// Fractures, by draw(centre, number of the first random number that is left), until there are enough by
/// count or by size(fracture). Each try draws numbers of its own, so that a fracture does not depend on how
/// many there are.
template <int D, class Draw, class Size>
std::vector<FractureTrace<D>> drawn(const Grid<D>& grid, const RegionIn<D>& region, const FractureNetwork& of,
                                    const Draw& draw, const Size& size) {
  check_network<D>(of);
  const double wanted = of.count > 0 ? 0 : of.intensity_per_m * size_of(grid, region);
  if (of.count == 0) check_number(of, wanted / std::min(mean_size<D>(of), largest_size(grid)));
  const auto &low = region.bounds.low_m, &high = region.bounds.high_m;
  constexpr std::int64_t numbers_a_try = std::int64_t{2} * D, tries_a_fracture = 10000;
  std::vector<FractureTrace<D>> all;
  double sum = 0;
  for (std::int64_t n = 0;; n += numbers_a_try) {
    if (of.count > 0 ? all.size() == std::size_t(of.count) : sum >= wanted) break;
    if (n / numbers_a_try > tries_a_fracture * (std::int64_t(all.size()) + 1))
      throw Error("found no place for a fracture in the region, expected it to fill more of its bounds");
    Point<D> centre;
    for (std::size_t axis = 0; axis < D; ++axis)
      centre[axis] = uniform(of.seed, n + std::int64_t(axis), low[axis], high[axis]);
    if (!region.contains(centre) || !within<D>(grid, centre)) continue;
    auto fracture = draw(centre, n + D);
    const double larger = size(fracture);
    if (of.count == 0 && !all.empty() && sum + larger / 2 > wanted) break;
    if (of.count == 0 && all.size() == std::size_t(most_fractures))
      check_number(of, wanted / sum * most_fractures);
    sum += larger;
    all.push_back(std::move(fracture));
  }
  return all;
}

/// A direction at an angle from another, turned about it.
Point<3> direction_about(const Point<3>& mean, double cosine, double turn) {
  // Across the mean, whichever axis is farthest from it.
  const Point<3> far = std::abs(mean[2]) < 0.5 ? Point<3>{0, 0, 1} : Point<3>{1, 0, 0};
  const auto first = unit_normal<3>(cross_product(mean, far)), second = cross_product(mean, first);
  const double sine = std::sqrt(std::max(0., 1 - cosine * cosine));
  Point<3> direction{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    direction[axis] =
        cosine * mean[axis] + sine * (std::cos(turn) * first[axis] + std::sin(turn) * second[axis]);
  return unit_normal<3>(direction);
}

}  // namespace

template <int D>
void check_network(const FractureNetwork& of) {
  if (of.count < 0) refuse("--network: found " + std::to_string(of.count) + ", expected at least 1");
  if (of.count == 0 && !(of.intensity_per_m > 0))
    refuse("--intensity: found " + shown(of.intensity_per_m) + ", expected " +
           (D == 2 ? "metres" : "square metres") + " of fractures in a " + (D == 2 ? "square" : "cubic") +
           " metre above zero");
  if (!(of.least_m > 0 && of.most_m >= of.least_m))
    refuse((D == 2 ? "--length: found " : "--radius: found ") + shown(of.least_m) + " to " +
           shown(of.most_m) + " m, expected " + (D == 2 ? "lengths" : "radii") + " above zero, the " +
           (D == 2 ? "shortest" : "smallest") + " first");
  if (of.concentration && !(*of.concentration >= 0))
    refuse("--concentration: found " + shown(*of.concentration) + ", expected it not below zero");
}
SLIPWAVE_INSTANTIATE_D(FUNCTION, check_network);

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

double drawn_cosine(double concentration, double share) {
  if (concentration < 1e-6) return 2 * share - 1;
  // Its limit of a large concentration neither overflows nor vanishes.
  const double least = std::exp(-2 * concentration);
  return std::max(-1., 1 + std::log(least + (1 - least) * share) / concentration);
}

std::vector<FractureTrace<2>> drawn_fractures(const Grid<2>& grid, const Region& region,
                                              const FractureNetwork& of) {
  const auto draw = [&](const Point<2>& centre, std::int64_t n) -> FractureTrace<2> {
    const double turn = of.concentration ? drawn_turn(*of.concentration, uniform(of.seed, n + 1, 0, 1)) : 0;
    const double dip = (of.dip_deg + turn) * std::numbers::pi / 180;
    const double half = drawn_length(of, uniform(of.seed, n, 0, 1)) / 2;
    const double x = half * std::cos(dip), z = half * std::sin(dip);
    return {cut_off(grid, centre, {centre[0] - x, centre[1] - z}),
            cut_off(grid, centre, {centre[0] + x, centre[1] + z})};
  };
  return drawn<2>(grid, region, of, draw, length_of);
}

std::vector<FractureTrace<3>> drawn_fractures(const Grid<3>& grid, const RegionIn<3>& region,
                                              const FractureNetwork& of) {
  const auto mean = normal_of_dip(of.dip_deg, of.azimuth_deg);
  const auto box = box_of_grid(grid);
  const auto draw = [&](const Point<3>& centre, std::int64_t n) {
    const double radius_m = drawn_length(of, uniform(of.seed, n, 0, 1));
    const auto normal =
        of.concentration
            ? direction_about(mean, drawn_cosine(*of.concentration, uniform(of.seed, n + 1, 0, 1)),
                              2 * std::numbers::pi * uniform(of.seed, n + 2, 0, 1))
            : mean;
    return clipped(disc_of(centre, radius_m, normal), box);
  };
  return drawn<3>(grid, region, of, draw, area_of);
}

}  // namespace slipwave
