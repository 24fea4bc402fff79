// SPDX-License-Identifier: BSD-3-Clause
#include "io/table.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string as_text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

Table::Table(const std::string& path) : Table(shown_input(path), as_text(read_all(path))) {}

Table::Table(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) { begin(); }

/// Finds out what kind of table it is by its first line.
void Table::begin() {
  rest_ = text_;
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  if (!next_values()) throw Error(name_ + ": found no row, expected a table");
  width_ = values_.size();
  conversions_.resize(width_);
  units_.resize(width_);
  // A header has a name in each column; a row has at least one number.
  if (!in_place(place(), [&] { return are_headers(values_); })) {
    first_is_row_ = true;
    return;
  }
  std::vector<ColumnHeader> headers;
  if (separator_ == ' ') {
    headers = column_headers(values_);
  } else {
    for (const auto value : values_) headers.push_back(column_header(value));
  }
  width_ = headers.size();
  for (std::size_t n = 0; n < width_; ++n) {
    const auto& name = headers[n].name;
    if (name.empty()) throw Error(place() + ": found a column without name, expected one");
    if (std::find(columns_.begin(), columns_.end(), name) != columns_.end())
      throw Error(place() + ": found column " + excerpt(name) + " twice, expected it once");
    columns_.push_back(name);
    units_[n] = headers[n].unit;
  }
  const auto rows = rest_;
  const auto header_line = line_;
  if (!next_values()) throw Error(name_ + ": found no row below the header line, expected some");
  rest_ = rows;
  line_ = header_line;
}

std::optional<std::size_t> Table::find(std::string_view column) const {
  const auto at = std::find(columns_.begin(), columns_.end(), column);
  if (at == columns_.end()) return {};
  return std::size_t(at - columns_.begin());
}

void Table::expect_columns(const std::vector<Known>& known) {
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.name == columns_[n]; });
    if (found != known.end()) {
      expect_unit(n, found->unit);
      continue;
    }
    std::vector<std::string> names;
    for (const auto& one : known) names.push_back(one.name);
    throw Error(name_ + ": found column '" + excerpt(columns_[n]) + "', expected " + joined(names, " or "));
  }
}

void Table::expect_unit(std::size_t column, const std::string& unit) {
  conversions_[column] = in_place(name_, [&] {
    return ColumnHeader{columns_[column], units_[column]}.conversion(unit);
  });
}

void Table::name_columns(const std::vector<std::string>& names) { columns_ = names; }

std::string Table::place() const { return name_ + ": line " + std::to_string(line_); }

std::string Table::column_name(std::size_t column) const {
  return column < columns_.size() ? columns_[column] : std::to_string(column + 1);
}

void Table::refuse(std::size_t column, const std::string& sentence) const {
  throw Error(place() + ": column " + column_name(column) + ": " + sentence);
}

double Table::number(std::size_t column) const {
  try {
    return in_unit(column, parse_number(values_[column]));
  } catch (const Error& error) {
    refuse(column, error.what());
  }
}

std::int64_t Table::integer(std::size_t column) const {
  try {
    return parse_integer(values_[column]);
  } catch (const Error& error) {
    refuse(column, error.what());
  }
}

/// The values of a line.
bool Table::split(std::string_view line) {
  values_.clear();
  unquoted_.clear();
  if (separator_ == ' ') {
    for (line = trimmed(line); !line.empty();) {
      const auto end = line.find_first_of(blanks);
      values_.push_back(line.substr(0, end));
      line = end == std::string_view::npos ? std::string_view() : trimmed(line.substr(end));
    }
    return !values_.empty();
  }
  for (bool more = true; more;) {
    line = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with('"')) {
      const auto end = line.find(separator_);
      values_.push_back(trimmed(line.substr(0, end)));
      more = end != std::string_view::npos;
      if (more) line.remove_prefix(end + 1);
      continue;
    }
    std::string value;
    std::size_t at = 1;
    for (; at < line.size() && (line[at] != '"' || line.substr(at).starts_with("\"\"")); ++at) {
      if (line[at] == '"') ++at;
      value += line[at];
    }
    if (at >= line.size())
      throw Error(place() + ": column " + column_name(values_.size()) +
                  ": found no closing quotation mark, expected one on the line");
    line = trimmed(line.substr(at + 1));
    if (!line.empty() && line.front() != separator_)
      throw Error(place() + ": column " + column_name(values_.size()) +
                  ": found text behind the closing quotation mark, expected a comma");
    more = !line.empty();
    if (more) line.remove_prefix(1);
    // Views of short strings would not stand a growing vector.
    unquoted_.reserve(std::max<std::size_t>(unquoted_.capacity(), 64));
    if (unquoted_.size() == unquoted_.capacity())
      throw Error(place() + ": found more than 64 quoted values, expected fewer");
    unquoted_.push_back(std::move(value));
    values_.emplace_back(unquoted_.back());
  }
  return true;
}

bool Table::next_values() {
  while (!rest_.empty()) {
    const auto end = rest_.find('\n');
    const auto line = trimmed(rest_.substr(0, end));
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    if (line.empty() || line.front() == '#') continue;
    if (width_ == 0)
      separator_ = line.find(';') != std::string_view::npos   ? ';'
                   : line.find(',') != std::string_view::npos ? ','
                                                              : ' ';
    return split(line);
  }
  return false;
}

bool Table::next() {
  if (std::exchange(first_is_row_, false)) return true;
  if (!next_values()) return false;
  if (values_.size() != width_)
    throw Error(place() + ": found " + std::to_string(values_.size()) +
                (values_.size() == 1 ? " value" : " values") + ", expected " + std::to_string(width_) +
                (columns_.empty() ? " as in the first row" : ", one for each column"));
  return true;
}

}  // namespace slipwave
