// SPDX-License-Identifier: BSD-3-Clause
#include "model/points_file.hpp"

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {
namespace {

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line.substr(0, line.find('#'))) {}
  /// Empty when there is none left.
  std::string_view next() {
    constexpr std::string_view between = " \t,\r\f\v";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(between), rest_.size()));
    const auto word = rest_.substr(0, rest_.find_first_of(between));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

/// Calls `body` with every line and its number, until it returns false.
template <class Body>
void for_each_line(std::string_view text, const Body& body) {
  // Some editors begin a text with this mark.
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    if (!body(text.substr(0, end), number) || end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

template <int D>
std::vector<NumberedPoint<D>> points_of_text(std::string_view text) {
  std::vector<NumberedPoint<D>> points;
  for_each_line(text, [&](std::string_view line, int number) {
    Words words(line);
    NumberedPoint<D> point{{}, number};
    std::array<std::string_view, D> found;
    std::size_t count = 0;
    for (auto word = words.next(); !word.empty(); word = words.next()) {
      if (count < D) found[count] = word;
      ++count;
    }
    if (count == 0) return true;
    const auto place = [&] { return "line " + std::to_string(number) + ": "; };
    if (count != D)
      throw Error(place() + "found " + std::to_string(count) + (count == 1 ? " value" : " values") +
                  (D == 2 ? ", expected X Z" : ", expected X Y Z"));
    try {
      for (std::size_t axis = 0; axis < D; ++axis) point.at[axis] = parse_number(found[axis]);
    } catch (const Error& error) {
      throw Error(place() + error.what());  // bad data, not a bad command line
    }
    points.push_back(point);
    return true;
  });
  return points;
}

std::vector<NumberedPoint<2>> read_points(const std::string& path) {
  const auto text = read_text(path);
  return in_place(shown_input(path), [&] { return points_of_text<2>(text); });
}

std::size_t columns_of_text(std::string_view text) {
  std::size_t columns = 0;
  for_each_line(text, [&](std::string_view line, int) {
    Words words(line);
    while (!words.next().empty()) ++columns;
    return columns == 0;
  });
  return columns;
}

template std::vector<NumberedPoint<2>> points_of_text<2>(std::string_view);
template std::vector<NumberedPoint<3>> points_of_text<3>(std::string_view);

}  // namespace slipwave
