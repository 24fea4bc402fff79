// SPDX-License-Identifier: BSD-3-Clause
#include "geology/points_file.hpp"

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "io/column_header.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {
namespace {

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line.substr(0, line.find('#'))) {}
  /// Empty when there is none left.
  std::string_view next() {
    constexpr std::string_view between = " \t,;\r\f\v";
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

std::vector<std::string_view> words_of(std::string_view line) {
  Words words(line);
  std::vector<std::string_view> all;
  for (auto word = words.next(); !word.empty(); word = words.next()) all.push_back(word);
  return all;
}

/// Which column is which coordinate, and what its numbers are in.
template <int D>
struct PointColumns {
  std::array<std::size_t, D> coordinate{};
  std::array<UnitConversion, D> in_metres{};

  PointColumns() {
    for (std::size_t n = 0; n < D; ++n) coordinate[n] = n;
  }
  /// Takes the columns of a header: x, y and z or depth, or what counts upwards in place of it, in any order.
  explicit PointColumns(const std::vector<ColumnHeader>& headers) {
    std::array<bool, D> found{};
    for (std::size_t n = 0; n < headers.size(); ++n) {
      const auto& name = headers[n].name;
      const bool up = name == "elevation" || name == "height" || name == "altitude";
      const std::size_t axis = name == "x"                            ? 0
                               : name == "y" && D == 3                ? 1
                               : name == "z" || name == "depth" || up ? D - 1
                                                                      : D;
      if (axis == D || n >= D || found[axis])
        throw Error("found column '" + excerpt(name) + "', expected " + (D == 2 ? "x" : "x, y") +
                    " and z, depth or elevation, each once");
      coordinate[n] = axis;
      found[axis] = true;
      in_metres[n] = headers[n].conversion("m");
      if (up) in_metres[n].factor = -in_metres[n].factor;
    }
  }
};

}  // namespace

template <int D>
std::vector<NumberedPoint<D>> points_of_text(std::string_view text) {
  std::vector<NumberedPoint<D>> points;
  PointColumns<D> columns;
  bool first = true;
  for_each_line(text, [&](std::string_view line, int number) {
    if (first) {
      const auto all = words_of(line);
      first = all.empty();
      const auto place = "line " + std::to_string(number);
      const auto headers = in_place(
          place, [&] { return are_headers(all) ? column_headers(all) : std::vector<ColumnHeader>(); });
      if (headers.size() == D) {
        columns = in_place(place, [&] { return PointColumns<D>(headers); });
        return true;
      }
    }
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
      for (std::size_t n = 0; n < D; ++n)
        point.at[columns.coordinate[n]] = columns.in_metres[n](parse_number(found[n]));
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
    const auto words = words_of(line);
    columns = are_headers(words) ? column_headers(words).size() : words.size();
    return columns == 0;
  });
  return columns;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, points_of_text);

}  // namespace slipwave
