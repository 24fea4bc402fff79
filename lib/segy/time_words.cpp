// SPDX-License-Identifier: BSD-3-Clause
#include "segy/time_words.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "segy/geometry.hpp"

namespace slipwave::segy {
namespace {

constexpr int first_time = 95, last_time = 113;  // bytes of the words that the time scalar applies to
constexpr double largest_word = 32767;
bool holds(double value) { return is_whole(value) && std::fabs(value) <= largest_word; }

bool is_other_time(const Field& field) {
  return field.byte >= first_time && field.byte <= last_time && field.name != "delrt";
}

/// The words in units of another scalar, or nothing where one would be rounded.
std::optional<TraceWords> in_units_of(TraceWords words, std::int64_t scalar) {
  const std::int64_t before = words.get("tscal");
  for (const Field& field : TraceLayout::fields) {
    if (!is_other_time(field) || scalar == before) continue;
    const FieldName<TraceLayout> name(field);
    const double value = scaled(words.get(name), before) / scaled(1, scalar);
    if (!holds(value)) return std::nullopt;
    words.set(name, std::llround(value));
  }
  words.set("tscal", scalar);
  return words;
}

}  // namespace

bool is_whole(double value) { return std::fabs(value - std::nearbyint(value)) <= 1e-6; }

void set_first_sample(TraceWords& words, double start_s, bool has_scalar) {
  const double ms = start_s * 1e3;
  const auto hold = [&](std::int64_t scalar) {
    const double word = ms / scaled(1, scalar);
    const auto others = holds(word) ? in_units_of(words, scalar) : std::nullopt;
    if (!others) return false;
    words = *others;
    words.set("delrt", std::llround(word));
    return true;
  };
  if (!has_scalar && holds(ms)) {
    words.set("delrt", std::llround(ms));
    return;
  }
  for (const std::int64_t scalar : {words.get("tscal"), std::int64_t(1), std::int64_t(-10),
                                    std::int64_t(-100), std::int64_t(-1000), std::int64_t(-10000)})
    if (has_scalar && hold(scalar)) return;
  throw Error("first sample at " + shown(start_s, 9) + " s, " +
              (has_scalar ? "SEG-Y holds whole numbers of 16 bits, of 1 ms down to 0.1 us"
                          : "Seismic Unix and SEG-Y revision 0 hold whole milliseconds up to 32.767 s; "
                            "revision 1 holds fractions"));
}

bool apply_time_scalar(TraceWords& words) {
  const std::int64_t scalar = words.get("tscal");
  bool rounded = false;
  if (scalar != 0 && scalar != 1) {
    const double first_ms = scaled(words.get("delrt"), scalar);
    for (const Field& field : TraceLayout::fields) {
      if (!is_other_time(field)) continue;
      const FieldName<TraceLayout> name(field);
      const double ms = scaled(words.get(name), scalar);
      rounded = rounded || !is_whole(ms);
      words.set(name, std::llround(ms));
    }
    set_first_sample(words, first_ms * 1e-3, false);
  }
  words.set("tscal", 1);
  return rounded;
}

}  // namespace slipwave::segy
