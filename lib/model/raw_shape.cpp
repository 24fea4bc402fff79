// SPDX-License-Identifier: BSD-3-Clause
#include "model/raw_shape.hpp"

#include <cmath>

#include "base/error.hpp"
#include "model/import.hpp"

namespace slipwave {
namespace {

/// How much rougher than the other shape a wrong one is, and how sharply the right distance stands out.
constexpr double rougher = 3, sharp = 2;
/// Looked at for each distance; few enough to be quick in any file.
constexpr std::int64_t most_pairs = 200000;

/// Mean difference of values so far apart in the file.
double roughness(const std::vector<char>& bytes, std::int64_t distance) {
  const std::int64_t pairs = std::int64_t(bytes.size() / 4) - distance;
  if (distance < 1 || pairs < 1) return 0;
  // An odd step meets all depths.
  const std::int64_t step = pairs / most_pairs | 1;
  double sum = 0;
  std::int64_t count = 0;
  for (std::int64_t at = 0; at < pairs; at += step) {
    const double difference = double(raw_value(bytes, at + distance)) - double(raw_value(bytes, at));
    if (!std::isfinite(difference)) continue;
    sum += std::abs(difference);
    ++count;
  }
  return count > 0 ? sum / double(count) : 0;
}

}  // namespace

void check_raw_shape(const std::vector<char>& bytes, const Grid<2>& grid, FastAxis fast) {
  const std::int64_t nx = grid.shape[0], nz = grid.shape[1];
  const std::int64_t given = fast == FastAxis::z ? nz : nx, other = fast == FastAxis::z ? nx : nz;
  constexpr std::int64_t fewest = 4, nearby = 3;
  if (given == other || other <= nearby || given < fewest || bytes.size() != std::size_t(grid.size()) * 4)
    return;
  const double as_given = roughness(bytes, given), exchanged = roughness(bytes, other);
  const double beside = (roughness(bytes, other - nearby) + roughness(bytes, other + nearby)) / 2;
  if (as_given <= rougher * exchanged || beside <= sharp * exchanged) return;
  const auto times = [](std::int64_t a, std::int64_t b) {
    return std::to_string(a) + "x" + std::to_string(b);
  };
  throw Error("found " + times(nx, nz) + ", in which neighbouring " +
                  (fast == FastAxis::z ? "columns" : "rows") + " differ by " + shown(as_given, 3) +
                  " in the mean, but by " + shown(exchanged, 3) + " with --shape " + times(nz, nx) +
                  " or --order " + (fast == FastAxis::z ? "x-fast" : "z-fast") +
                  "; --allow-rough takes it as it is",
              ErrorKind::usage);
}

}  // namespace slipwave
