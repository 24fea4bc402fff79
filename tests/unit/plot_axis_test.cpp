// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "long_form.hpp"
#include "plot/axis.hpp"
#include "plot/canvas.hpp"
#include "plot/ticks.hpp"

namespace slipwave::plot::plot_axis_test {
namespace {

/// The number a label shows: true minus signs and raised digits read back.
double number_of(std::string label) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (auto at = label.find(from); at != std::string::npos; at = label.find(from))
      label.replace(at, from.size(), to);
  };
  replace("\u2212", "-");
  replace("\u00b7", "*");
  const char* raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                          "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  for (int digit = 0; digit < 10; ++digit) replace(raised[digit], std::to_string(digit));
  replace("\u207b", "-");
  double factor = 1;
  if (const auto times = label.find('*'); times != std::string::npos) {
    factor = std::stod(label.substr(0, times));
    label = label.substr(times + 1);
  }
  const bool power =
      label.size() > 2 && label.substr(0, 2) == "10" && label != "100" && label != "1000" && label != "10000";
  return factor * (power ? std::pow(10.0, std::stod(label.substr(2))) : std::stod(label));
}

bool is_round(double step) {
  const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  return std::fabs(digit - 1) < 1e-9 || std::fabs(digit - 2) < 1e-9 || std::fabs(digit - 5) < 1e-9;
}

TEST(PlotAxis, TicksAreAllMultiplesOfARoundStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-12, 9), part(-1, 1), length(30, 600);
  for (int trial = 0; trial < 2000; ++trial) {
    const double scale = std::pow(10.0, exponent(random));
    Axis axis{"a", "Pa", scale * part(random), 0};
    axis.high = axis.low + scale * (0.01 + std::fabs(part(random)));
    const auto marks = marks_of(axis, length(random), 9, trial % 2 == 0);
    ASSERT_GE(marks.values.size(), 1u);
    if (marks.values.size() < 2) continue;
    const double step = marks.values[1] - marks.values[0];
    ASSERT_TRUE(is_round(step) || axis.high - axis.low < 1e-5 * std::fabs(axis.low)) << step;
    const double tiny = 1e-6 * step;
    for (std::size_t n = 0; n < marks.values.size(); ++n) {
      EXPECT_NEAR(marks.values[n], step * std::round(marks.values[n] / step), tiny);
      EXPECT_NEAR(marks.values[n], marks.values[0] + double(n) * step, tiny);
    }
    EXPECT_GE(marks.values.front(), axis.low - tiny);
    EXPECT_LE(marks.values.back(), axis.high + tiny);
    EXPECT_LT(marks.values.front() - step, axis.low - tiny) << "one is missing at the low end";
    EXPECT_GT(marks.values.back() + step, axis.high + tiny) << "one is missing at the high end";
  }
}

TEST(PlotAxis, LabelsShowTheirValuesInTheUnitOfTheCaption) {
  const struct {
    double low, high;
    const char* unit;
    double divisor;
    const char* caption;
  } cases[] = {{0, 2500, "m", 1, "a (m)"},
               {0, 17000, "m", 1e3, "a (km)"},
               {-3e-9, 5e-9, "m/s", 1e-9, "a (nm/s)"},
               {0, 4e-5, "s", 1e-6, "a (\u00b5s)"},
               {-3e-6, 5e-6, "1/s", 1e-6, "a (10\u207b\u2076/s)"},
               {0, 3e-6, "m\u00b2/s/Hz", 1e-6, "a (10\u207b\u2076 m\u00b2/s/Hz)"},
               {0, 2e-20, "m/s", 1e-21, "a (10\u207b\u00b2\u00b9 m/s)"},
               {-2e6, 2e6, "Pa", 1e6, "a (MPa)"},
               {0.2, 0.9, "s", 1, "a (s)"},
               {1e7, 3e7, "", 1e6, "a (10\u2076)"},
               {1500, 4700, "m/s", 1, "a (m/s)"}};
  for (const auto& one : cases) {
    const auto marks = marks_of({"a", one.unit, one.low, one.high}, 300, 9, true);
    EXPECT_EQ(marks.caption, one.caption);
    ASSERT_GE(marks.values.size(), 3u);
    for (std::size_t n = 0; n < marks.values.size(); ++n)
      EXPECT_NEAR(number_of(marks.labels[n]) * one.divisor, marks.values[n], 1e-9 * one.high)
          << marks.labels[n];
  }
}

