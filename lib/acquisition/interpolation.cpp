#include "acquisition/interpolation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace slipwave {

namespace {

/// Nearer than this to a cell's centre (in cells) counts as on it: coordinates carry rounding of that size.
constexpr double on_centre = 1e-9;

/// Waves up to this many radians a cell enter the least-squares fit. Larger values help below six cells a
/// wavelength and hurt above.
constexpr double highest_wavenumber = 0.35 * std::numbers::pi;

/// Keeps the fit solvable; far below its errors.
constexpr double ridge = 1e-13;

constexpr int most_unknowns = widest_stencil + 4;
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

/// Mean of cos(k x), or of k sin(k x), over 0 <= k <= highest_wavenumber.
double mean_cosine(double x) {
  const double phase = highest_wavenumber * x;
  return std::abs(phase) < 1e-6 ? 1 : std::sin(phase) / phase;
}
double mean_slope(double x) {
  const double phase = highest_wavenumber * x;
  // The closed form loses its digits where both terms are alike.
  if (std::abs(phase) < 1e-2) return highest_wavenumber * phase * (1. / 3 - phase * phase / 30);
  return highest_wavenumber * (std::sin(phase) / phase - std::cos(phase)) / phase;
}

enum class Wanted { value, slope };

/// Weights on the cells `first` .. `first + count - 1` for the value, or the derivative per cell, at
/// `position`: the least mean square of |sum w_j exp(i k (j - position)) - 1|, or - i k, over 0 <= k <=
/// highest_wavenumber, moments 0 to 3 exact, by Lagrange multipliers.
std::array<double, most_unknowns> fitted(double position, std::int64_t first, int count,
                                         Wanted wanted = Wanted::value) {
  const int moments = std::min(count, 4), unknowns = count + moments;
  std::array<Row, most_unknowns> a{};
  for (int i = 0; i < count; ++i) {
    const double x = double(first + i) - position;
    for (int j = 0; j < count; ++j) a[i][j] = mean_cosine(double(i - j));
    a[i][i] += ridge;
    a[i][unknowns] = wanted == Wanted::value ? mean_cosine(x) : mean_slope(x);
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
std::array<std::int64_t, 2> window(const AxisCells& usable) {
  const std::int64_t length = usable.high - usable.low + 1;
  const bool images_below = usable.below != Beyond::unknown, images_above = usable.above != Beyond::unknown;
  const std::int64_t reach = images_below && images_above ? widest_stencil : length;
  return {images_below ? usable.low - reach : usable.low, images_above ? usable.high + reach : usable.high};
}

/// The weights of `count` cells of the window in the middle of which the position lies, as far as it can,
/// images put to their cells.
std::vector<CellWeight> weights_in(const std::array<std::int64_t, 2>& cells, double position, int count,
                                   const AxisCells& usable, Wanted wanted) {
  const auto centred = std::int64_t(std::floor(position - 0.5 * (count - 2)));
  const std::int64_t first = std::clamp(centred, cells[0], cells[1] - count + 1);
  const auto weights = fitted(position, first, count, wanted);
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

/// Of the Lagrange polynomial i through `count` samples 0, 1, ..: its value at x.
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

}  // namespace

std::vector<CellWeight> axis_weights(double position, const AxisCells& usable, int most_cells) {
  assert(usable.low <= usable.high && most_cells >= 2 && most_cells <= widest_stencil);
  assert(position >= double(usable.low) - 0.5 - on_centre &&
         position <= double(usable.high) + 0.5 + on_centre);
  const double nearest = std::round(position);
  if (std::abs(position - nearest) < on_centre && nearest >= double(usable.low) &&
      nearest <= double(usable.high))
    return {{std::int64_t(nearest), 1.}};

  const auto cells = window(usable);
  const int count = int(std::min<std::int64_t>(most_cells, cells[1] - cells[0] + 1));
  return weights_in(cells, position, count, usable, Wanted::value);
}

std::vector<CellWeight> axis_slopes(double position, const AxisCells& usable) {
  assert(usable.low <= usable.high);
  const auto cells = window(usable);
  // Cells on the shorter side.
  const double beside = std::max(0., std::min(std::ceil(position - on_centre) - double(cells[0]),
                                              double(cells[1]) - std::floor(position + on_centre)));
  const int wanted = std::clamp(int(2 * std::min(beside, 4.) + 4), 5, widest_stencil);
  const int count = int(std::min<std::int64_t>(wanted, cells[1] - cells[0] + 1));
  return count < 2 ? std::vector<CellWeight>{} : weights_in(cells, position, count, usable, Wanted::slope);
}

template <int D>
std::vector<PointWeight<D>> point_weights(const Grid<D>& grid, const Point<D>& point_m,
                                          const std::array<AxisCells, std::size_t(D)>& usable,
                                          int most_cells) {
  std::vector<PointWeight<D>> product{{{}, 1.}};
  for (int axis = 0; axis < D; ++axis) {
    const double position = grid.position(axis, point_m[axis]);
    const auto along = axis_weights(position, usable[axis], most_cells);
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

template std::vector<PointWeight<2>> point_weights<2>(const Grid<2>&, const Point<2>&,
                                                      const std::array<AxisCells, 2>&, int);
template std::vector<PointWeight<3>> point_weights<3>(const Grid<3>&, const Point<3>&,
                                                      const std::array<AxisCells, 3>&, int);

}  // namespace slipwave
