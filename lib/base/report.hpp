// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace slipwave {

/// What is in a file, as aligned lines for people or as one JSON object. Entries keep their order.
class Report {
 public:
  void text(const std::string& key, const std::string& value);
  /// A line of each; JSON: an array of strings.
  void texts(const std::string& key, const std::vector<std::string>& values);
  void count(const std::string& key, std::int64_t value);
  /// JSON: {"value": 5, "unit": "m"}; NaN and infinities are null there.
  void number(const std::string& key, double value, const std::string& unit);
  /// "0 to 2500 m"; JSON: {"low": 0, "high": 2500, "unit": "m"}.
  void range(const std::string& key, double low, double high, const std::string& unit);
  /// JSON: an array of objects. Text: a line of each, its entries joined.
  void list(const std::string& key, const std::vector<Report>& items);
  /// The entries of another report, after those that are here.
  void append(const Report& other);

  /// "  key  value" lines, the values in one column.
  std::string lines() const;
  /// "{...}" on one line; blanks in keys become underscores.
  std::string json() const;

 private:
  struct Entry {
    std::string key, shown, json;
  };
  std::string joined() const;
  std::vector<Entry> entries_;
};

/// A JSON string, quotes included; bytes that are no UTF-8 are read as ISO 8859-1.
std::string json_string(const std::string& text);

}  // namespace slipwave
