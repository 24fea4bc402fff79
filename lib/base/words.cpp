// SPDX-License-Identifier: BSD-3-Clause
#include "base/words.hpp"

#include <cctype>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = char(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

bool is_number(std::string_view text) {
  try {
    parse_number(text);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace slipwave
