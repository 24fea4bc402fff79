// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "scratch.hpp"
#include "segy_write_cases.hpp"
#include "shooting/trace_wavelet.hpp"

namespace slipwave::shooting_wavelet_test {
namespace {

class TraceWavelet : public testing::Test {
 protected:
  Scratch scratch_;
  std::string path_ = scratch_.file("wavelet.sgy");

  /// Traces that begin and end with zero, at 10 ms from 0.02 s on.
  Gather write(const segy::FileFormat& format) const {
    auto gather = segy::survey_gather(41, 3, 0.01);
    gather.axis.start_s = 0.02;
    for (auto& trace : gather.traces) trace.samples.front() = trace.samples.back() = 0;
    segy::write_file(path_, gather, format);
    return gather;
  }
  std::string failure(const std::string& text) const {
    try {
      wavelet_named(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(TraceWavelet, GoesThroughTheSamplesOfTheTrace) {
  const auto gather = write({});
  for (const std::size_t number : {1, 2, 29}) {
    const auto wavelet = wavelet_named("file:" + path_ + (number == 1 ? "" : ":" + std::to_string(number)));
    const auto& samples = gather.traces[number - 1].samples;
    for (std::size_t n = 0; n < samples.size(); ++n)
      EXPECT_NEAR(wavelet(0.02 + 0.01 * double(n)), samples[n], 1e-9 * (1 + std::abs(samples[n])));
    EXPECT_EQ(wavelet(0.01), 0);
    EXPECT_EQ(wavelet.delay_s(), 0);
    EXPECT_NEAR(wavelet.duration_s(), 0.42, 1e-12);
  }
}

TEST_F(TraceWavelet, ComesFromSeismicUnixToo) {
  segy::FileFormat su;
  su.su = true;
  const auto gather = write(su);
  const auto wavelet = wavelet_named("file:" + path_ + ":4");
  EXPECT_NEAR(wavelet(0.07), gather.traces[3].samples[5], 1e-9 * 101);
}

TEST_F(TraceWavelet, SaysWhatIsWrong) {
  write({});
  EXPECT_EQ(failure("file:" + path_ + ":999"), path_ + ": found 36 traces, expected trace 999");
  EXPECT_EQ(failure("file:" + path_ + ":0"), "wavelet 'file:" + path_ + ":0': traces count from 1");
  EXPECT_EQ(failure("file:" + path_ + "x:1"), path_ + "x: No such file or directory");
  std::ofstream(path_) << "0 0\n0.1 1\n0.2 0\n";
  EXPECT_EQ(failure("file:" + path_), "");
  EXPECT_NE(failure("file:" + path_ + ":1").find("holds no traces"), std::string::npos);
}

TEST_F(TraceWavelet, OfZerosIsNone) {
  auto gather = segy::survey_gather(11, 1);
  for (auto& sample : gather.traces[1].samples) sample = 0;
  segy::write_file(path_, gather, {});
  EXPECT_EQ(failure("file:" + path_ + ":2"), path_ + ": trace 2: found only zeros, expected a wavelet");
}

}  // namespace
}  // namespace slipwave::shooting_wavelet_test
