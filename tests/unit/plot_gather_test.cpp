#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "plot/colour_map.hpp"
#include "plot/gather_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot {
namespace {

const ColourMap colours("blue-red");
const std::uint32_t strongest = colours.pixel(1) & 0xffffff, weakest = colours.pixel(0) & 0xffffff;

constexpr int line = 3;  // a frame's, in pixels

bool is_dark(std::uint32_t pixel) { return (pixel & 0xff) < 0xa0; }

/// The data: within the first column and the first and last row with a long dark line, and where that row
/// ends.
Patch frame_of(const Pixels& pixels) {
  Patch frame{0, pixels.width, -1, pixels.height, -1};
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0, run = 0; x < pixels.width; ++x) {
      run = is_dark(pixels.at(x, y)) ? run + 1 : 0;
      if (run < pixels.width / 2) continue;
      frame.right = std::max(frame.right, x);
      frame.top = std::min(frame.top, y);
      frame.bottom = y;
    }
  }
  for (int x = 0; x < frame.right / 2; ++x) {  // rows hold ticks, too
    for (int y = 0, run = 0; y < pixels.height; ++y) {
      run = is_dark(pixels.at(x, y)) ? run + 1 : 0;
      if (run > pixels.height / 2) frame.left = std::min(frame.left, x);
    }
  }
  return {0, frame.left + line, frame.right - line, frame.top + line, frame.bottom - line};
}

std::vector<char> drawn(GatherSection section, const GatherStyle& style, const Look& look = {}) {
  return draw_gather(std::move(section), style, look, page_of_size("900x700px")).bytes;
}

TEST(PlotGather, ASampleStandsAtItsTimeAndReceiverInTheColourOfItsSign) {
  for (const float sign : {1.0f, -1.0f}) {
    const auto pixels = decoded(drawn(with_spike(41, 30, 25, sign * 2e-6f), {}));
    const auto frame = frame_of(pixels);
    ASSERT_GT(frame.right - frame.left, 400);
    const std::uint32_t colour = sign > 0 ? strongest : weakest;
    Patch spike{0, 900, -1, 700, -1};
    for (int y = frame.top; y <= frame.bottom; ++y) {
      for (int x = frame.left; x <= frame.right; ++x) {
        if (pixels.at(x, y) == 0xffffff) continue;
        ASSERT_EQ(pixels.at(x, y), colour) << "at " << x << "," << y << " within " << frame.left << " to "
                                           << frame.right << ", " << frame.top << " to " << frame.bottom;
        spike = {spike.count + 1, std::min(spike.left, x), std::max(spike.right, x), std::min(spike.top, y),
                 std::max(spike.bottom, y)};
      }
    }
    ASSERT_GT(spike.count, 0);
    const double left = frame.left - line + 1, trace = (frame.right + line - left) / 41;
    EXPECT_NEAR((spike.left + spike.right + 1) / 2.0, left + 30.5 * trace, 1.5);
    EXPECT_NEAR(spike.right - spike.left + 1, trace, 1.5);
    EXPECT_NEAR((spike.top + spike.bottom + 1) / 2.0, frame.top + 0.25 * (frame.bottom - frame.top), 2);
  }
}

TEST(PlotGather, OneSampleAmongMillionsIsSeen) {
  GatherSection section;
  section.component = Component::p;
  section.axis = {3000, 0.001, 0};
  section.headers.resize(2000);
  section.shots = 2;
  section.samples.assign(2000 * 3000, 0.0f);
  section.samples[1234 * 3000 + 1777] = -5;
  const auto pixels = decoded(drawn(section, {}));
  const auto frame = frame_of(pixels);
  int found = 0;
  for (int y = frame.top; y <= frame.bottom; ++y)
    for (int x = frame.left; x <= frame.right; ++x) found += pixels.at(x, y) == weakest;
  EXPECT_EQ(found, 1);
}

