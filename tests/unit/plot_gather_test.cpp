// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "plot/colour_map.hpp"
#include "plot/gather_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_gather_test {
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

const Look nearest{.interpolate = false};

std::vector<char> drawn(GatherSection section, const GatherStyle& style, const Look& look = nearest) {
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

/// Columns of pixels within the frame all of whose pixels have this colour.
std::vector<int> columns_of(const Pixels& pixels, std::uint32_t colour) {
  const auto frame = frame_of(pixels);
  std::vector<int> found;
  for (int x = frame.left; x <= frame.right; ++x) {
    bool all = true;
    for (int y = frame.top + 3; y < frame.bottom - 3; ++y) all = all && pixels.at(x, y) == colour;
    if (all) found.push_back(x);
  }
  return found;
}

TEST(PlotGather, GapsBetweenTracesStayBlankInEveryStyle) {
  auto section = with_spike(20, 0, 0, 0);
  for (std::size_t n = 0; n < section.samples.size(); ++n)
    section.samples[n] = float(std::sin(0.7 * double(n % 101)) + 0.1);
  for (std::size_t n = 10; n < 20; ++n) section.headers[n].receiver_m[0] += 500;  // 525 m to the one before
  const double extent = 475 + 500 + 25;
  for (const std::string style : {"density", "interpolated", "both", "wiggle"}) {
    const bool lines = style == "wiggle";
    const auto pixels = decoded(drawn(section, {.density = !lines, .wiggle = lines || style == "both"},
                                      {.interpolate = style != "density"}));
    const auto frame = frame_of(pixels);
    const double metre = (frame.right - frame.left + 2 * line) / extent;
    const auto blank = columns_of(pixels, lines ? 0xffffff : pixel_of(no_data) & 0xffffff);
    // From half a spacing, or as far as a line swings out, behind the one to as far before the other.
    const double beside = style == "density" || style == "interpolated" ? 12.5 : 1.4 * 25;
    ASSERT_FALSE(blank.empty()) << style;
    EXPECT_NEAR(double(blank.size()), (525 - 2 * beside) * metre, 6) << style;
    EXPECT_NEAR((blank.front() + blank.back()) / 2.0, (frame.left + frame.right) / 2.0, 6) << style;
    EXPECT_EQ(blank.back() - blank.front() + 1, int(blank.size())) << style;
  }
}

TEST(PlotGather, BetweenTwoTracesColoursGoOverIntoEachOther) {
  auto section = with_spike(2, 0, 0, 0);
  for (std::size_t n = 0; n < section.samples.size(); ++n) section.samples[n] = n < 101 ? 1.0f : 0.0f;
  const auto pixels = decoded(drawn(section, {}, {.clip_percent = 100}));
  const auto frame = frame_of(pixels);
  const int y = (frame.top + frame.bottom) / 2;
  const auto map = ColourMap("blue-red");
  EXPECT_EQ(pixels.at(frame.left + 20, y), strongest);  // outside the outermost places they stay
  EXPECT_EQ(pixels.at(frame.right - 20, y), 0xffffffu);
  EXPECT_TRUE(alike(pixels.at((frame.left + frame.right) / 2, y), map.pixel(0.75) & 0xffffff));
}

TEST(PlotGather, DepthsOfReceiversRunDownAndTimeToTheRight) {
  auto section = with_spike(40, 30, 25, 1);  // at 0.25 s
  for (std::size_t n = 0; n < 40; ++n) section.headers[n].receiver_m = {100, 0, 10.0 * double(n)};
  for (const bool wiggle : {false, true}) {
    const auto pixels = decoded(drawn(section, {.density = !wiggle, .wiggle = wiggle}));
    const auto frame = frame_of(pixels);
    const double left = frame.left - line, width = frame.right - frame.left + 2 * line;
    const double top = frame.top - line, trace = (frame.bottom - frame.top + 2 * line) / 40.0;
    Patch spike{0, 900, -1, 700, -1};
    for (int y = frame.top; y <= frame.bottom; ++y)
      for (int x = frame.left; x <= frame.right; ++x) {
        // A line that swings out upwards stands between its place and that of the trace above.
        const bool found = wiggle
                               ? is_dark(pixels.at(x, y)) && y < top + 30.2 * trace && y > top + 29.7 * trace
                               : pixels.at(x, y) == strongest;
        if (!found) continue;
        spike = {spike.count + 1, std::min(spike.left, x), std::max(spike.right, x), std::min(spike.top, y),
                 std::max(spike.bottom, y)};
      }
    ASSERT_GT(spike.count, 3);
    EXPECT_NEAR((spike.left + spike.right + 1) / 2.0, left + 0.25 * width, 3);
    if (!wiggle) {
      EXPECT_NEAR((spike.top + spike.bottom + 1) / 2.0, top + 30.5 * trace, 2);
    }
  }
}

/// A gather as SVG, whose words can be read.
std::string svg_of(std::vector<NamedGather> gathers, const GatherStyle& style = {}) {
  const auto bytes =
      draw_gathers(std::move(gathers), style, {}, page_of(Format::svg, {"", {}, "", ""})).bytes;
  return {bytes.begin(), bytes.end()};
}

GatherSection of_component(Component component, float value) {
  auto section = with_spike(5, 2, 50, value);
  section.component = component;
  for (auto& header : section.headers) header.component = component;
  return section;
}

TEST(PlotGather, ComponentsOfOneUnitShareAScaleAndOthersHaveTheirOwn) {
  const auto svg = svg_of({{"a", of_component(Component::vx, 1e-6f)},
                           {"a", of_component(Component::vz, 2e-6f)},
                           {"a", of_component(Component::p, 300)}});
  for (const char* word : {">vx<", ">vz<", ">p<", ">vx, vz (\u00b5m/s)<", ">p (Pa)<"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  GatherStyle overlaid;
  overlaid.overlay = true;
  EXPECT_THROW(
      svg_of({{"a", of_component(Component::vx, 1)}, {"a", of_component(Component::p, 1)}}, overlaid), Error);
  EXPECT_NE(svg_of({{"a", of_component(Component::vx, 1)}, {"a", of_component(Component::vz, 1)}}, overlaid)
                .find(">vz<"),
            std::string::npos);
}

TEST(PlotGather, AGainLeavesTheUnit) {
  GatherStyle style;
  style.gain_power = 2;
  EXPECT_NE(svg_of({{"a", of_component(Component::vz, 1)}}, style).find(">vz \u00b7 t\u00b2 (m/s)<"),
            std::string::npos);
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

TEST(PlotGather, TheAutomaticAxisIsTheOneAGeophysicistWouldTake) {
  const auto axis_of = [](const GatherSection& section) {
    auto copy = section;
    return order_traces(copy, TraceAxis::automatic);
  };
  auto ring = with_spike(8, 0, 0, 0);
  for (std::size_t n = 0; n < 8; ++n) {
    const double angle = 0.1 + 0.7853981634 * double((n + 3) % 8);
    ring.headers[n].receiver_m = {50 + 100 * std::cos(angle), 100 * std::sin(angle), 5};
    ring.headers[n].source_m = {50, 0, 5};
  }
  const auto by_azimuth = axis_of(ring);
  EXPECT_EQ(by_azimuth.axis, TraceAxis::azimuth);
  EXPECT_NEAR(by_azimuth.places[0], 0.1 * 180 / 3.14159265, 1e-6);
  EXPECT_NEAR(by_azimuth.places[7] - by_azimuth.places[0], 315, 1e-6);
  // A well that is not quite upright, and a line that is not quite along y.
  auto well = with_spike(8, 0, 0, 0), crooked = well;
  for (std::size_t n = 0; n < 8; ++n) {
    well.headers[n].receiver_m = {3.0 * double(n), 0, 50.0 * double(n)};
    crooked.headers[n].receiver_m = {3.0 * double(n), 50.0 * double(n), 0};
  }
  EXPECT_EQ(axis_of(well).axis, TraceAxis::depth);
  EXPECT_EQ(axis_of(crooked).axis, TraceAxis::y);
  // A trace of each shot: a section by midpoint; of one midpoint or one receiver by offset.
  auto section = with_spike(8, 0, 0, 0);
  section.shots = 8;
  for (std::size_t n = 0; n < 8; ++n) section.headers[n].source_m[0] = 25 * double(n) - 100;
  EXPECT_EQ(axis_of(section).axis, TraceAxis::midpoint);
  for (std::size_t n = 0; n < 8; ++n) section.headers[n].receiver_m[0] = 300 - section.headers[n].source_m[0];
  EXPECT_EQ(axis_of(section).axis, TraceAxis::offset);
  for (auto& header : section.headers) header.receiver_m[0] = 300;
  EXPECT_EQ(axis_of(section).axis, TraceAxis::offset);
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

/// Shots of 10 receivers each, on lines 5 m apart in y of `a_line` receivers; silent.
GatherSection shots_and_lines(std::size_t shots, std::size_t a_line) {
  auto section = with_spike(10 * shots, 0, 0, 0);
  section.shots = std::int64_t(shots);
  for (std::size_t n = 0; n < section.traces(); ++n) {
    auto& header = section.headers[n];
    header.shot = 101 + std::int64_t(n / 10);
    header.receiver_m = {25.0 * double(n % a_line), 5.0 * double(n % 10 / a_line), 5};
  }
  return section;
}

TEST(PlotGather, ShotsAndLinesOfReceiversAreKeptApart) {
  auto flat = shots_and_lines(3, 10);
  const auto shots = order_traces(flat, TraceAxis::automatic);
  ASSERT_EQ(shots.runs.size(), 3u);
  EXPECT_EQ(shots.run_name, "shot");
  EXPECT_EQ(shots.runs[2].label, "103");
  EXPECT_EQ(shots.runs[2].first, 20u);
  EXPECT_EQ(shots.runs[2].count, 10u);
  EXPECT_TRUE(shots.line_starts.empty());
  auto deep = shots_and_lines(2, 5);
  EXPECT_EQ(order_traces(deep, TraceAxis::automatic).line_starts, (std::vector<std::size_t>{5, 15}));
  auto one = shots_and_lines(1, 5);
  const auto lines = order_traces(one, TraceAxis::automatic);
  EXPECT_EQ(lines.run_name, "y (m)");
  ASSERT_EQ(lines.runs.size(), 2u);
  EXPECT_EQ(lines.runs[1].label, "5");
  EXPECT_EQ(lines.in_each_run, "receiver x 0 to 100 m");
  EXPECT_EQ(shots.in_each_run, "offset 0 to 225 m");
  // A trace of each shot is a section, not a row of gathers.
  auto section = with_spike(10, 0, 0, 0);
  for (std::size_t n = 0; n < 10; ++n) section.headers[n].shot = std::int64_t(n);
  section.shots = 10;
  EXPECT_TRUE(order_traces(section, TraceAxis::automatic).runs.empty());
}

TEST(PlotGather, ALineStandsBetweenTwoShots) {
  const auto pixels = decoded(drawn(shots_and_lines(4, 10), {}));
  const auto frame = frame_of(pixels);
  const double left = frame.left - line + 1, width = frame.right + line - left;
  std::vector<int> dark;
  for (int x = frame.left; x <= frame.right; ++x)
    if (is_dark(pixels.at(x, (frame.top + frame.bottom) / 2))) dark.push_back(x);
  for (int shot = 1; shot < 4; ++shot) {
    const double expected = left + shot * width / 4;
    EXPECT_TRUE(std::any_of(dark.begin(), dark.end(), [&](int x) { return std::fabs(x - expected) < 2.5; }))
        << shot;
  }
  for (const int x : dark) EXPECT_LT(std::fabs(std::remainder(x - left, width / 4)), 2.5) << x;
}

TEST(PlotGather, AThreeDimensionalOffsetIsTheHorizontalDistance) {
  auto section = with_spike(2, 0, 0, 0);
  section.headers[0].receiver_m = {-30, 40, 5};
  section.headers[1].receiver_m = {60, 80, 5};
  EXPECT_EQ(order_traces(section, TraceAxis::offset).places, (std::vector<double>{-50, 100}));
}

TEST(PlotGather, TheDifferenceOfTwoGathersIsWhereTheyDiffer) {
  const auto page = page_of_size("1500x600px");
  GatherStyle style;
  style.difference = true;
  const auto panels_with = [&](float second) {
    std::vector<NamedGather> gathers = {{"a", with_spike(9, 4, 50, 1)}, {"b", with_spike(9, 4, 50, second)}};
    const auto pixels = decoded(
        draw_gathers(std::move(gathers), style, {.clip_percent = 100, .interpolate = false}, page).bytes);
    std::array<int, 3> full{};  // pixels of the strongest colour in each third, less the bar
    for (int y = 0; y < 600; ++y)
      for (int x = 0; x < 1350; ++x) full[std::size_t(x / 450)] += pixels.at(x, y) == strongest;
    return full;
  };
  const auto same = panels_with(1), other = panels_with(0.001f);
  EXPECT_GT(same[0], 50);
  EXPECT_GT(same[1], 50);
  EXPECT_EQ(same[2], 0);
  EXPECT_EQ(other[1], 0);
  EXPECT_GT(other[2], 50);
  auto moved = with_spike(9, 4, 50, 1);
  moved.headers[3].receiver_m[0] += 1;
  EXPECT_THROW(draw_gathers({{"a", with_spike(9, 4, 50, 1)}, {"b", moved}}, style, {}, page), Error);
  EXPECT_THROW(draw_gathers({{"a", with_spike(9, 4, 50, 1)}}, style, {}, page), Error);
}

TEST(PlotGather, OverlaidLinesHaveAColourEach) {
  GatherStyle style;
  style.overlay = true;
  const auto pixels = decoded(draw_gathers({{"a", with_spike(3, 0, 50, 1)}, {"b", with_spike(3, 2, 50, -1)}},
                                           style, {}, page_of_size("900x700px"))
                                  .bytes);
  const auto frame = frame_of(pixels);
  // Where one alone leaves its trace, near the spike: the first to the right, the second to the left.
  const auto of = [&](std::size_t index) {
    const auto colour = pixel_of(line_colour(index)) & 0xffffff;
    Patch patch{0, 900, -1, 700, -1};
    for (int y = frame.top; y <= frame.bottom; ++y)
      for (int x = frame.left; x <= frame.right; ++x)
        if (alike(pixels.at(x, y), colour))
          patch = {patch.count + 1, std::min(patch.left, x), std::max(patch.right, x), 0, 0};
    return patch;
  };
  const double trace = (frame.right - frame.left) / 3.0;
  EXPECT_GT(of(0).right, frame.left + 1.5 * trace);  // 1.4 spacings to the right of the first place
  EXPECT_LT(of(1).left, frame.left + 1.5 * trace);
  EXPECT_GT(of(1).right, frame.left + 2.3 * trace);
}

TEST(PlotGather, InterpolationIsNotAcrossShots) {
  auto section = shots_and_lines(2, 10);
  for (std::size_t n = 0; n < section.samples.size(); ++n) section.samples[n] = n < 10 * 101 ? 1.0f : -1.0f;
  const auto pixels = decoded(drawn(section, {}, {.clip_percent = 100}));
  const auto frame = frame_of(pixels);
  for (int x = frame.left; x <= frame.right; ++x) {
    const auto colour = pixels.at(x, (frame.top + frame.bottom) / 2);
    EXPECT_TRUE(colour == strongest || colour == weakest || std::abs(x - (frame.left + frame.right) / 2) < 4)
        << x;
  }
}

}  // namespace
}  // namespace slipwave::plot::plot_gather_test
