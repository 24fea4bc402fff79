// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/column_header.hpp"

namespace slipwave {

/// A table that people or their programs wrote: CSV (RFC 4180, or with ; in place of commas) with a header
/// line that names the columns in any order and letters of any case, or columns between blanks, with or
/// without a header. Headers may name units (column_header()). # begins a comment line; empty lines are
/// passed over. Rows are read one after the other.
class Table {
 public:
  /// A file or, of tests, a text under a name. Throws Error naming the file, the line and the column.
  explicit Table(const std::string& path);
  Table(std::string name, std::string text);

  /// "shots.csv".
  const std::string& name() const { return name_; }
  /// Names of the columns; empty where there is no header.
  const std::vector<std::string>& columns() const { return columns_; }
  /// Values of the first row: the number of columns where there is no header.
  std::size_t width() const { return width_; }
  /// Returns the place of a column; none where the table has no such column.
  std::optional<std::size_t> find(std::string_view column) const;
  /// A column that may be there, and the unit that its numbers shall be in; "" of what has none.
  struct Known {
    std::string name, unit = "";
  };
  /// Refuses columns that are not among these: a misspelt name must not be passed over; and units that do not
  /// convert. Numbers are in these units from now on.
  void expect_columns(const std::vector<Known>& known);
  /// Numbers of a column shall be in that unit.
  void expect_unit(std::size_t column, const std::string& unit);
  /// The unit that the header names; "" where it names none.
  const std::string& unit(std::size_t column) const { return units_[column]; }
  /// A number as it stands in a column, in the unit that is expected.
  double in_unit(std::size_t column, double number) const { return conversions_[column](number); }
  /// Names the columns of a table without header.
  void name_columns(const std::vector<std::string>& names);

  /// The next row; false after the last one. Throws Error where it has not as many values as the header.
  bool next();
  std::int64_t line() const { return line_; }
  /// "shots.csv: line 3".
  std::string place() const;
  /// A value of the row; "" where it is left out.
  std::string_view text(std::size_t column) const { return values_[column]; }
  bool has(std::optional<std::size_t> column) const { return column && !values_[*column].empty(); }
  /// Throws Error "shots.csv: line 3: column x: found 'abc', expected a number".
  double number(std::size_t column) const;
  std::int64_t integer(std::size_t column) const;
  /// Throws Error with the place of a value in front.
  [[noreturn]] void refuse(std::size_t column, const std::string& sentence) const;

 private:
  void begin();
  bool next_values();
  bool split(std::string_view line);
  std::string column_name(std::size_t column) const;

  std::string name_, text_;
  std::string_view rest_;
  char separator_ = ' ';
  std::int64_t line_ = 0;
  std::size_t width_ = 0;
  bool first_is_row_ = false;
  std::vector<std::string> columns_, units_;
  std::vector<UnitConversion> conversions_;
  std::vector<std::string_view> values_;
  std::vector<std::string> unquoted_;
};

}  // namespace slipwave
