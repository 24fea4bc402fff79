// SPDX-License-Identifier: BSD-3-Clause
#include "base/fft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"

namespace slipwave::base_fft_test {
namespace {

std::vector<double> noise(std::size_t count) {
  std::vector<double> samples(count);
  std::uint32_t state = 12345;
  for (double& sample : samples) {
    state = state * 1664525U + 1013904223U;
    sample = static_cast<double>(state) / 4294967296.0 - 0.5;
  }
  return samples;
}

/// The defining sum, term by term.
std::complex<double> direct(const std::vector<double>& samples, std::size_t length, std::size_t k) {
  std::complex<double> sum = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    sum += samples[n] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * n % length) /
                                            static_cast<double>(length));
  return sum;
}

}  // namespace

TEST(RealTransform, IsTheDefiningSumForEvenOddAndPrimeLengths) {
  for (const std::size_t length : {1, 2, 3, 8, 15, 64, 97, 1000}) {
    RealTransform transform(length);
    const std::vector<double> samples = noise(length);
    const auto spectrum = transform.forward(samples);
    ASSERT_EQ(spectrum.size(), length / 2 + 1);
    for (std::size_t k = 0; k < spectrum.size(); ++k)
      EXPECT_LT(std::abs(spectrum[k] - direct(samples, length, k)), 1e-11) << length << " " << k;
  }
}

TEST(RealTransform, PadsAShorterTraceWithZeros) {
  RealTransform transform(40);
  const std::vector<double> samples = noise(17);
  transform.forward(noise(40));  // leaves nothing behind
  const auto spectrum = transform.forward(samples);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    EXPECT_LT(std::abs(spectrum[k] - direct(samples, 40, k)), 1e-12);
}

TEST(RealTransform, BackwardUndoesForward) {
  for (const std::size_t length : {1, 2, 9, 250, 1021}) {
    RealTransform transform(length);
    const std::vector<double> samples = noise(length);
    const auto spectrum = transform.forward(samples);
    const std::vector<std::complex<double>> kept(spectrum.begin(), spectrum.end());
    const auto back = transform.backward(kept);
    for (std::size_t n = 0; n < length; ++n) EXPECT_NEAR(back[n], samples[n], 1e-14);
  }
}

TEST(RealTransform, RefusesLengthsThatDoNotFit) {
  EXPECT_THROW(RealTransform(0), Error);
  RealTransform transform(8);
  EXPECT_THROW(transform.forward(noise(9)), Error);
  EXPECT_THROW(transform.backward(std::vector<std::complex<double>>(8)), Error);
}

TEST(FastTransformLength, IsTheNextEvenProductOfSmallPrimes) {
  const auto is_one = [](std::size_t length) {
    if (length % 2 != 0) return false;
    for (const std::size_t factor : {2, 3, 5, 7})
      while (length % factor == 0) length /= factor;
    return length == 1;
  };
  for (std::size_t length = 1; length < 5000; ++length) {
    std::size_t expected = length;
    while (!is_one(expected)) ++expected;
    EXPECT_EQ(fast_transform_length(length), expected) << length;
  }
  EXPECT_THROW(fast_transform_length(std::size_t{1} << 31), Error);
}

TEST(RealTransform2, RefusesWhatTheMachineHasNoMemoryFor) {
  try {
    RealTransform2(2000000000, 2000000000);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(
        std::string(error.what()).find("a Fourier transform of 2000000000 x 2000000000 samples takes 2.98e"),
        0U)
        << error.what();
  }
}

}  // namespace slipwave::base_fft_test
