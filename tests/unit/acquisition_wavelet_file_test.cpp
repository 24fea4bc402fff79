// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "scratch.hpp"

namespace slipwave::acquisition_wavelet_file_test {
namespace {

class WaveletFile : public testing::Test {
 protected:
  std::string with(const std::string& content) {
    const auto path = scratch_.file("w.txt");
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  Wavelet read(const std::string& content) { return parse_wavelet("file:" + with(content)); }
  /// The message of the data error that reading `content` ends with.
  std::string refusal(const std::string& content) {
    try {
      read(content);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::data) << error.what();
      return error.what();
    }
    return "no error";
  }

  Scratch scratch_;
};

std::string sampled(const Wavelet& w, double dt, double shift, bool one_column) {
  std::string text = one_column ? "# dt = " + std::to_string(dt) + "\n" : "";
  char line[100];
  for (int n = 0; n * dt < w.duration_s() + dt; ++n) {
    if (one_column)
      std::snprintf(line, sizeof line, "%.17g\n", w(n * dt));
    else
      std::snprintf(line, sizeof line, "%.17g\t%.17g\n", n * dt + shift, w(n * dt));
    text += line;
  }
  return text;
}

// Proves (W4).
TEST_F(WaveletFile, IsInterpolatedWithOrderFour) {
  const auto exact = parse_wavelet("ricker:25");
  const auto error = [&](double dt) {
    const auto w = read(sampled(exact, dt, 0, false));
    double largest = 0;
    for (double t = 0; t < 0.12; t += 1.7e-5)
      largest = std::max(largest, std::abs(w(t + w.delay_s()) - exact(t)));
    return largest;
  };
  const double coarse = error(4e-3), fine = error(2e-3), finest = error(1e-3);
  EXPECT_LT(coarse, 0.02);  // 10 samples a period of the peak frequency
  EXPECT_GT(std::log2(coarse / fine), 3.5);
  EXPECT_GT(std::log2(fine / finest), 3.8);
}

// Proves (W4).
TEST_F(WaveletFile, GoesThroughItsSamplesAtUnevenTimes) {
  const auto w = read("0 0\n0.001 1\n0.004 -0.5\n0.005,0.25\n0.009 , 0\n");
  EXPECT_EQ(w(0), 0);
  EXPECT_NEAR(w(0.001), 1, 1e-14);
  EXPECT_NEAR(w(0.004), -0.5, 1e-14);
  EXPECT_NEAR(w(0.005), 0.25, 1e-14);
  EXPECT_NEAR(w(0.009), 0, 1e-14);
  EXPECT_EQ(w(0.0091), 0);
  EXPECT_EQ(w(-0.001), 0);
  // Continuous slope: the differences on both sides of a sample agree.
  EXPECT_NEAR((w(0.004) - w(0.004 - 1e-9)) / 1e-9, (w(0.004 + 1e-9) - w(0.004)) / 1e-9, 1e-2);
}

TEST_F(WaveletFile, ThatNoSplineCanPassThroughIsRefused) {
  // Each of these would give NaN somewhere between its samples.
  EXPECT_NE(
      refusal("# dt=1e-300\n0\n1\n-1\n0\n").find("found samples 1e-300 s apart, expected at least 1e-15 s"),
      std::string::npos);
  EXPECT_NE(refusal("0 0\n1 1\n1.00000000000001 2\n1e6 0\n").find("expected at least 1e-06 s"),
            std::string::npos);
  EXPECT_NE(
      refusal("0 1e308\n1 -1e308\n2 0\n").find("line 1: found 1e+308 at 0 s, expected values up to 1e+100"),
      std::string::npos);
  EXPECT_NE(refusal("-1e300 0\n0 1\n").find("times up to 1e+09 s"), std::string::npos);
}

TEST_F(WaveletFile, MayHaveOneColumnAndAnInterval) {
  const auto w = read("# made by hand\r\n# dt=0.002\r\n\r\n0\r\n1\r\n-2e-1\r\n0\r\n");
  EXPECT_NEAR(w(0.002), 1, 1e-14);
  EXPECT_NEAR(w(0.004), -0.2, 1e-14);
  EXPECT_DOUBLE_EQ(w.duration_s(), 0.006);
  EXPECT_EQ(w.delay_s(), 0);
}

// Proves (W4).
TEST_F(WaveletFile, ThatBeginsBeforeZeroIsDelayed) {
  const auto exact = parse_wavelet("ricker:25");
  // Ricker's ends are not exactly zero: one more interval on each side leads there.
  const auto w = read(sampled(exact, 1e-3, -exact.delay_s(), false));
  EXPECT_NEAR(w.delay_s(), exact.delay_s() + 1e-3, 1e-12);
  EXPECT_NEAR(w(w.delay_s()), 1, 1e-12);
  EXPECT_EQ(w(0), 0);
}

TEST_F(WaveletFile, ThatBeginsAfterZeroKeepsItsTimes) {
  const auto w = read("0.5 0\n0.51 1\n0.52 0\n");
  EXPECT_EQ(w.delay_s(), 0);
  EXPECT_EQ(w(0.49), 0);
  EXPECT_NEAR(w(0.51), 1, 1e-14);
}

// Proves (W4).
TEST_F(WaveletFile, IsLedToZeroWhereItEndsWithAJump) {
  const auto w = read("0 1\n0.01 1\n0.02 1\n");
  EXPECT_DOUBLE_EQ(w.delay_s(), 0.01);
  EXPECT_DOUBLE_EQ(w.duration_s(), 0.04);
  EXPECT_EQ(w(0), 0);
  EXPECT_NEAR(w(0.01), 1, 1e-14);
  EXPECT_NEAR(w(0.04), 0, 1e-14);
}

TEST_F(WaveletFile, HasTheFrequenciesOfWhatItSamples) {
  const auto exact = parse_wavelet("ricker:25");
  const auto w = read(sampled(exact, 1e-3, 0, true));
  EXPECT_NEAR(w.nominal_hz(), 25, 0.5);
  EXPECT_NEAR(w.highest_frequency_hz(), exact.highest_frequency_hz(), 0.5);
  EXPECT_NEAR(w.amplitude_spectrum(40), exact.amplitude_spectrum(40), 1e-5 * exact.amplitude_spectrum(25));
}

TEST_F(WaveletFile, SaysWhichLineIsWrong) {
  EXPECT_NE(refusal("0 0\n1 nan\n").find("w.txt: line 2: "), std::string::npos) << refusal("0 0\n1 nan\n");
  EXPECT_NE(refusal("0 0\n1 1e999\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("0 0\n\n# x\n1 1\n0.5 2\n").find("line 5: found time 0.5 s after 1 s"),
            std::string::npos);
  EXPECT_NE(refusal("0 0\n0 1\n").find("line 2: found time 0 s after 0 s"), std::string::npos);
  EXPECT_NE(refusal("0 0\n1 1 1\n").find("line 2: found 3 columns, expected two"), std::string::npos);
  EXPECT_NE(refusal("1\n2\n").find("line 1: found 1 column, expected two"), std::string::npos);
  EXPECT_NE(refusal("# dt=0.1\n0 1\n").find("line 2: found 2 columns, expected one"), std::string::npos);
  EXPECT_NE(refusal("# dt=-1\n0\n").find("line 1: found dt=-1"), std::string::npos);
  EXPECT_NE(refusal("# dt=fast\n0\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("0 0\n1 x\n").find("line 2"), std::string::npos);
}

TEST_F(WaveletFile, RefusesAFileWithoutAWavelet) {
  EXPECT_NE(refusal("").find("found 0 samples"), std::string::npos);
  EXPECT_NE(refusal("# nothing\n").find("found 0 samples"), std::string::npos);
  EXPECT_NE(refusal("0 1\n").find("found 1 sample,"), std::string::npos);
  EXPECT_NE(refusal("0 0\n1 0\n").find("only zeros"), std::string::npos);
  try {
    parse_wavelet("file:" + scratch_.file("missing.txt"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing.txt"), std::string::npos);
  }
}

TEST_F(WaveletFile, MayHaveAHeaderThatNamesTheUnitOfTime) {
  const auto plain = read("0 0\n0.01 1\n0.02 -1\n0.03 0\n");
  for (const char* text :
       {"time value\n0 0\n0.01 1\n0.02 -1\n0.03 0\n", "Time (ms);Amplitude\n0;0\n10;1\n20;-1\n30;0\n",
        "amp,T.MS\n0,0\n1,10\n-1,20\n0,30\n", "# dt=0.01\namplitude\n0\n1\n-1\n0\n"}) {
    const auto wavelet = read(text);
    EXPECT_NEAR(wavelet.duration_s(), 0.03, 1e-15) << text;
    for (const double t : {0.004, 0.01, 0.017}) EXPECT_NEAR(wavelet(t), plain(t), 1e-12) << text;
  }
  EXPECT_NE(refusal("frequency value\n0 0\n1 1\n")
                .find("line 1: found 2 columns with names, expected two, one of them"),
            std::string::npos);
  EXPECT_NE(refusal("time.m value\n0 0\n1 1\n").find("found the unit 'm', expected one of time"),
            std::string::npos);
}

}  // namespace
}  // namespace slipwave::acquisition_wavelet_file_test
