// SPDX-License-Identifier: BSD-3-Clause
#include "geology/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slipwave::model_noise_test {
namespace {

/// splitmix64 as published, with its state.
class Splitmix64 {
 public:
  explicit Splitmix64(std::uint64_t state) : state_(state) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

}  // namespace

TEST(Mixed, IsASequenceOfSplitmix64) {
  // The first numbers of state 0, as listed by other implementations.
  Splitmix64 published(0);
  EXPECT_EQ(published.next(), 0xe220a8397b1dcdafU);
  EXPECT_EQ(published.next(), 0x6e789e6aa1b965f4U);
  // A key is scrambled once to give the state.
  Splitmix64 of_key_zero(0xe220a8397b1dcdafU);
  for (int n = 0; n < 5; ++n) EXPECT_EQ(mixed(0, n), of_key_zero.next());
}

TEST(Mixed, DependsOnEveryBitOfKeyAndNumber) {
  for (int bit = 0; bit < 64; ++bit) {
    // Of 64 bits about half change.
    const int by_key = __builtin_popcountll(mixed(42, 7) ^ mixed(42 ^ (1ULL << bit), 7));
    const int by_number = __builtin_popcountll(mixed(42, 7) ^ mixed(42, std::int64_t(7 ^ (1ULL << bit))));
    EXPECT_TRUE(by_key > 12 && by_key < 52) << bit;
    EXPECT_TRUE(by_number > 12 && by_number < 52) << bit;
  }
}

TEST(RandomNumbers, HaveTheMomentsTheyPromise) {
  constexpr int count = 100000;
  double mean = 0, square = 0, bell_mean = 0, bell_square = 0, largest = 0;
  for (int n = 0; n < count; ++n) {
    const double u = uniform(5, n), b = bell(6, n);
    EXPECT_TRUE(u >= 0 && u < 1);
    mean += u / count, square += u * u / count;
    bell_mean += b / count, bell_square += b * b / count;
    largest = std::max(largest, std::abs(b));
  }
  // Four standard deviations of the means of so many numbers.
  EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1. / 12 / count));
  EXPECT_NEAR(square, 1. / 3, 4 * std::sqrt(4. / 45 / count));
  EXPECT_NEAR(bell_mean, 0, 4 / std::sqrt(count));
  EXPECT_NEAR(bell_square, 1, 4 * std::sqrt(2. / count));
  EXPECT_LT(largest, 3.5);
}

TEST(Noise, IsSmoothAndStaysWithinOne) {
  // Second differences of a curve with two derivatives vanish with the square of the step, at whole x too.
  const double step = 1e-3;
  for (double x = -3; x < 3; x += 0.01) {
    const double bend = noise(9, x + step) - 2 * noise(9, x) + noise(9, x - step);
    EXPECT_LE(std::abs(noise(9, x)), 1);
    EXPECT_LT(std::abs(bend), 12 * step * step) << x;  // 5.8 is the largest second derivative, times 2
  }
  EXPECT_EQ(noise(9, 2), uniform(9, 2, -1, 1));
}

TEST(SmoothStep, LeadsFromZeroToOneEitherWay) {
  EXPECT_EQ(smooth_step(2, 4, 1), 0);
  EXPECT_EQ(smooth_step(2, 4, 3), 0.5);
  EXPECT_EQ(smooth_step(2, 4, 5), 1);
  EXPECT_EQ(smooth_step(4, 2, 5), 0);
  EXPECT_EQ(smooth_step(4, 2, 1), 1);
}

}  // namespace slipwave::model_noise_test
