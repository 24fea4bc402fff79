// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.hpp"

#include <charconv>
#include <cmath>

#include "base/utf8.hpp"

namespace slipwave {

std::string excerpt(const std::string& text) {
  constexpr std::size_t most = 60;
  return printable(text.size() <= most ? text : text.substr(0, most) + "...");
}

std::string printable(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const auto length = utf8_length(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    // U+0080 to U+009F, C2 80 to C2 9F, are control characters too.
    const bool control = first < 0x20 || first == 0x7f ||
                         (length == 2 && first == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0);
    if (length == 0 || control) {
      line += text[at] == '\n' ? ' ' : '?';
    } else {
      line.append(text, at, length);
    }
    at += length == 0 ? 1 : length;
  }
  return line;
}

std::string shown(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end.ptr);
}

std::string shown(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return shown(value);
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1);
  double rounded = 0;
  std::from_chars(text, end.ptr, rounded);
  return shown(rounded);
}

std::string shown_to_thousandths(double value) { return shown(std::round(value * 1000) / 1000); }

void refuse(const std::string& sentence) { throw Error(sentence, ErrorKind::usage); }

}  // namespace slipwave