TEST(PlotGather, LinesAreFilledToTheRightWherePositive) {
  const auto balance = [](float sign) {
    auto section = with_spike(11, 5, 50, 0);
    for (std::size_t n = 20; n <= 80; ++n)
      section.samples[5 * 101 + n] = sign * float(std::pow(std::sin(3.14159265 * double(n - 20) / 60), 2));
    GatherStyle style;
    style.density = false;
    style.wiggle = true;
    const auto pixels = decoded(drawn(section, style, {.clip_percent = 100}));
    const auto frame = frame_of(pixels);
    const double place = frame.left + 5.5 / 11 * (frame.right - frame.left);
    const double trace = (frame.right - frame.left) / 11.0;
    int left = 0, right = 0;
    for (int y = frame.top; y <= frame.bottom; ++y) {
      for (int x = int(place - 0.9 * trace); x < int(place + 0.9 * trace); ++x) {
        if ((pixels.at(x, y) & 0xff) > 0x80) continue;
        (x < place - 3 ? left : x > place + 3 ? right : left) += std::fabs(x - place) > 3;
      }
    }
    return std::pair(left, right);
  };
  const auto [left, right] = balance(1);
  EXPECT_GT(right, 2000);
  EXPECT_EQ(left, 0);
  const auto [line, none] = balance(-1);  // a line without a filling
  EXPECT_GT(line, 100);
  EXPECT_LT(line, 1500);
  EXPECT_EQ(none, 0);
}

TEST(PlotGather, GainRaisesLaterSamplesByThePowerOfTheirTime) {
  auto section = with_spike(2, 0, 50, 1);  // at 0.5 s
  section.samples[101 + 100] = 1;          // at 1 s
  apply_gain(section, 2);
  EXPECT_FLOAT_EQ(section.samples[50], 0.25f);
  EXPECT_FLOAT_EQ(section.samples[201], 1);
}

TEST(PlotGather, TracesStandInTheOrderOfTheirAxis) {
  auto section = with_spike(3, 0, 10, 7);
  section.headers[0].receiver_m[0] = 500;  // behind the others
  const auto ordered = order_traces(section, TraceAxis::automatic);
  EXPECT_EQ(ordered.axis, TraceAxis::x);
  EXPECT_EQ(ordered.places, (std::vector<double>{25, 50, 500}));
  EXPECT_EQ(section.trace(2)[10], 7);
  EXPECT_EQ(section.headers[2].channel, 1);
  section.headers[1].source_m[0] = 40;
  EXPECT_EQ(order_traces(section, TraceAxis::offset).places, (std::vector<double>{10, 25, 500}));
  EXPECT_EQ(order_traces(section, TraceAxis::number).places, (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(order_traces(section, TraceAxis::depth), Error);
  section.headers[1].receiver_m[2] = 30;
  section.headers[2].receiver_m[2] = 20;
  EXPECT_EQ(order_traces(section, TraceAxis::depth).places, (std::vector<double>{5, 20, 30}));
}

TEST(PlotGather, SeveralShotsStandByNumber) {
  auto section = with_spike(4, 0, 10, 1);
  section.shots = 2;
  EXPECT_EQ(order_traces(section, TraceAxis::automatic).axis, TraceAxis::number);
}

TEST(PlotGather, SaysWhenLinesAreThinnedOut) {
  GatherStyle style;
  style.density = false;
  style.wiggle = true;
  const auto few = draw_gather(with_spike(41, 1, 5, 1), style, {}, page_of_size(""));
  EXPECT_TRUE(few.notes.empty());
  const auto many = draw_gather(with_spike(2000, 1, 5, 1), style, {}, page_of_size(""));
  ASSERT_EQ(many.notes.size(), 1u);
  EXPECT_NE(many.notes[0].find("one in 10 traces"), std::string::npos) << many.notes[0];
}

TEST(PlotGather, SilenceAndSingleSamplesAreDrawn) {
  EXPECT_GT(decoded(drawn(with_spike(1, 0, 0, 0), {})).width, 0);
  auto one = with_spike(1, 0, 0, 1);
  one.axis.count = 1;
  one.samples.resize(1);
  EXPECT_GT(decoded(drawn(one, {})).width, 0);
}

}  // namespace
}  // namespace slipwave::plot
