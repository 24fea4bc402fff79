// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "refusal.hpp"
#include "segy/time_words.hpp"
#include "segy/writer_headers.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_rounding_test {

using namespace slipwave::segy;

namespace {

std::vector<std::string> sentences_of(const char* format, std::vector<double> samples) {
  const SampleFormat& of = format_named(format);
  std::vector<std::uint8_t> bytes(samples.size() * std::size_t(of.bytes));
  encode_samples(samples, of, Endian::big, bytes);
  Rounding rounding(of);
  rounding.see(Component::vz, samples, bytes, Endian::big);
  return rounding.sentences();
}

TraceHeader at(double x) {
  TraceHeader header;
  header.shot = 1;
  header.receiver_m = {x, 0, 0};
  header.source_m = {0.05, 0, 0.03};
  return header;
}

}  // namespace

TEST(Rounding, RefusesNothingButZerosInEveryFormat) {
  for (const auto* format : {"int8", "int16", "int24", "int32", "int64", "uint8", "uint16", "uint32"})
    EXPECT_THROW(sentences_of(format, {0, 0.3, 0.4, 1e-12}), Error) << format;
  EXPECT_THROW(sentences_of("ieee", {1e-50, 0}), Error);
  EXPECT_THROW(sentences_of("ibm", {1e-90, 0}), Error);
  for (const auto* format : {"int8", "ibm", "ieee", "double"})
    EXPECT_EQ(sentences_of(format, {0, 0}).size(), 0U);
}

TEST(Rounding, SaysHowCoarseWholeNumbersAre) {
  // Of a sample of 1.5 rounded to 2 the error is a third.
  ASSERT_EQ(sentences_of("int16", {1.5}).size(), 1U);
  EXPECT_NE(sentences_of("int16", {1.5})[0].find("33 %"), std::string::npos)
      << sentences_of("int16", {1.5})[0];
  EXPECT_NE(sentences_of("int16", {1.5})[0].find("scale:10000"), std::string::npos);
  EXPECT_TRUE(sentences_of("int16", {3000.4, -2000}).empty());
  EXPECT_TRUE(sentences_of("ieee", {0.1}).empty());
}

TEST(TimeWords, HoldAFractionOfAMillisecondByTheirScalar) {
  for (const auto& [start_s, scalar] : {std::pair(0.012, 1), std::pair(-0.1205, -10),
                                        std::pair(0.00125, -100), std::pair(0.0000005, -10000)}) {
    TraceWords words;
    words.set("tscal", 1);
    set_first_sample(words, start_s, true);
    EXPECT_EQ(words.get("tscal"), scalar);
    EXPECT_EQ(words.get("delrt"), std::llround(start_s * 1e3 * std::abs(scalar)));
  }
  TraceWords words;
  EXPECT_THROW(set_first_sample(words, -0.1205, false), Error);
  EXPECT_THROW(set_first_sample(words, 40, true), Error);
}

TEST(TimeWords, KeepOtherTimesOfTheTrace) {
  TraceWords words;
  words.set("tscal", 1);
  words.set("sstat", -12);
  set_first_sample(words, 0.0005, true);
  EXPECT_EQ(words.get("sstat"), -120);
  words.set("mute", 32767);
  words.set("tscal", 1);
  EXPECT_THROW(set_first_sample(words, 0.0005, true), Error) << "a mute of 32 s does not fit tenths";
}

TEST(TimeWords, WithoutScalarRefuseAShiftedTraceAndSayThatStaticsWereRounded) {
  TraceWords words;
  words.set("tscal", -10);
  words.set("delrt", 120);
  words.set("sstat", 15);
  TraceWords shifted = words;
  EXPECT_TRUE(apply_time_scalar(words));
  EXPECT_EQ(words.get("delrt"), 12);
  shifted.set("delrt", 125);
  EXPECT_THROW(apply_time_scalar(shifted), Error);
}

TEST(Places, OfTenthsOfMillimetresAreExactAndSmallerOnesAreSaid) {
  const std::vector<TraceHeader> half = {at(0.02), at(0.0205), at(0.021)};
  EXPECT_EQ(layout_of(half).coordinate_scalar, -10000);
  EXPECT_TRUE(places_rounded(layout_of(half)).empty());
  EXPECT_EQ(words_from_si(half[1], layout_of(half)).get("gx"), 205);
  const std::vector<TraceHeader> fine = {at(0.02), at(0.02003), at(0.02006)};
  ASSERT_EQ(places_rounded(layout_of(fine)).size(), 1U);
  EXPECT_NE(places_rounded(layout_of(fine))[0].find("3e-05 m"), std::string::npos)
      << places_rounded(layout_of(fine))[0];
}

}  // namespace slipwave::segy_rounding_test
