// SPDX-License-Identifier: BSD-3-Clause
#include "traces/sorting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"
#include "traces/record_sorter.hpp"

namespace slipwave::traces_sorting_test {
namespace {

struct Record {
  std::vector<double> keys;
  std::vector<std::uint8_t> bytes;
};

/// Records of 0 to 8000 bytes with few different keys, so that many are equal.
std::vector<Record> records_of(int count) {
  std::vector<Record> records;
  std::uint32_t state = 7;
  const auto draw = [&](std::uint32_t below) {
    state = state * 1664525U + 1013904223U;
    return (state >> 8) % below;
  };
  for (int n = 0; n < count; ++n) {
    Record record;
    record.keys = {static_cast<double>(draw(5)) - 2, static_cast<double>(draw(9)) / 8};
    record.bytes.resize(draw(8000));
    for (auto& byte : record.bytes) byte = static_cast<std::uint8_t>(draw(256));
    records.push_back(std::move(record));
  }
  return records;
}

std::vector<std::vector<std::uint8_t>> sorted_by_hand(std::vector<Record> records) {
  std::stable_sort(records.begin(), records.end(),
                   [](const Record& a, const Record& b) { return a.keys < b.keys; });
  std::vector<std::vector<std::uint8_t>> bytes;
  for (auto& record : records) bytes.push_back(std::move(record.bytes));
  return bytes;
}

std::vector<std::vector<std::uint8_t>> delivered(RecordSorter& sorter) {
  std::vector<std::vector<std::uint8_t>> bytes;
  sorter.deliver(
      [&](std::span<const std::uint8_t> record) { bytes.emplace_back(record.begin(), record.end()); });
  return bytes;
}

}  // namespace

TEST(RecordSorter, KeepsTheOrderOfEqualOnesInMemoryAndThroughAFile) {
  const auto records = records_of(3000);
  const auto expected = sorted_by_hand(records);
  const Scratch scratch;
  for (const std::uint64_t memory : {std::uint64_t{1} << 30, std::uint64_t{5} << 20, std::uint64_t{1}}) {
    RecordSorter sorter(2, memory, scratch.file(""));
    for (const auto& record : records) sorter.add(record.keys, record.bytes);
    EXPECT_EQ(sorter.parts() == 0, memory == std::uint64_t{1} << 30);
    EXPECT_TRUE(delivered(sorter) == expected) << memory;
    if (memory == 1) {
      EXPECT_GE(sorter.parts(), 10U);
      EXPECT_GE(sorter.on_disk(), 3000U * 4000U - 1000000U);
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.file("")));
}

TEST(RecordSorter, PutsWhatIsNoNumberLast) {
  RecordSorter sorter(1, 1 << 20, ".");
  const auto add = [&](double key, std::uint8_t name) {
    sorter.add(std::vector<double>{key}, std::vector<std::uint8_t>{name});
  };
  add(std::nan(""), 1);
  add(5, 2);
  add(-INFINITY, 3);
  add(0.0, 4);
  add(-0.0, 5);
  const std::vector<std::vector<std::uint8_t>> expected = {{3}, {4}, {5}, {2}, {1}};
  EXPECT_EQ(delivered(sorter), expected);
}

TEST(RecordSorter, OfNothingDeliversNothing) {
  RecordSorter sorter(1, 1 << 20, ".");
  EXPECT_TRUE(delivered(sorter).empty());
}

TEST(RecordSorter, NamesTheDirectoryItCannotWriteTo) {
  RecordSorter sorter(1, 1, "no/such/place");
  const std::vector<std::uint8_t> record(700000);
  sorter.add(std::vector<double>{1}, record);
  try {
    sorter.add(std::vector<double>{1}, record);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no/such/place: No such file or directory");
  }
}

TEST(TraceSorter, SortsTracesByKeysUpAndDown) {
  const Scratch scratch;
  segy::write_file(scratch.file("a"), segy::survey_gather(), {});
  const auto sorted = [&](const std::string& keys, std::uint64_t memory) {
    segy::Reader reader(scratch.file("a"));
    TraceSorter sorter(parse_sort_keys(keys), memory, scratch.file(""));
    segy::RawTrace trace;
    std::vector<std::string> before;
    while (reader.next(trace)) sorter.add(view_of(reader, trace));
    std::string order;
    sorter.deliver([&](const segy::RawTrace& one) {
      EXPECT_EQ(one.samples.size(), 51U * 4);
      const auto header = segy::si_from_words(one.words, reader.header());
      order += name_of(header.component) + std::to_string(header.shot) + std::to_string(header.channel) + " ";
    });
    return order.substr(0, 40);
  };
  EXPECT_EQ(sorted("channel,component", 1 << 20), "vx11 vx21 vz11 vz21 p11 p21 sxx11 sxx21 ");
  EXPECT_EQ(sorted("component,-shot,-channel", 1 << 20), "vx24 vx23 vx22 vx21 vx14 vx13 vx12 vx11 ");
  EXPECT_EQ(sorted("-trace", 1 << 20).substr(0, 24), "sxz24 sxz23 sxz22 sxz21 ");
  EXPECT_EQ(sorted("shot-2*channel,component", 1 << 20).substr(0, 15), "vx14 vz14 p14 s");
}

TEST(TraceSorter, CountsTheLargestEnsemble) {
  const Scratch scratch;
  Gather gather = segy::survey_gather();
  gather.traces.resize(30);  // 24 of shot 1, 6 of shot 2
  segy::write_file(scratch.file("a"), gather, {});
  segy::Reader reader(scratch.file("a"));
  TraceSorter sorter(parse_sort_keys("shot"), 1 << 20, ".");
  segy::RawTrace trace;
  while (reader.next(trace)) sorter.add(view_of(reader, trace));
  EXPECT_EQ(sorter.largest_ensemble(), 24);
  EXPECT_EQ(sorter.records().count(), 30);
}

TEST(SortKeys, SayWhichOneIsWrong) {
  const auto said = [](const char* text) {
    try {
      parse_sort_keys(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(said("cdp,ofset"), "'ofset': character 1, 'ofset': unknown name, did you mean offset?");
  EXPECT_EQ(said("cdp,,offset"), "'': character 1, the end: expected a condition or a number");
  EXPECT_EQ(said("shot=3"), "'shot=3': is a condition, expected a number or component");
  EXPECT_EQ(said("-component"), "accepted");
  EXPECT_EQ(sorting_code(parse_sort_keys("-cdp,offset").front()), 2);
  EXPECT_EQ(sorting_code(parse_sort_keys("shot,offset").front()), 5);
  EXPECT_EQ(sorting_code(parse_sort_keys("channel").front()), -1);
}

}  // namespace slipwave::traces_sorting_test
