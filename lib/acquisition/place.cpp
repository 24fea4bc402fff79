// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/place.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

/// The number behind a word, with its sign; nothing is 0.
double shift_behind(std::string_view text, std::string_view word) {
  const auto rest = text.substr(word.size());
  if (rest.empty()) return 0;
  if (rest.front() == '+' || rest.front() == '-') try {
      return parse_number(rest);
    } catch (const Error&) {
    }
  throw Error("found '" + excerpt(std::string(text)) + "', expected " + std::string(word) + ", " +
                  std::string(word) + "+D or " + std::string(word) + "-D",
              ErrorKind::usage);
}

bool begins_with_word(std::string_view text) {
  return !text.empty() && ((text.front() >= 'a' && text.front() <= 'z'));
}

/// Takes the sign that counts a coordinate from the source off its numbers; says whether there was one.
bool take_relative_sign(std::string& range) {
  bool any = false;
  auto parts = split(range, ':');
  for (std::size_t n = 0; n < std::min<std::size_t>(parts.size(), 2); ++n)
    if (parts[n].size() > 1 && parts[n].front() == '+') {
      parts[n].erase(0, 1);
      any = true;
    }
  range = parts[0];
  for (std::size_t n = 1; n < parts.size(); ++n) range += ":" + parts[n];
  return any;
}

/// Errors quote what was typed, not what was made of it.
template <int D>
std::vector<std::array<double, D>> points_of(const std::string& plain, const std::string& typed) {
  try {
    return parse_line<D>(plain);
  } catch (const Error& error) {
    std::string sentence = error.what();
    const auto at = sentence.find('\'' + plain + '\'');
    if (at != std::string::npos) sentence.replace(at + 1, plain.size(), excerpt(typed));
    throw Error(sentence, error.kind());
  }
}

}  // namespace

GivenDepth parse_depth(std::string_view text) {
  if (text.starts_with("surface")) return {DepthFrom::surface, shift_behind(text, "surface")};
  if (text.starts_with("floor")) return {DepthFrom::floor, shift_behind(text, "floor")};
  if (begins_with_word(text))
    throw Error("found '" + excerpt(std::string(text)) + "', expected a depth in m, surface+D or floor-D",
                ErrorKind::usage);
  return {DepthFrom::datum, parse_number(text)};
}

template <int D>
std::vector<Place> parse_places(const std::string& text, bool of_receivers) {
  auto parts = split(text, ',');
  Place common;
  if (parts.size() == D) {
    if (begins_with_word(parts.back())) {
      const auto depth = parse_depth(parts.back());
      common.depth_from = depth.from;
      parts.back() = shown(depth.below_m);
    }
    for (std::size_t axis = 0; of_receivers && axis < D; ++axis)
      if (common.depth_from == DepthFrom::datum || axis + 1 < D)
        if (take_relative_sign(parts[axis])) common.relative |= std::uint8_t(1U << axis);
  }
  std::string plain = parts[0];
  for (std::size_t n = 1; n < parts.size(); ++n) plain += "," + parts[n];
  const auto points = points_of<D>(plain, text);
  for (std::size_t axis = 0; of_receivers && axis + 1 < D; ++axis)
    if ((common.relative >> axis & 1U) == 0 &&
        std::all_of(points.begin(), points.end(), [&](const auto& point) { return point[axis] < 0; }))
      common.relative_if_outside |= std::uint8_t(1U << axis);
  std::vector<Place> places;
  places.reserve(points.size());
  for (const auto& point : points) {
    places.push_back(common);
    for (std::size_t axis = 0; axis < D; ++axis) places.back().at_m[axis + 1 == D ? 2 : axis] = point[axis];
  }
  if constexpr (D == 2)
    for (auto& place : places)
      if (place.relative & 2U) place.relative = std::uint8_t((place.relative & 1U) | 4U);
  return places;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_places);

}  // namespace slipwave
