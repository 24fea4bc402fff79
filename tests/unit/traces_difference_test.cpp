// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "gather/difference.hpp"
#include "segy/sample_format.hpp"
#include "traces/float_difference.hpp"

namespace slipwave::traces_difference_test {

using segy::Endian;

namespace {

/// Floats of all sizes, subnormal ones and zeros too, the signs mixed; near equals in pairs.
std::vector<double> floats(std::uint32_t seed) {
  std::vector<double> values = {0, -0.0, 1, 1, 1e-45, -1e-45, 3e38, 1.17549435e-38};
  std::uint32_t state = seed;
  while (values.size() < 100000) {
    state = state * 1664525U + 1013904223U;
    const auto value = std::bit_cast<float>(state ^ state >> 13);
    if (std::isfinite(value)) values.push_back(static_cast<double>(value / 4));
  }
  return values;
}

}  // namespace

TEST(SubtractFloats, GivesTheBitsOfSubtractingDoublesInEveryByteOrder) {
  const segy::SampleFormat& ieee = segy::format_named("ieee");
  const std::vector<double> a = floats(1);
  std::vector<double> b = floats(2);
  for (std::size_t n = 500; n < 50000; ++n) b[n] = static_cast<double>(static_cast<float>(a[n] * 1.0000001));
  const auto stored = [&](const std::vector<double>& values, Endian order) {
    std::vector<std::uint8_t> bytes(4 * values.size());
    segy::encode_samples(values, ieee, order, bytes);
    return bytes;
  };
  std::vector<double> expected = a;
  subtract(expected, b);
  for (const Endian order_of_a : {Endian::big, Endian::little})
    for (const Endian order_of_b : {Endian::big, Endian::little}) {
      std::vector<std::uint8_t> difference(4 * a.size());
      subtract_floats(stored(a, order_of_a), order_of_a, stored(b, order_of_b), order_of_b, difference);
      EXPECT_TRUE(difference == stored(expected, order_of_a));
    }
}

}  // namespace slipwave::traces_difference_test
