// SPDX-License-Identifier: BSD-3-Clause
#include "io/column_header.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"

namespace slipwave {

UnitConversion ColumnHeader::conversion(const std::string& into) const {
  if (unit.empty()) return {};
  if (into.empty())
    throw Error("column " + excerpt(name) + ": found the unit '" + excerpt(unit) + "', expected none");
  const auto found = in_place("column " + excerpt(name), [&] { return spelt_unit_conversion(unit, into); });
  if (!found) throw Error("column " + excerpt(name) + ": " + unit_refusal(unit, into));
  return *found;
}

ColumnHeader column_header(std::string_view cell) {
  cell = trimmed(cell);
  const auto bracket = cell.find_first_of("([");
  if (bracket != std::string_view::npos && (cell.back() == ')' || cell.back() == ']'))
    return {lower(trimmed(cell.substr(0, bracket))),
            std::string(trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2)))};
  const auto dot = cell.find('.');
  if (dot != std::string_view::npos && dot > 0)
    return {lower(trimmed(cell.substr(0, dot))), std::string(trimmed(cell.substr(dot + 1)))};
  return {lower(cell), ""};
}

std::vector<ColumnHeader> column_headers(const std::vector<std::string_view>& words) {
  std::vector<ColumnHeader> headers;
  for (const auto word : words) {
    auto header = column_header(word);
    if (header.name.empty() && !header.unit.empty() && !headers.empty() && headers.back().unit.empty())
      headers.back().unit = header.unit;
    else
      headers.push_back(std::move(header));
  }
  return headers;
}

bool are_headers(const std::vector<std::string_view>& words) {
  if (words.empty() || std::any_of(words.begin(), words.end(), is_number)) return false;
  for (const auto word : words) {
    auto point = std::string(word);
    std::replace(point.begin(), point.end(), ',', '.');
    if (point != word && is_number(point))
      throw Error("found '" + excerpt(std::string(word)) +
                  "', expected a name, or a number with a decimal point");
  }
  return true;
}

}  // namespace slipwave
