// SPDX-License-Identifier: BSD-3-Clause
#include "build/raw_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "build/import.hpp"

namespace slipwave {
namespace {

/// Looked at for each length; few enough to be quick in any file.
constexpr std::int64_t most_values = 400000;

/// How values of a raw file differ, in the mean, if its lines have that length.
struct Roughness {
  double along = 0, across = 0;  // from value to value of a line, from line to line
  double unlike = 0;             // by how much the first differs between neighbouring lines
  double jump = 0;               // from the end of a line to the beginning of the next, over `along`
};

/// Mean step from the last value of lines to the first of the next.
double jumps(const std::vector<char>& bytes, std::int64_t length) {
  const std::int64_t values = std::int64_t(bytes.size() / 4), ends = values / length - 1;
  const std::int64_t step = ends / most_values + 1;
  double sum = 0;
  std::int64_t count = 0;
  for (std::int64_t end = 0; end < ends; end += step) {
    const std::int64_t at = (end + 1) * length;
    const double jump = double(raw_value(bytes, at)) - double(raw_value(bytes, at - 1));
    if (!std::isfinite(jump)) continue;
    sum += std::abs(jump);
    ++count;
  }
  return count == 0 ? 0 : sum / double(count);
}

Roughness roughness(const std::vector<char>& bytes, std::int64_t length) {
  const auto value = [&](std::int64_t at) { return double(raw_value(bytes, at)); };
  const std::int64_t last = std::int64_t(bytes.size() / 4) - length - 1;
  // An odd step meets all places of lines.
  const std::int64_t step = last / most_values | 1;
  Roughness sum;
  std::int64_t count = 0;
  for (std::int64_t at = 0; at < last; at += step) {
    if (at % length == length - 1) continue;
    const double here = value(at), next = value(at + 1), beside = value(at + length),
                 beyond = value(at + length + 1);
    const double mixed = beyond - beside - next + here;
    if (!std::isfinite(mixed)) continue;
    sum.along += std::abs(next - here);
    sum.across += std::abs(beside - here);
    sum.unlike += std::abs(mixed);
    ++count;
  }
  if (count == 0) return {};
  const double along = sum.along / double(count);
  return {along, sum.across / double(count), sum.unlike / double(count),
          jumps(bytes, length) / std::max(along, 1e-30)};
}

/// Mean difference of values so far from each other.
double difference_over(const std::vector<char>& bytes, std::int64_t distance) {
  const std::int64_t last = std::int64_t(bytes.size() / 4) - distance;
  const std::int64_t step = last / most_values | 1;
  double sum = 0;
  std::int64_t count = 0;
  for (std::int64_t at = 0; at < last; at += step) {
    const double change = double(raw_value(bytes, at + distance)) - double(raw_value(bytes, at));
    if (!std::isfinite(change)) continue;
    sum += std::abs(change);
    ++count;
  }
  return count == 0 ? 0 : sum / double(count);
}

std::string times(std::int64_t a, std::int64_t b) { return std::to_string(a) + "x" + std::to_string(b); }

const char* name_of(FastAxis fast) { return fast == FastAxis::z ? "z-fast" : "x-fast"; }
FastAxis other_than(FastAxis fast) { return fast == FastAxis::z ? FastAxis::x : FastAxis::z; }

/// Numbers of cells with those of the first and the last axis exchanged.
template <int D>
std::string exchanged_shape(const Grid<D>& grid) {
  if constexpr (D == 2) return times(grid.shape[1], grid.shape[0]);
  return times(grid.shape[2], grid.shape[1]) + "x" + std::to_string(grid.shape[0]);
}
template <int D>
std::string shape_of(const Grid<D>& grid) {
  if constexpr (D == 2) return times(grid.shape[0], grid.shape[1]);
  return times(grid.shape[0], grid.shape[1]) + "x" + std::to_string(grid.shape[2]);
}

// What counts as clearly more; noise differs by some tenths.
constexpr double much = 2;

/// Throws a usage Error where values of a volume are much more like what another order of its axes has next
/// to them along those where the two orders have other neighbours.
void check_neighbours(const std::vector<char>& bytes, const Grid<3>& grid, FastAxis fast) {
  using Axes = std::array<std::size_t, 3>;  // the slowest first
  const auto distances = [&](const Axes& axes) {
    const std::int64_t line = grid.shape[axes[2]];
    return std::array{line, line * grid.shape[axes[1]]};
  };
  const auto name = [](const Axes& of) { return std::string{"xyz"[of[0]], "xyz"[of[1]], "xyz"[of[2]]}; };
  const Axes given = fast == FastAxis::z ? Axes{0, 1, 2} : Axes{2, 1, 0};
  Axes axes = {0, 1, 2};
  do {
    double as_given = 0, otherwise = 0;
    for (const std::size_t n : {0, 1}) {
      const auto one = distances(given)[n], other = distances(axes)[n];
      if (one == other) continue;
      as_given += difference_over(bytes, one);
      otherwise += difference_over(bytes, other);
    }
    if (!(as_given > much * otherwise)) continue;
    throw Error("found " + shape_of(grid) + " in the order " + name_of(fast) + ", " + name(given) +
                    " with the slowest axis first, in which neighbours differ by " + shown(as_given, 3) +
                    ", in the order " + name(axes) + " by " + shown(otherwise, 3) +
                    "; expected xyz, or zyx with --order x-fast, or --allow-rough to take it as it is",
                ErrorKind::usage);
  } while (std::next_permutation(axes.begin(), axes.end()));
}

}  // namespace

template <int D>
void check_raw_shape(const std::vector<char>& bytes, const Grid<D>& grid, FastAxis fast) {
  // Fewer cells have too few lines to compare.
  constexpr double far_more = 3, undecided = 0.7;
  constexpr std::int64_t fewest = 4;
  const std::int64_t nx = grid.shape[0], nz = grid.shape[D - 1];
  if (nx < fewest || nz < fewest || bytes.size() != std::size_t(grid.size()) * 4) return;
  const std::int64_t given = fast == FastAxis::z ? nz : nx, other = fast == FastAxis::z ? nx : nz;
  const auto as_given = roughness(bytes, given), exchanged = roughness(bytes, other);
  const auto refuse = [&](const std::string& found, bool any_shape) {
    throw Error("found " + shape_of(grid) + " in the order " + name_of(fast) + ", in which " + found +
                    "; expected " + (any_shape ? "--shape " + exchanged_shape(grid) + " or " : "") +
                    "--order " + name_of(other_than(fast)) + ", or --allow-rough to take it as it is",
                ErrorKind::usage);
  };
  const char* const lines = fast == FastAxis::z ? "columns" : "rows";
  if (as_given.unlike > much * exchanged.unlike)
    refuse(std::string("neighbouring ") + lines + " do not continue each other: steps along them differ by " +
               shown(as_given.unlike, 3) + " in the mean, along lines of " + std::to_string(other) +
               " values by " + shown(exchanged.unlike, 3),
           true);
  if constexpr (D == 3)
    if (grid.shape[1] >= fewest) check_neighbours(bytes, grid, fast);
  if (as_given.unlike < undecided * exchanged.unlike) return;
  if (given != other && exchanged.jump > far_more * std::max(1., as_given.jump))
    refuse(std::string("the ends of ") + lines + " are no ends: values jump after each " +
               std::to_string(other) + ", by " + shown(exchanged.jump, 3) + " times a usual step, and by " +
               shown(as_given.jump, 3) + " times after each " + std::to_string(given),
           true);
  const double along_x = fast == FastAxis::z ? as_given.across : as_given.along;
  const double along_z = fast == FastAxis::z ? as_given.along : as_given.across;
  if (along_x > much * along_z)
    refuse("values change by " + shown(along_x, 3) + " from cell to cell along x, but by " +
               shown(along_z, 3) + " along z: layers would stand upright",
           false);
}

std::string doubt_of_depth(const Field<3>& speeds) {
  const auto& grid = speeds.grid();
  const auto rows = std::size_t(grid.shape[2]);
  constexpr std::size_t fewest = 4;
  if (rows < fewest) return "";
  std::vector<double> means(rows);
  for (std::int64_t n = 0; n < grid.size(); ++n)
    means[std::size_t(grid.index(n)[2])] += double(speeds[std::size_t(n)]);
  double sum = 0, squares = 0, product = 0, depths = 0;
  for (auto& mean : means) sum += mean /= double(grid.shape[0] * grid.shape[1]);
  for (std::size_t k = 0; k < rows; ++k) {
    const double apart = means[k] - sum / double(rows), depth = double(k) - 0.5 * double(rows - 1);
    squares += apart * apart, product += apart * depth, depths += depth * depth;
  }
  // The share of the variance that a straight line takes.
  if (!(product < 0 && product * product > 0.5 * squares * depths)) return "";
  return "speeds fall with depth, from " + shown(means.front(), 4) + " in the first row to " +
         shown(means.back(), 4) + " in the last, as those of a file from the bottom up do";
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, check_raw_shape);

}  // namespace slipwave
