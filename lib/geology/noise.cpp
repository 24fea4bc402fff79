// SPDX-License-Identifier: BSD-3-Clause
#include "geology/noise.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave {
namespace {

std::uint64_t finalised(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31);
}

}  // namespace

std::uint64_t mixed(std::uint64_t key, std::int64_t number) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  return finalised(finalised(key + golden) + (std::uint64_t(number) + 1) * golden);
}

double uniform(std::uint64_t key, std::int64_t number) {
  return double(mixed(key, number) >> 11) * 0x1p-53;  // all the bits that a double holds
}

double uniform(std::uint64_t key, std::int64_t number, double low, double high) {
  return low + (high - low) * uniform(key, number);
}

double bell(std::uint64_t key, std::int64_t number) {
  std::uint64_t bits = mixed(key, number);
  double sum = -2;
  for (int part = 0; part < 4; ++part, bits >>= 16) sum += (double(bits & 0xffff) + 0.5) / 65536;
  return sum * std::sqrt(3.0);  // the variance of the sum is 4/12
}

double noise(std::uint64_t key, double x) {
  const double cell = std::floor(x), t = x - cell;
  const auto n = std::int64_t(cell);
  const double a = uniform(key, n, -1, 1), b = uniform(key, n + 1, -1, 1);
  return a + (b - a) * t * t * t * (t * (6 * t - 15) + 10);
}

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0., 1.);
  return t * t * (3 - 2 * t);
}

}  // namespace slipwave
