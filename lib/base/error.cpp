#include "base/error.hpp"

#include <charconv>
#include <cmath>

namespace slipwave {

std::string shown(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end.ptr);
}

std::string shown(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return shown(value);
  const double unit = std::pow(10, digits - 1 - std::floor(std::log10(std::abs(value))));
  return shown(std::round(value * unit) / unit);
}

}  // namespace slipwave
