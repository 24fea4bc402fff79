// SPDX-License-Identifier: BSD-3-Clause
#include "io/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/words.hpp"

namespace slipwave {
namespace {

struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The database of udunits, read when a unit is first looked up.
ut_system* units() {
  static const std::unique_ptr<ut_system, FreeSystem> system = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, FreeSystem>(ut_read_xml(nullptr));
  }();
  if (!system) throw Error("found no database of units, expected that of the package libudunits2-data");
  return system.get();
}

Unit parsed(const std::string& text) { return Unit(ut_parse(units(), text.c_str(), UT_UTF8)); }

/// For udunits a radian is the number 1, and numbers are angles.
bool is_angle(const Unit& unit) {
  std::array<char, 128> text{};
  const int length = ut_format(unit.get(), text.data(), text.size() - 1, UT_DEFINITION | UT_ASCII);
  return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

bool is_word(const std::string& text, std::size_t at, std::size_t length) {
  const auto letter = [&](std::size_t n) {
    return n < text.size() && std::isalpha(static_cast<unsigned char>(text[n])) != 0;
  };
  return !(at > 0 && letter(at - 1)) && !letter(at + length);
}

void refuse_grains(const std::string& text) {
  for (auto at = text.find("gr"); at != std::string::npos; at = text.find("gr", at + 1))
    if (is_word(text, at, 2))
      throw Error("found the unit '" + excerpt(text) + "', in which gr is the grain, expected g or kg");
}

/// Puts a name that udunits knows in place of each word that is another's for it.
std::string respelt(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> names = {{{"f", "ft"},
                                                                                    {"usec", "us"},
                                                                                    {"msec", "ms"},
                                                                                    {"sec", "s"},
                                                                                    {"gm", "g"},
                                                                                    {"gms", "g"},
                                                                                    {"k", "kg"},
                                                                                    {"c", "cm"},
                                                                                    {"mt", "m"},
                                                                                    {"mtr", "m"},
                                                                                    {"deg", "degree"},
                                                                                    {"gcc", "g/cc"}}};
  std::string result;
  for (std::size_t n = 0; n < text.size();) {
    std::size_t end = n;
    while (end < text.size() && std::isalpha(static_cast<unsigned char>(text[end])) != 0) ++end;
    const std::string_view word = std::string_view(text).substr(n, end - n);
    const auto* const known =
        std::find_if(names.begin(), names.end(), [&](const auto& name) { return name.first == word; });
    if (word.empty())
      result += text[end++];
    else
      result += known == names.end() ? word : known->second;
    n = end;
  }
  return result;
}

/// Products of factors are rounded in their last digit: g/cm3 shall be 1000 kg/m3.
double without_rounding(double factor) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.15g", factor);
  return std::strtod(text.data(), nullptr);
}

struct Kind {
  std::string_view into, what;
};
constexpr std::array<Kind, 7> kinds = {{{"m", "one of length, as m, km or ft"},
                                        {"m s-1", "one of speed, as m s-1, km s-1 or ft s-1"},
                                        {"kg m-3", "one of density, as kg m-3 or g cm-3"},
                                        {"degree", "one of angles, as degree or radian"},
                                        {"1", "none, or 1"},
                                        {"s", "one of time, as s or ms"},
                                        {"Pa", "one of pressure, as Pa or GPa"}}};

}  // namespace

std::optional<UnitConversion> unit_conversion(const std::string& unit, const std::string& into) {
  const std::string name(trimmed(unit));
  if (name == into) return UnitConversion{};
  refuse_grains(name);
  const Unit from = parsed(name), to = parsed(into);
  if (!from || !to || is_angle(from) != is_angle(to)) return {};
  const std::unique_ptr<cv_converter, FreeConverter> converter(ut_get_converter(from.get(), to.get()));
  if (!converter) return {};
  const double at_zero = cv_convert_double(converter.get(), 0),
               at_one = cv_convert_double(converter.get(), 1);
  if (std::isfinite(at_zero)) return UnitConversion{without_rounding(at_one - at_zero), at_zero, false};
  if (into != "m s-1") return {};
  return UnitConversion{without_rounding(at_one), 0, true};
}

std::optional<UnitConversion> spelt_unit_conversion(const std::string& unit, const std::string& into) {
  const auto small = lower(trimmed(unit));
  for (const auto& spelling : {std::string(trimmed(unit)), small, respelt(small)})
    if (auto found = unit_conversion(spelling, into)) return found;
  return {};
}

std::string unit_refusal(const std::string& unit, const std::string& into) {
  const auto* const kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& of) { return of.into == into; });
  return "found the unit '" + excerpt(unit) + "', expected " +
         (kind == kinds.end() ? "one that converts to " + into : std::string(kind->what));
}

}  // namespace slipwave
