// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace slipwave::plot {

/// Marks on an axis: those with a label and the smaller ones between them, both ascending.
struct Ticks {
  std::vector<double> major, minor;
};

/// All multiples of `step`, one of 1, 2 or 5 times a power of ten, from low to high, ends included (to 1e-9
/// of a step); and of a fifth or half of it. step > 0, low <= high.
Ticks linear_ticks(double low, double high, double step);

/// The least of 1, 2, 5 times a power of ten that is at least `least` (> 0), and the next one above `step`.
double round_step(double least);
double next_step(double step);

/// All d 10^n from low to high (0 < low < high). `density` 1, 2, 5: major ticks at d = 1; 1 and 3; 1, 2
/// and 5. Negative: a tick each -density decades. Minor ones at d = 2 .. 9 (at each decade where density <
/// 0).
Ticks log_ticks(double low, double high, int density);

/// Numbers as labels, all with the same digits behind the point, as many as the step asks for; with a true
/// minus sign.
std::vector<std::string> linear_labels(const std::vector<double>& ticks, double step);
/// A number above zero by itself: "0.1", "20", beyond 0.001 .. 10000 "10⁻⁵" and "2.5·10⁶".
std::string log_label(double tick);

/// A number as an exponent: "⁻¹·⁵" for "-1.5".
std::string raised(const std::string& number);
/// "kg/m³" for "kg/m3", "m/s²" for "m/s2".
std::string typeset_unit(std::string unit);
/// "10⁻⁹"; "" for exponent 0.
std::string power_of_ten(int exponent);

/// 10^exponent times a unit: "nm/s" for 10^-9 m/s, "kPa", "10⁻⁶/s" for 10^-6 1/s; with the power before it
/// where that has no prefix, or the unit takes none: "10⁶ kg/(m² s)".
std::string multiplied_unit(int exponent, const std::string& unit);

/// The exponent, a multiple of 3, by which an axis whose numbers reach `largest` is best divided; 0 from
/// 0.01 up to below 100000.
int axis_exponent(double largest);

}  // namespace slipwave::plot
