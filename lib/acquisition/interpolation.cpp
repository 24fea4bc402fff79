// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/interpolation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave {

namespace {

/// Nearer than this to a cell's centre (in cells) counts as on it: coordinates carry rounding of that size.
constexpr double on_centre = 1e-9;

/// What weights along an axis are fitted to. Wavenumbers are in radians per cell.
struct Fit {
  int widest, narrowest;              // cells that surround the point evenly
  double passband;                    // waves up to here are reproduced
  int moments;                        // reproduced exactly
  double stopband;                    // waves from here on are suppressed,
  double suppression;                 // with this weight
  int widest_beside, moments_beside;  // the same where cells do not surround the point evenly
};
/// A larger passband helps below six cells per wavelength and hurts above.
constexpr Fit to_interpolate = {
    widest_stencil, widest_stencil, 0.35 * std::numbers::pi, 4, std::numbers::pi, 0, widest_stencil, 4};
constexpr Fit spread_over(int widest, double passband, double stopband) {
  const double suppression = 0.1 * (std::numbers::pi - stopband);
  return {widest, widest_spread(Moment::passing), passband, 6, stopband, suppression, narrowest_spread, 4};
}
/// A stopband from lower wavenumbers on, or a smaller passband, helps near the source and hurts below ten
/// cells per wavelength.
constexpr Fit to_spread = spread_over(widest_spread(Moment::passing), 1, 2.1);
/// Static stress that is shorter than five cells leaks along the axes once the waves are gone. Over fewer
/// cells it cannot be left out without loss to waves of twelve.
constexpr Fit to_spread_lasting = spread_over(widest_spread(Moment::lasting), 0.5, 1.1);

/// Keeps the fit solvable; far below its errors.
constexpr double ridge = 1e-13;

constexpr int most_unknowns = to_spread_lasting.widest + to_spread_lasting.moments;
using Row = std::array<double, most_unknowns + 1>;

/// Solves the first `n` equations, right-hand sides in column n, by elimination with pivoting.
std::array<double, most_unknowns> solve(std::array<Row, most_unknowns>& a, int n) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  std::array<double, most_unknowns> x{};
  for (int k = n; k-- > 0;) {
    x[k] = a[k][n];
    for (int j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
    x[k] /= a[k][k];
  }
  return x;
}

/// Mean of cos(k x) over from <= k <= to.
double mean_cosine(double from, double to, double x) {
  if (from == 0) return std::abs(to * x) < 1e-6 ? 1 : std::sin(to * x) / (to * x);
  return std::abs(x) < 1e-6 ? 1 : (std::sin(to * x) - std::sin(from * x)) / ((to - from) * x);
}

/// Mean of k sin(k x) over 0 <= k <= to.
double mean_slope(double to, double x) {
  const double phase = to * x;
  // The closed form loses its digits where both terms are alike.
  if (std::abs(phase) < 1e-2) return to * phase * (1. / 3 - phase * phase / 30);
  return to * (std::sin(phase) / phase - std::cos(phase)) / phase;
}

/// What the product of two weights counts in the mean square, by how many cells they are apart.
std::array<double, std::size_t(most_unknowns)> products_of_weights(const Fit& fit) {
  std::array<double, std::size_t(most_unknowns)> products;
  for (std::size_t apart = 0; apart < products.size(); ++apart) {
    products[apart] = mean_cosine(0, fit.passband, double(apart));
    if (fit.suppression > 0)
      products[apart] += fit.suppression * mean_cosine(fit.stopband, std::numbers::pi, double(apart));
  }
  return products;
}

enum class Wanted { value, slope };

/// Weights on the cells `first` .. `first + count - 1` for the value, or the derivative per cell, at
/// `position`: the least mean square of |sum w_j exp(i k (j - position)) - 1|, or - i k, over the passband,
/// and of the sum alone over the stopband, `moments` exact, by Lagrange multipliers.
std::array<double, most_unknowns> fitted(double position, std::int64_t first, int count, int most_moments,
                                         const Fit& fit, Wanted wanted) {
  const int moments = std::min(count, most_moments), unknowns = count + moments;
  static const auto to_read = products_of_weights(to_interpolate), to_add = products_of_weights(to_spread),
                    to_hold = products_of_weights(to_spread_lasting);
  const auto& products = &fit == &to_interpolate ? to_read : &fit == &to_spread ? to_add : to_hold;
  std::array<Row, most_unknowns> a{};
  for (int i = 0; i < count; ++i) {
    const double x = double(first + i) - position;
    for (int j = 0; j < count; ++j) a[i][j] = products[std::size_t(std::abs(i - j))];
    a[i][i] += ridge;
    a[i][unknowns] = wanted == Wanted::value ? mean_cosine(0, fit.passband, x) : mean_slope(fit.passband, x);
    double power = 1;
    for (int m = 0; m < moments; ++m) {
      a[i][count + m] = a[count + m][i] = power;
      power *= x;
    }
  }
  a[count + (wanted == Wanted::value ? 0 : 1)][unknowns] = 1;
  return solve(a, unknowns);
}

/// Mirror images of cells outside low .. high, until inside.
CellWeight folded(CellWeight weight, const AxisCells& usable) {
  while (weight.cell < usable.low || weight.cell > usable.high) {
    const bool below = weight.cell < usable.low;
    weight.cell = (below ? 2 * usable.low - 1 : 2 * usable.high + 1) - weight.cell;
    if ((below ? usable.below : usable.above) == Beyond::odd) weight.weight = -weight.weight;
  }
  return weight;
}

/// The window of cells, images included, that may be taken: an image must be that of a usable cell.
std::array<std::int64_t, 2> window(const AxisCells& usable, const Fit& fit) {
  const std::int64_t length = usable.high - usable.low + 1;
  const bool images_below = usable.below != Beyond::unknown, images_above = usable.above != Beyond::unknown;
  const std::int64_t reach = images_below && images_above ? fit.widest : length;
  return {images_below ? usable.low - reach : usable.low, images_above ? usable.high + reach : usable.high};
}

/// Weights of up to `most_cells` usable cells round `position`, images put to their cells.
std::vector<CellWeight> weights_round(double position, const AxisCells& usable, int most_cells,
                                      const Fit& fit, Wanted wanted = Wanted::value) {
  assert(usable.low <= usable.high);
  assert(position >= double(usable.low) - 0.5 - on_face && position <= double(usable.high) + 0.5 + on_face);
  const auto cells = window(usable, fit);
  const auto low = cells[0], high = cells[1];
  const auto centred = [&](int count) { return std::int64_t(std::floor(position - 0.5 * (count - 2))); };
  const auto surround = [&](int count) {
    return centred(count) >= low && centred(count) + count - 1 <= high;
  };
  int most = most_cells;
  while (most > fit.narrowest && !surround(most)) most -= 2;
  const bool around = surround(most);
  if (!around) most = std::min(most_cells, fit.widest_beside);
  const int count = int(std::min<std::int64_t>(most, high - low + 1));
  const std::int64_t first = std::clamp(centred(count), low, high - count + 1);
  const auto weights = fitted(position, first, count, around ? fit.moments : fit.moments_beside, fit, wanted);
  std::vector<CellWeight> found;
  for (int i = 0; i < count; ++i) {
    const auto weight = folded({first + i, weights[std::size_t(i)]}, usable);
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.cell == weight.cell; });
    if (same == found.end())
      found.push_back(weight);
    else
      same->weight += weight.weight;
  }
  return found;
}

