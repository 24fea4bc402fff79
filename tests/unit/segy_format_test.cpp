// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "segy/sample_format.hpp"

namespace slipwave::segy_format_test {

using namespace slipwave::segy;

namespace {

std::string refusal(const std::vector<double>& samples, int code) {
  const SampleFormat& format = *find_format(code);
  std::vector<std::uint8_t> bytes(samples.size() * static_cast<std::size_t>(format.bytes));
  try {
    encode_samples(samples, format, Endian::big, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// The definition in exact arithmetic of the System/360: sign, hexadecimal exponent, 24 bits of fraction.
double by_definition(std::uint32_t word) {
  const int exponent = static_cast<int>(word >> 24 & 0x7f) - 64;
  const double magnitude = std::ldexp(static_cast<double>(word & 0xffffff), 4 * exponent - 24);
  return (word & 0x80000000U) != 0 ? -magnitude : magnitude;
}

}  // namespace

TEST(IbmFloat, ReadsTheExamplesOfTheManuals) {
  EXPECT_EQ(double_from_ibm(0x41100000), 1.0);
  EXPECT_EQ(double_from_ibm(0xC276A000), -118.625);
  EXPECT_EQ(double_from_ibm(0x42640000), 100.0);
  EXPECT_EQ(double_from_ibm(0x40800000), 0.5);
  EXPECT_EQ(double_from_ibm(0), 0.0);
  EXPECT_EQ(ibm_from_double(-118.625), 0xC276A000U);
  EXPECT_EQ(ibm_from_double(1), 0x41100000U);
  EXPECT_EQ(ibm_from_double(0.1), 0x4019999AU);  // rounded: truncation would give ...99
}

TEST(IbmFloat, ReadsUnnormalisedNumbersExactly) {
  EXPECT_EQ(double_from_ibm(0x43000001), std::ldexp(1.0, -12));
  EXPECT_EQ(double_from_ibm(0x00000001), std::ldexp(1.0, -280));
  EXPECT_EQ(double_from_ibm(0x7f000000), 0.0);
  for (std::uint64_t word = 0; word < 0x100000000U; word += 65521)
    ASSERT_EQ(double_from_ibm(static_cast<std::uint32_t>(word)),
              by_definition(static_cast<std::uint32_t>(word)));
}

TEST(IbmFloat, WritesEveryNormalisedWordAsItIsRead) {
  for (std::uint32_t exponent = 0; exponent < 128; ++exponent)
    for (std::uint32_t fraction = 0x100000; fraction < 0x1000000; fraction += 40009) {
      const std::uint32_t word = exponent << 24 | fraction;
      ASSERT_EQ(ibm_from_double(double_from_ibm(word)), word);
      ASSERT_EQ(ibm_from_double(double_from_ibm(word | 0x80000000U)), word | 0x80000000U);
    }
}

TEST(IbmFloat, ErrsByAtMostHalfTheLastBitOfTheWorstCase) {
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    const double value = std::pow(10.0, -70 + 145.0 * i / 300000) * (1 + 0.37 * std::sin(i));
    worst = std::max(worst, std::fabs(double_from_ibm(ibm_from_double(value)) - value) / value);
  }
  EXPECT_LE(worst, std::ldexp(1.0, -21));  // 4.77e-7
  EXPECT_GT(worst, 0.9 * std::ldexp(1.0, -21));
}

TEST(IbmFloat, CarriesARoundUpIntoTheExponent) {
  const double below_16 = 16 * (1 - std::ldexp(1.0, -30));
  EXPECT_EQ(ibm_from_double(below_16), 0x42100000U);
  EXPECT_EQ(double_from_ibm(ibm_from_double(std::ldexp(1.0, -300))), 0);
  EXPECT_EQ(double_from_ibm(ibm_from_double(std::ldexp(3.0, -280))), std::ldexp(3.0, -280));
  EXPECT_EQ(ibm_from_double(std::ldexp(1.0, 252) * (1 - std::ldexp(1.0, -24))), 0x7fffffffU);
  EXPECT_THROW(ibm_from_double(std::ldexp(1.0, 252)), Error);
  EXPECT_THROW(ibm_from_double(std::ldexp(1.0, 252) * (1 - std::ldexp(1.0, -26))), Error);
}

TEST(SampleFormat, ReturnsWhatItHoldsInBothByteOrders) {
  for (const SampleFormat& format : sample_formats()) {
    const bool is_unsigned = format.code >= 10;
    std::vector<double> samples = {0, 1, 2, 100, 127, is_unsigned ? 255.0 : -128.0};
    if (format.bytes >= 2) samples.push_back(is_unsigned ? 65535 : -32768);
    if (format.bytes >= 3) samples.push_back(is_unsigned ? 16777215 : -8388608);
    if (format.bytes >= 8) samples.push_back(4503599627370497.0);
    if (format.code == 5 || format.code == 6) samples.push_back(-0.15625);
    for (const Endian endian : {Endian::big, Endian::little}) {
      std::vector<std::uint8_t> bytes(samples.size() * static_cast<std::size_t>(format.bytes));
      std::vector<double> back(samples.size());
      encode_samples(samples, format, endian, bytes);
      decode_samples(bytes, format, endian, back);
      EXPECT_EQ(back, samples) << format.name;
    }
  }
}

TEST(SampleFormat, PutsTheBytesInOrder) {
  const auto bytes_of = [](double value, int code, Endian endian) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(find_format(code)->bytes));
    encode_samples(std::vector<double>{value}, *find_format(code), endian, bytes);
    return bytes;
  };
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(bytes_of(1, 5, Endian::big), (Bytes{0x3f, 0x80, 0, 0}));
  EXPECT_EQ(bytes_of(1, 5, Endian::little), (Bytes{0, 0, 0x80, 0x3f}));
  EXPECT_EQ(bytes_of(1, 1, Endian::big), (Bytes{0x41, 0x10, 0, 0}));
  EXPECT_EQ(bytes_of(-2, 7, Endian::big), (Bytes{0xff, 0xff, 0xfe}));
  EXPECT_EQ(bytes_of(66051, 15, Endian::little), (Bytes{3, 2, 1}));
  EXPECT_EQ(bytes_of(1, 6, Endian::big), (Bytes{0x3f, 0xf0, 0, 0, 0, 0, 0, 0}));
}

TEST(SampleFormat, RoundsToTheNearestInteger) {
  std::vector<std::uint8_t> bytes(8);
  std::vector<double> back(4);
  encode_samples(std::vector<double>{1.4, 1.6, -1.6, 32767.4}, *find_format(3), Endian::big, bytes);
  decode_samples(bytes, *find_format(3), Endian::big, back);
  EXPECT_EQ(back, (std::vector<double>{1, 2, -2, 32767}));
}

TEST(SampleFormat, NamesTheSampleItCannotHold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const SampleFormat& format : sample_formats()) {
    EXPECT_TRUE(refusal({1, 2, nan}, format.code).starts_with("sample 3: nan")) << format.name;
    EXPECT_TRUE(refusal({1, infinity}, format.code).starts_with("sample 2: inf")) << format.name;
  }
  EXPECT_EQ(refusal({1, 32768}, 3), "sample 2: 32768 does not fit a signed integer of 16 bits");
  EXPECT_EQ(refusal({-1}, 16), "sample 1: -1 does not fit an unsigned integer of 8 bits");
  EXPECT_EQ(refusal({9223372036854775808.0}, 9).substr(0, 9), "sample 1:");
  EXPECT_EQ(refusal({18446744073709551616.0}, 12).substr(0, 9), "sample 1:");
  EXPECT_EQ(refusal({0, 1e39}, 5), "sample 2: 1e+39 is beyond the largest IEEE float, 3.403e38");
  EXPECT_EQ(refusal({3.4028235677973366e38}, 5).substr(0, 9), "sample 1:");  // half a unit above the largest
  EXPECT_EQ(refusal({3.4028234663852886e38}, 5), "accepted");
  EXPECT_EQ(refusal({1e76}, 1).substr(0, 9), "sample 1:");
}

TEST(SampleFormat, IsFoundByNameAndCode) {
  EXPECT_EQ(format_named("ibm").code, 1);
  EXPECT_EQ(format_named("ieee").code, 5);
  EXPECT_EQ(format_named("double").code, 6);
  EXPECT_EQ(format_named("16").code, 16);
  EXPECT_EQ(find_format(4), nullptr);
  EXPECT_THROW(format_named("float"), Error);
}

}  // namespace slipwave::segy_format_test
