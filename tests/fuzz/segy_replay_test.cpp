// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "long_form.hpp"
#include "segy/reader.hpp"
#include "segy_shared.hpp"
#include "segy_target.hpp"

// What the fuzzer looks for, from fixed seeds: damage of every kind gives an answer or an error. Run under
// the address and undefined-behaviour sanitizers; no single allocation may pass 64 MiB. Builds without them
// do a tenth of what is drawn at random: there damage shows only where it ends the process. With them the
// short form does a quarter, and libFuzzer more.

using namespace slipwave::segy;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

const bool whole = slipwave::long_form();

extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=64:quarantine_size_mb=16"; }

TEST(Reader, AnswersForEverySeed) {
  const auto all = seeds(5);
  EXPECT_GT(all.size(), 40U);
  for (const Seed& seed : all)
    for (const As as : {As::file, As::pipe}) examine(seed.bytes, as);
}

TEST(Seeds, OfAreasHaveInlineAndCrosslineNumbersOfBothSigns) {
  int areas = 0;
  for (const Seed& seed : seeds(5)) {
    if (!seed.name.starts_with("area-")) continue;
    ++areas;
    const slipwave::Scratch scratch;
    put_bytes(scratch.file(seed.name), seed.bytes);
    Reader reader(scratch.file(seed.name));
    std::set<std::int64_t> inlines, crosslines;
    for (Trace trace; reader.next(trace);) {
      inlines.insert(trace.words.get("iline"));
      crosslines.insert(trace.words.get("xline"));
    }
    // Midpoints at y = -5.75 -3.75 -1.75 m in bins of 2 m, at x = 5 and 17.5 m in bins of 12.5 m.
    EXPECT_EQ(inlines, (std::set<std::int64_t>{-3, -2, -1})) << seed.name;
    EXPECT_EQ(crosslines, (std::set<std::int64_t>{1, 2})) << seed.name;
  }
  EXPECT_EQ(areas, 4);
}

// In the short form each length is that of one of the files.
TEST(Reader, AnswersForEveryCutWithin8000BytesAndSomeBeyond) {
  std::mt19937 random(1);
  const auto all = seeds(100);
  std::size_t turn = 0;
  for (const char* name : {"ieee-big-1.sgy", "int16-little-2.sgy", "little.su", "stanza.sgy"}) {
    for (const Seed& seed : all) {
      if (seed.name != name) continue;
      ASSERT_GT(seed.bytes.size(), 7000U) << name;
      for (std::size_t length = 0; length < seed.bytes.size(); ++length)
        if ((whole || length % 4 == turn) && (length <= 8000 || random() % 8 == 0))
          examine({seed.bytes.data(), length}, random() % 4 == 0 ? As::pipe : As::file);
    }
    ++turn;
  }
}

TEST(Reader, AnswersForThousandsOfChangedHeaders) {
  std::mt19937 random(20240611);
  const auto all = seeds(5);
  for (int round = 0; round < (!sanitized ? 10'000 : whole ? 100'000 : 25'000); ++round) {
    Bytes bytes = all[random() % all.size()].bytes;
    change_headers(bytes, random);
    examine(bytes, round % 4 == 0 ? As::pipe : As::file);
  }
}