TEST(PlotAxis, LogTicksAreDecadesOrRoundPartsOfThem) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-9, 6), decades(0.4, 12), length(60, 500);
  for (int trial = 0; trial < 1000; ++trial) {
    Axis axis{"a", "s", std::pow(10.0, exponent(random)), 0, true};
    axis.high = axis.low * std::pow(10.0, decades(random));
    const auto marks = marks_of(axis, length(random), 9, trial % 2 == 0);
    for (std::size_t n = 0; n < marks.values.size(); ++n) {
      const bool three = is_round(marks.values[n] / 3);
      EXPECT_TRUE(is_round(marks.values[n]) || three || axis.high / axis.low < 40) << marks.values[n];
      EXPECT_NEAR(number_of(marks.labels[n]), marks.values[n], 1e-6 * marks.values[n]) << marks.labels[n];
      EXPECT_GE(marks.values[n], axis.low * (1 - 1e-6));
      EXPECT_LE(marks.values[n], axis.high * (1 + 1e-6));
    }
    EXPECT_TRUE(axis.high / axis.low < 100 || marks.values.size() + marks.minor.size() >= 2);
  }
}

TEST(PlotAxis, LabelsNeverTouchEachOther) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-10, 8), length(25, 600), size(5, 12);
  for (int trial = 0; trial < (long_form() ? 1000 : 300); ++trial) {
    Axis axis{"a", "", -std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random))};
    axis.log = trial % 3 == 0;
    if (axis.log) axis.low = axis.high * 1e-4;
    const double long_pt = length(random), text_pt = size(random);
    const auto across = marks_of(axis, long_pt, text_pt, true),
               down = marks_of(axis, long_pt, text_pt, false);
    const Scale scale(axis, 0, long_pt);
    for (std::size_t n = 1; n < across.values.size(); ++n)
      EXPECT_GT(scale.place(across.values[n]) - scale.place(across.values[n - 1]),
                (text_width(across.labels[n], text_pt) + text_width(across.labels[n - 1], text_pt)) / 2);
    for (std::size_t n = 1; n < down.values.size(); ++n)
      EXPECT_GT(scale.place(down.values[n]) - scale.place(down.values[n - 1]), cap_height * text_pt);
  }
}

TEST(PlotAxis, CountsHaveWholeTicks) {
  const auto marks = marks_of({"trace", "", 0.5, 3.5, false, true}, 400, 9, true);
  EXPECT_EQ(marks.labels, (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_TRUE(marks.minor.empty());
}

TEST(PlotAxis, AScaleGoesThereAndBack) {
  for (const bool log : {false, true}) {
    const Axis axis{"a", "", 0.02, 50, log};
    const Scale scale(axis, 300, 20);  // upwards
    EXPECT_NEAR(scale.place(0.02), 300, 1e-9);
    EXPECT_NEAR(scale.place(50), 20, 1e-9);
    EXPECT_NEAR(scale.place(log ? 1.0 : 25.01), 160, 1e-9);  // the middle
    for (const double value : {0.02, 0.5, 7.0, 50.0})
      EXPECT_NEAR(scale.value(scale.place(value)), value, 1e-9);
  }
}

TEST(PlotAxis, WidensLogAxesToRoundNumbers) {
  Axis axis{"a", "", 0.034, 270, true};
  widen(axis, 0);
  EXPECT_NEAR(axis.low, 0.02, 1e-12);
  EXPECT_NEAR(axis.high, 500, 1e-9);
  Axis flat{"a", "", 3, 3};
  widen(flat, 0);
  EXPECT_LT(flat.low, 3);
  EXPECT_GT(flat.high, 3);
}

}  // namespace
}  // namespace slipwave::plot::plot_axis_test