/// Returns the value at x of the Lagrange polynomial i through `count` samples 0, 1, ...
double lagrange(int i, int count, double x) {
  double value = 1;
  for (int j = 0; j < count; ++j)
    if (j != i) value *= (x - j) / double(i - j);
  return value;
}

/// The samples that interpolation at a position takes.
TimeWeights samples_round(double position, std::int64_t low, std::int64_t high) {
  assert(low <= high && position >= double(low) - on_centre && position <= double(high) + on_centre);
  TimeWeights result;
  result.count = int(std::min<std::int64_t>(8, high - low + 1));
  result.first = std::clamp(std::int64_t(std::floor(position)) - 3, low, high - result.count + 1);
  return result;
}

/// Products of the weights of the axes, by axis_weights(axis, position).
template <int D, class AxisWeights>
std::vector<PointWeight<D>> products(const Grid<D>& grid, const Point<D>& point_m,
                                     AxisWeights&& axis_weights) {
  std::vector<PointWeight<D>> product{{{}, 1.}};
  for (int axis = 0; axis < D; ++axis) {
    const auto along = axis_weights(axis, grid.position(axis, point_m[axis]));
    std::vector<PointWeight<D>> wider;
    for (const auto& weight : along)
      for (auto partial : product) {
        partial.cell[axis] = weight.cell;
        partial.weight *= weight.weight;
        wider.push_back(partial);
      }
    product = std::move(wider);
  }
  return product;
}

}  // namespace

