// SPDX-License-Identifier: BSD-3-Clause
#include "plot/ticks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <utility>

namespace slipwave::plot {
namespace {

/// `count` * step, without the rounding error that 3 * 0.1 has.
double multiple(std::int64_t count, double step) {
  const int exponent = int(std::floor(std::log10(step) + 1e-9));
  if (exponent >= 0) return double(count) * std::round(step);
  const double scale = std::pow(10.0, -exponent);
  return double(count) * std::round(step * scale) / scale;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> found;
  const auto first = std::int64_t(std::ceil(low / step - 1e-9));
  const auto last = std::int64_t(std::floor(high / step + 1e-9));
  for (auto n = first; n <= last; ++n) found.push_back(multiple(n, step));
  return found;
}

/// First digit of a round step: 1, 2 or 5.
int digit_of(double step) {
  const int exponent = int(std::floor(std::log10(step) + 1e-9));
  return int(std::lround(step / std::pow(10.0, exponent)));
}

}  // namespace

double round_step(double least) {
  const int exponent = int(std::floor(std::log10(least)));
  for (const int power : {exponent, exponent + 1}) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double step = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
      if (step >= least * (1 - 1e-12)) return step;
    }
  }
  return std::pow(10.0, exponent + 2);
}

double next_step(double step) { return round_step(step * 1.01); }

Ticks linear_ticks(double low, double high, double step) {
  Ticks ticks{multiples(low, high, step), {}};
  const double part = digit_of(step) == 2 ? step / 4 : step / 5;
  const auto first = std::int64_t(std::ceil(low / part - 1e-9));
  const auto last = std::int64_t(std::floor(high / part + 1e-9));
  const int parts = digit_of(step) == 2 ? 4 : 5;
  for (auto n = first; n <= last; ++n) {
    if (n % parts != 0) ticks.minor.push_back(double(n) * part);
  }
  return ticks;
}

Ticks log_ticks(double low, double high, int density) {
  Ticks ticks;
  const auto inside = [&](double value) { return value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9); };
  const int first = int(std::floor(std::log10(low) - 1e-9)), last = int(std::ceil(std::log10(high) + 1e-9));
  for (int n = first; n <= last; ++n) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = n < 0 ? digit / std::pow(10.0, -n) : digit * std::pow(10.0, n);
      if (!inside(value)) continue;
      if (density < 0) {
        if (digit == 1) (n % -density == 0 ? ticks.major : ticks.minor).push_back(value);
        continue;
      }
      const bool major =
          digit == 1 || (density == 2 && digit == 3) || (density == 5 && (digit == 2 || digit == 5));
      (major ? ticks.major : ticks.minor).push_back(value);
    }
  }
  return ticks;
}

std::vector<std::string> linear_labels(const std::vector<double>& ticks, double step) {
  const int digits = std::max(0, -int(std::floor(std::log10(step) + 1e-9)));
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, std::fabs(tick));
    const bool below = tick < 0 && std::fabs(tick) > step / 2;
    labels.push_back((below ? "\u2212" : "") + std::string(text.data()));
  }
  return labels;
}

std::string raised(const std::string& number) {
  static const std::array<const char*, 10> digits = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                     "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text;
  for (const char c : number) {
    if (c >= '0' && c <= '9') text += digits[std::size_t(c - '0')];
    if (c == '-') text += "\u207b";
    if (c == '.') text += "\u00b7";
  }
  return text;
}

std::string typeset_unit(std::string unit) {
  for (const auto* power : {"m3", "s2"})
    if (const auto at = unit.find(power); at != std::string::npos)
      unit.replace(at + 1, 1, raised({power[1]}));
  return unit;
}

std::string power_of_ten(int exponent) {
  return exponent == 0 ? "" : "10" + raised(std::to_string(exponent));
}

std::string multiplied_unit(int exponent, const std::string& unit) {
  if (exponent == 0) return unit;
  const std::pair<int, const char*> prefixes[] = {
      {-15, "f"}, {-12, "p"}, {-9, "n"}, {-6, "\u00b5"}, {-3, "m"}, {3, "k"}, {6, "M"}, {9, "G"}, {12, "T"}};
  const auto prefix = std::find_if(std::begin(prefixes), std::end(prefixes),
                                   [&](const auto& row) { return row.first == exponent; });
  for (const std::string base : {"m", "s", "Pa", "Hz"}) {
    const bool alone = unit == base || unit.starts_with(base + "/") || unit.starts_with(base + " ");
    const bool usual = exponent < 0 || base == "Pa" || base == "Hz" || (base == "m" && exponent == 3);
    if (alone && usual && prefix != std::end(prefixes)) return prefix->second + unit;
  }
  if (unit.starts_with("1/")) return power_of_ten(exponent) + unit.substr(1);
  return power_of_ten(exponent) + (unit.empty() ? "" : " " + unit);
}

std::string log_label(double tick) {
  const auto shown = [](double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return std::string(text.data());
  };
  if (tick >= 0.9e-3 && tick <= 1.1e4) return shown(tick);
  const int exponent = int(std::floor(std::log10(tick) + 1e-9));
  const auto digits = shown(tick / std::pow(10.0, exponent));
  return (digits == "1" ? "" : digits + "\u00b7") + power_of_ten(exponent);
}

int axis_exponent(double largest) {
  if (!(largest > 0) || (largest >= 0.01 && largest < 1e5)) return 0;
  return 3 * int(std::floor(std::log10(largest) / 3 + 1e-9));
}

}  // namespace slipwave::plot
