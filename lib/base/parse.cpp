// SPDX-License-Identifier: BSD-3-Clause
#include "base/parse.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {
namespace {

constexpr double most_points = 1e7;

[[noreturn]] void refuse(std::string_view found, const std::string& expected) {
  throw Error("found '" + excerpt(std::string(found)) + "', expected " + expected, ErrorKind::usage);
}

template <int D>
std::string point_notation() {
  return D == 2 ? "a point X,Z" : "a point X,Y,Z";
}

template <int D>
std::string line_notation() {
  return D == 2 ? "points X0:X1:DX,Z or X,Z" : "points X0:X1:DX,Y,Z or X,Y,Z";
}

template <int D>
std::string box_notation() {
  return D == 2 ? "a box X0:X1,Z0:Z1" : "a box X0:X1,Y0:Y1,Z0:Z1";
}

/// A number inside a larger notation: what is expected names that notation.
double number_of(std::string_view text, std::string_view whole, const std::string& notation) {
  double value = 0;
  std::string_view digits = text;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  const auto end = digits.data() + digits.size();
  const auto [stop, failed] = std::from_chars(digits.data(), end, value);
  if (failed == std::errc() && stop == end && std::isfinite(value)) return value;
  const bool beyond = failed == std::errc::result_out_of_range && stop == end;
  if (whole == text) refuse(whole, notation + (beyond ? " from 1e-307 to 1e308 in size" : ""));
  refuse(whole, notation + " ('" + excerpt(std::string(text)) + "' " +
                    (beyond ? "is too large or too small" : "is not a number") + ")");
}

std::int64_t integer_of(std::string_view text, std::string_view whole, const std::string& notation) {
  std::int64_t value = 0;
  const auto end = text.data() + text.size();
  const auto [stop, failed] = std::from_chars(text.data(), end, value);
  if (failed == std::errc() && stop == end) return value;
  refuse(whole, notation);
}

/// The coordinates along one axis: a number, or X0:X1:DX.
std::vector<double> parse_range(std::string_view text, std::string_view whole, const std::string& notation) {
  const auto parts = split(text, ':');
  if (parts.size() == 1) return {number_of(text, whole, notation)};
  if (parts.size() != 3) refuse(whole, notation);
  std::array<double, 3> end{};
  for (std::size_t i = 0; i < 3; ++i) end[i] = number_of(parts[i], whole, notation);
  const auto [first, last, step] = end;
  const double steps = first == last ? 0 : (last - first) / step;
  const std::string range = "in '" + std::string(whole) + "' ";
  if (step == 0 || steps < 0) {
    throw Error(
        range + "a step of " + shown(step) + " does not lead from " + shown(first) + " to " + shown(last),
        ErrorKind::usage);
  }
  if (!(steps < most_points)) {
    throw Error(
        range + "found " + shown(std::floor(steps) + 1) + " points, expected at most " + shown(most_points),
        ErrorKind::usage);
  }
  const double whole_steps = std::round(steps);
  if (std::abs(steps - whole_steps) > 1e-6) {
    throw Error(range + "found " + shown(std::round(steps * 1000) / 1000) + " steps of " + shown(step) +
                    " from " + shown(first) + " to " + shown(last) + ", expected a whole number",
                ErrorKind::usage);
  }
  std::vector<double> values(std::size_t(whole_steps) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = first + double(i) * step;
  values.back() = last;
  return values;
}

}  // namespace

double parse_number(std::string_view text) { return number_of(text, text, "a number"); }

std::int64_t parse_integer(std::string_view text) { return integer_of(text, text, "a whole number"); }

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::string joined(const std::vector<std::string>& parts, const std::string& last) {
  std::string all;
  for (std::size_t n = 0; n < parts.size(); ++n)
    all += (n == 0 ? "" : n + 1 < parts.size() ? ", " : last) + parts[n];
  return all;
}

std::string joined_by(const std::vector<std::string>& parts, std::string_view between) {
  std::string all;
  for (std::size_t n = 0; n < parts.size(); ++n) (n == 0 ? all : all += between) += parts[n];
  return all;
}

std::vector<double> parse_numbers(std::string_view text, char separator) {
  const std::string notation = std::string("numbers with '") + separator + "' between them";
  std::vector<double> numbers;
  for (const auto& part : split(text, separator)) numbers.push_back(number_of(part, text, notation));
  return numbers;
}

template <int D>
std::array<double, D> parse_point(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != D) refuse(text, point_notation<D>());
  std::array<double, D> point{};
  for (int axis = 0; axis < D; ++axis) {
    point[std::size_t(axis)] = number_of(parts[std::size_t(axis)], text, point_notation<D>());
  }
  return point;
}

template <int D>
std::vector<std::array<double, D>> parse_line(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != D) refuse(text, line_notation<D>());
  std::array<std::vector<double>, D> along;
  double points = 1;
  for (std::size_t axis = 0; axis < D; ++axis) {
    along[axis] = parse_range(parts[axis], text, line_notation<D>());
    points *= double(along[axis].size());
  }
  if (points > most_points) {
    throw Error("found '" + std::string(text) + "' with " + shown(points) + " points, expected at most " +
                    shown(most_points),
                ErrorKind::usage);
  }
  std::vector<std::array<double, D>> line;
  line.reserve(std::size_t(points));
  for (std::size_t n = 0; n < std::size_t(points); ++n) {
    std::size_t rest = n;
    std::array<double, D> point{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      point[axis] = along[axis][rest % along[axis].size()];
      rest /= along[axis].size();
    }
    line.push_back(point);
  }
  return line;
}

template <int D>
Box<D> parse_box(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != D) refuse(text, box_notation<D>());
  Box<D> box;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto ends = split(parts[axis], ':');
    if (ends.size() != 2) refuse(text, box_notation<D>());
    box.low_m[axis] = number_of(ends[0], text, box_notation<D>());
    box.high_m[axis] = number_of(ends[1], text, box_notation<D>());
    if (!(box.low_m[axis] < box.high_m[axis])) {
      refuse(text, box_notation<D>() + " with each low end below its high end");
    }
  }
  return box;
}

template <int D>
std::array<double, D> parse_size(std::string_view text) {
  const std::string notation = D == 2 ? "a size LXxLZ" : "a size LXxLYxLZ";
  const auto parts = split(text, 'x');
  if (parts.size() != D) refuse(text, notation);
  std::array<double, D> size{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    size[axis] = number_of(parts[axis], text, notation);
    if (!(size[axis] > 0)) refuse(text, notation + " above zero");
  }
  return size;
}

template <int D>
std::array<std::int64_t, D> parse_shape(std::string_view text) {
  const std::string notation =
      D == 2 ? "whole numbers NXxNZ above zero" : "whole numbers NXxNYxNZ above zero";
  const auto parts = split(text, 'x');
  if (parts.size() != D) refuse(text, notation);
  std::array<std::int64_t, D> shape{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    shape[axis] = integer_of(parts[axis], text, notation);
    if (shape[axis] <= 0) refuse(text, notation);
  }
  return shape;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_point);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_line);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_box);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_size);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_shape);

}  // namespace slipwave
