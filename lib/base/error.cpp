#include "base/error.hpp"

#include <charconv>

namespace slipwave {

std::string shown(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end.ptr);
}

}  // namespace slipwave
