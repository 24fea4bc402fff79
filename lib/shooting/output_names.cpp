// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/output_names.hpp"

#include "base/error.hpp"

namespace slipwave {
namespace {

void replace(std::string& text, const std::string& mark, const std::string& by) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

}  // namespace

std::string name_for(std::string pattern, std::size_t shot, const std::string& component) {
  replace(pattern, "{shot}", std::to_string(shot));
  replace(pattern, "{component}", component);
  return pattern;
}

void check_marks(const std::string& pattern) {
  for (auto at = pattern.find('{'); at != std::string::npos; at = pattern.find('{', at + 1)) {
    const auto end = pattern.find('}', at);
    if (end == std::string::npos) return;
    const std::string mark = pattern.substr(at, end - at + 1);
    if (mark != "{shot}" && mark != "{component}")
      throw Error("found " + mark + " in the name " + pattern + ", expected {shot} or {component}",
                  ErrorKind::usage);
  }
}

bool holds(const std::string& pattern, const std::string& mark) {
  return pattern.find(mark) != std::string::npos;
}

std::string unstable_name(std::string pattern) { return pattern.insert(pattern.rfind('/') + 1, "unstable-"); }

}  // namespace slipwave
