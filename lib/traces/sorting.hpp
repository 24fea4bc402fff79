// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "segy/reader.hpp"
#include "traces/expression.hpp"
#include "traces/record_sorter.hpp"

namespace slipwave {

/// One thing to sort by: a number or the component, upwards or downwards.
struct SortKey {
  Expression expression;
  bool descending = false;
  std::string text;  // without its sign
};

/// "cdp,-offset,abs(receiver_x)": keys between commas, a - in front of a name for descending. What is no
/// number or component is a usage Error that names key and place.
std::vector<SortKey> parse_sort_keys(const std::string& text);

/// The code of the binary header (byte 3229) of traces sorted by this key first: 5 common source, 2 common
/// depth point, 6 common receiver, 7 common offset, -1 anything else.
int sorting_code(const SortKey& first);

/// Sorts traces by keys, samples untouched.
class TraceSorter {
 public:
  /// Takes the keys; memory and directory are those of RecordSorter.
  TraceSorter(std::vector<SortKey> keys, std::uint64_t memory_bytes, const std::string& directory);

  void add(const TraceView& view);
  /// All traces in order, each valid until `take` returns. Once, at the end.
  void deliver(const std::function<void(const segy::RawTrace&)>& take);

  const RecordSorter& records() const { return records_; }
  /// Traces that share the first key, where most do; 0 when there are more than a million different ones.
  std::int64_t largest_ensemble() const;

 private:
  std::vector<SortKey> keys_;
  RecordSorter records_;
  std::unordered_map<double, std::int64_t> ensembles_;
  bool too_many_ = false;
  std::vector<double> values_;
  std::vector<std::uint8_t> record_;
};

}  // namespace slipwave
