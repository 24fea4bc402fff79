// SPDX-License-Identifier: BSD-3-Clause
#include "rock/property_range.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace slipwave {

bool is_in_range(const PropertyRow& row, double value) {
  return value >= row.least && value <= row.largest && (std::isfinite(value) || value == row.if_absent);
}

std::string expected_values(const PropertyRow& row) {
  std::string finite = "a finite number";
  if (std::isinf(row.largest) && row.if_absent == PropertyRow::infinite)
    return "a number of at least " + shown(row.least) + ", or inf";
  if (std::isinf(row.least) && std::isinf(row.largest)) return finite;
  if (std::isinf(row.largest))
    return finite + (row.least == 0 ? " not below zero" : " of at least " + shown(row.least));
  return finite + " from " + shown(row.least) + " to " + shown(row.largest);
}

std::string shown_float(double value) {
  if (std::isnan(value)) return "NaN";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, float(value));
  return std::string(text, end.ptr);
}

}  // namespace slipwave
