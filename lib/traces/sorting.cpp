// SPDX-License-Identifier: BSD-3-Clause
#include "traces/sorting.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

constexpr std::size_t most_ensembles = 1000000;

SortKey parse_sort_key(const std::string& text) {
  const bool has_sign = !text.empty() && (text[0] == '-' || text[0] == '+');
  const std::string name = text.substr(has_sign ? 1 : 0);
  // the sign of a name is the direction, that of anything longer a part of the number
  if (has_sign && HeaderKey::named(name)) return {Expression(name), text[0] == '-', name};
  Expression expression(text);
  if (expression.kind() == Expression::Kind::truth)
    throw Error("is a condition, expected a number or component", ErrorKind::usage);
  return {std::move(expression), false, text};
}

}  // namespace

std::vector<SortKey> parse_sort_keys(const std::string& text) {
  std::vector<SortKey> keys;
  for (const std::string& part : split(text, ','))
    keys.push_back(in_place("'" + part + "'", [&] { return parse_sort_key(part); }));
  return keys;
}

int sorting_code(const SortKey& first) {
  struct Row {
    const char* name;
    int code;
  };
  constexpr Row rows[] = {{"shot", 5},        {"fldr", 5},       {"ep", 5},    {"source_x", 5},
                          {"sx", 5},          {"cdp", 2},        {"xline", 2}, {"cdpx", 2},
                          {"midpoint_x", 2},  {"receiver_x", 6}, {"gx", 6},    {"offset", 7},
                          {"abs(offset)", 7}, {"distance", 7}};
  for (const Row& row : rows)
    if (first.text == row.name) return row.code;
  return -1;
}

TraceSorter::TraceSorter(std::vector<SortKey> keys, std::uint64_t memory_bytes, const std::string& directory)
    : keys_(std::move(keys)), records_(keys_.size(), memory_bytes, directory) {}

void TraceSorter::add(const TraceView& view) {
  values_.clear();
  for (const SortKey& key : keys_) values_.push_back((key.descending ? -1 : 1) * key.expression.value(view));
  if (!too_many_) ++ensembles_[values_.front()];
  if (ensembles_.size() > most_ensembles) {
    too_many_ = true;
    ensembles_ = {};
  }
  const segy::RawTrace& trace = *view.trace;
  const auto head = trace.words.in_file_order(segy::Endian::big);
  const std::uint64_t extensions = trace.extensions.size();
  record_.resize(head.size() + sizeof extensions);
  std::copy(head.begin(), head.end(), record_.begin());
  std::memcpy(record_.data() + head.size(), &extensions, sizeof extensions);
  record_.insert(record_.end(), trace.extensions.begin(), trace.extensions.end());
  record_.insert(record_.end(), trace.samples.begin(), trace.samples.end());
  records_.add(values_, record_);
}

void TraceSorter::deliver(const std::function<void(const segy::RawTrace&)>& take) {
  constexpr std::size_t head = segy::TraceLayout::size;
  segy::RawTrace trace;
  records_.deliver([&](std::span<const std::uint8_t> record) {
    trace.words = segy::TraceWords(record.first<head>(), segy::Endian::big);
    std::uint64_t extensions = 0;
    std::memcpy(&extensions, record.data() + head, sizeof extensions);
    const auto rest = record.subspan(head + sizeof extensions);
    const auto extended = rest.first(static_cast<std::size_t>(extensions));
    trace.extensions.assign(extended.begin(), extended.end());
    trace.samples = rest.subspan(extended.size());
    take(trace);
  });
}

std::int64_t TraceSorter::largest_ensemble() const {
  std::int64_t largest = 0;
  for (const auto& [key, count] : ensembles_) largest = std::max(largest, count);
  return largest;
}

}  // namespace slipwave