std::vector<CellWeight> axis_weights(double position, const AxisCells& usable, int most_cells) {
  assert(most_cells >= 2 && most_cells <= widest_stencil);
  const double nearest = std::round(position);
  if (std::abs(position - nearest) < on_centre && nearest >= double(usable.low) &&
      nearest <= double(usable.high))
    return {{std::int64_t(nearest), 1.}};
  return weights_round(position, usable, most_cells, to_interpolate);
}

std::vector<CellWeight> axis_slopes(double position, const AxisCells& usable) {
  const auto [low, high] = window(usable, to_interpolate);
  // Cells on the shorter side.
  const double beside = std::max(0., std::min(std::ceil(position - on_centre) - double(low),
                                              double(high) - std::floor(position + on_centre)));
  const int wanted = std::clamp(int(2 * std::min(beside, 4.) + 4), 5, widest_stencil);
  if (low == high) return {};
  return weights_round(position, usable, wanted, to_interpolate, Wanted::slope);
}

std::vector<CellWeight> spread_weights(double position, const AxisCells& usable, Moment moment) {
  return weights_round(position, usable, widest_spread(moment),
                       moment == Moment::lasting ? to_spread_lasting : to_spread);
}

template <int D>
std::vector<PointWeight<D>> point_weights(const Grid<D>& grid, const Point<D>& point_m,
                                          const std::array<AxisCells, std::size_t(D)>& usable,
                                          int most_cells) {
  return products<D>(grid, point_m, [&](int axis, double position) {
    return axis_weights(position, usable[std::size_t(axis)], most_cells);
  });
}

template <int D>
std::vector<PointWeight<D>> spread_point_weights(const Grid<D>& grid, const Point<D>& point_m,
                                                 const std::array<AxisCells, std::size_t(D)>& usable,
                                                 Moment moment) {
  return products<D>(grid, point_m, [&](int axis, double position) {
    return spread_weights(position, usable[std::size_t(axis)], moment);
  });
}

TimeWeights time_weights(double position, std::int64_t low, std::int64_t high) {
  const auto nearest = std::int64_t(std::round(position));
  if (std::abs(position - double(nearest)) < on_centre) return {nearest, 1, {1.}};
  auto result = samples_round(position, low, high);
  for (int i = 0; i < result.count; ++i)
    result.weights[std::size_t(i)] = lagrange(i, result.count, position - double(result.first));
  return result;
}

TimeWeights time_slopes(double position, std::int64_t low, std::int64_t high) {
  auto result = samples_round(position, low, high);
  const double x = position - double(result.first);
  for (int i = 0; i < result.count; ++i) {
    double slope = 0;
    for (int without = 0; without < result.count; ++without) {
      if (without == i) continue;
      double product = 1 / double(i - without);
      for (int j = 0; j < result.count; ++j)
        if (j != i && j != without) product *= (x - j) / double(i - j);
      slope += product;
    }
    result.weights[std::size_t(i)] = slope;
  }
  return result;
}

TimeWeights time_integrals(double from, double to, std::int64_t low, std::int64_t high) {
  // Gauss's four points are exact for polynomials of degree seven.
  constexpr std::array<double, 4> nodes = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                           0.8611363115940526};
  constexpr std::array<double, 4> shares = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                            0.3478548451374538};
  auto result = samples_round(from, low, high);
  const double middle = (from + to) / 2 - double(result.first), half = (to - from) / 2;
  for (int i = 0; i < result.count; ++i)
    for (std::size_t n = 0; n < nodes.size(); ++n)
      result.weights[std::size_t(i)] +=
          half * shares[n] * lagrange(i, result.count, middle + half * nodes[n]);
  return result;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, point_weights);

SLIPWAVE_INSTANTIATE_D(FUNCTION, spread_point_weights);

}  // namespace slipwave
