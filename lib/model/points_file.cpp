#include "model/points_file.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "base/input_bytes.hpp"
#include "base/parse.hpp"

namespace slipwave {

std::vector<NumberedPoint> read_points(const std::string& path) {
  const auto whole = read_text(path);
  const std::string_view all(whole);
  // Some editors begin a text with this mark.
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  std::istringstream text(std::string(all.substr(all.starts_with(byte_order_mark) ? 3 : 0)));
  std::vector<NumberedPoint> points;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line.resize(std::min(line.find('#'), line.size()));
    for (char& letter : line) {
      if (letter == ',' || letter == '\r') letter = ' ';
    }
    std::istringstream words(line);
    const std::vector<std::string> parts{std::istream_iterator<std::string>(words), {}};
    if (parts.empty()) continue;
    const std::string place = shown_input(path) + ": line " + std::to_string(number);
    if (parts.size() != 2)
      throw Error(place + ": found " + std::to_string(parts.size()) +
                  (parts.size() == 1 ? " value" : " values") + ", expected X Z");
    try {
      points.push_back({{parse_number(parts[0]), parse_number(parts[1])}, number});
    } catch (const Error& error) {
      throw Error(place + ": " + error.what());  // bad data, not a bad command line
    }
  }
  return points;
}

}  // namespace slipwave
