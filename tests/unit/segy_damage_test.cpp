// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <malloc.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <random>
#include <thread>

#include "base/error.hpp"
#include "segy/describe.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_damage_test {

// Damaged input gives an answer or a sentence, in memory bounded by what the input holds.

using namespace slipwave::segy;

namespace {

/// What is asked of the heap: the largest request, and how much is held, now and at most.
struct Heap {
  std::atomic<std::size_t> largest{0};
  std::atomic<std::size_t> held{0};
  std::atomic<std::size_t> most{0};
};

Heap& heap() {
  static Heap counts;
  return counts;
}

void raise(std::atomic<std::size_t>& mark, std::size_t value) {
  std::size_t old = mark;
  while (old < value && !mark.compare_exchange_weak(old, value)) continue;
}

void* noted(std::size_t count) {
  void* const memory = std::malloc(count == 0 ? 1 : count);
  if (memory == nullptr) throw std::bad_alloc();
  raise(heap().largest, count);
  raise(heap().most, heap().held += malloc_usable_size(memory));
  return memory;
}

void released(void* memory) {
  if (memory != nullptr) heap().held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace
}  // namespace slipwave::segy_damage_test

using slipwave::segy_damage_test::noted, slipwave::segy_damage_test::released;

void* operator new(std::size_t count) { return noted(count); }
void* operator new[](std::size_t count) { return noted(count); }
// Also the form that does not throw: a sanitizer's own would not know what `released` gives back.
void* operator new(std::size_t count, const std::nothrow_t&) noexcept {
  try {
    return noted(count);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { released(memory); }
void operator delete[](void* memory) noexcept { released(memory); }
void operator delete(void* memory, std::size_t) noexcept { released(memory); }
void operator delete[](void* memory, std::size_t) noexcept { released(memory); }

namespace slipwave::segy_damage_test {
namespace {

/// Of a small file, however large the numbers in its headers: buffers.
constexpr std::size_t bound_bytes = 4 << 20;

/// What `body` took from the heap beyond what was held before.
struct Taken {
  std::size_t largest;
  std::size_t most;
};
template <class Body>
Taken taken_by(Body&& body) {
  const std::size_t before = heap().held;
  heap().largest = 0;
  heap().most = before;
  body();
  return {heap().largest, heap().most - before};
}

struct Outcome {
  std::int64_t traces = 0;
  std::string complaint;
};

Outcome outcome_of(const std::string& path) {
  try {
    const Description facts = describe(path);
    return {facts.traces, facts.damage.value_or("")};
  } catch (const Error& error) {
    return {0, error.what()};
  }
}

/// In place: emptying a file that is written again costs a disk access on some file systems.
void overwrite(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

std::vector<std::uint8_t> valid_file(const Scratch& scratch, int revision, bool su) {
  write_file(scratch.file("valid"), survey_gather(5, 1),
             {5, revision, Endian::big, TextEncoding::ebcdic, su});
  return bytes_of(scratch.file("valid"));
}

}  // namespace

TEST(DamagedFile, CutAnywhereDeliversTheWholeTracesAndThenComplains) {
  const Scratch scratch;
  const std::size_t trace_bytes = 240 + 20;
  for (const int revision : {1, 2}) {
    const auto bytes = valid_file(scratch, revision, false);
    ASSERT_GT(bytes.size(), 4000U);
    put_bytes(scratch.file("cut"), bytes);
    for (std::size_t length = bytes.size(); length-- > 0;) {
      std::filesystem::resize_file(scratch.file("cut"), length);
      const Outcome outcome = outcome_of(scratch.file("cut"));
      const std::size_t whole = length < 3600 ? 0 : (length - 3600) / trace_bytes;
      ASSERT_EQ(outcome.traces, static_cast<std::int64_t>(whole)) << length;
      const bool between_traces = length >= 3600 && (length - 3600) % trace_bytes == 0;
      // revision 2 says how many traces there are, so that even a cut between traces shows
      ASSERT_EQ(outcome.complaint.empty(), between_traces && revision == 1) << length << outcome.complaint;
      ASSERT_TRUE(outcome.complaint.empty() || outcome.complaint.starts_with(scratch.file("cut") + ": "));
    }
  }
}

TEST(DamagedFile, SaysWhereItEnds) {
  const Scratch scratch;
  const auto bytes = valid_file(scratch, 1, false);
  const auto complaint = [&](std::size_t length) {
    put_bytes(scratch.file("cut"), {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
    return outcome_of(scratch.file("cut")).complaint.substr(scratch.file("cut").size() + 2);
  };
  EXPECT_EQ(complaint(0), "is empty, expected SEG-Y or Seismic Unix traces");
  EXPECT_EQ(complaint(3000), "3000 bytes, expected at least the 3600 of the SEG-Y headers");
  EXPECT_EQ(complaint(3600 + 260 + 100), "ends within trace 2: 100 of the 240 header bytes");
  EXPECT_EQ(complaint(3600 + 260 + 250), "ends within trace 2: 250 of 260 bytes");
}

TEST(DamagedFile, IsRefusedWhenItIsSomethingElse) {
  const Scratch scratch;
  std::vector<std::uint8_t> bytes(10000);
  std::mt19937 random(7);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  const std::string netcdf = "\x89HDF\r\n\x1a\n";
  std::copy(netcdf.begin(), netcdf.end(), bytes.begin());
  put_bytes(scratch.file("x"), bytes);
  EXPECT_NE(outcome_of(scratch.file("x")).complaint.find("neither SEG-Y nor Seismic Unix"),
            std::string::npos);
  EXPECT_EQ(outcome_of("/").complaint, "/: is a directory, expected a file");
  EXPECT_EQ(outcome_of(scratch.file("none")).complaint, scratch.file("none") + ": No such file or directory");
}

TEST(DamagedFile, WithFormat4IsReadOnlyWhenToldHow) {
  const Scratch scratch;
  auto bytes = valid_file(scratch, 1, false);
  store_bytes(&bytes[3224], 2, Endian::big, 4);
  put_bytes(scratch.file("four"), bytes);
  EXPECT_NE(outcome_of(scratch.file("four")).complaint.find("format code 4"), std::string::npos);
  ReadOptions options;
  options.format = 5;
  EXPECT_EQ(read_file(scratch.file("four"), options).traces.size(), 12U);
}

TEST(DamagedFile, WithRubbishInTheFreeBytesOfRevision0IsReadAllTheSame) {
  const Scratch scratch;
  auto bytes = valid_file(scratch, 0, false);
  for (const std::uint8_t rubbish : {0x40, 0x20, 0xff, 0x07}) {
    std::fill(bytes.begin() + 3260, bytes.begin() + 3600, rubbish);
    put_bytes(scratch.file("rubbish"), bytes);
    EXPECT_EQ(read_file(scratch.file("rubbish")).traces.size(), 12U) << int(rubbish);
  }
}

TEST(DamagedFile, WithHeadersChangedAtRandomStaysBounded) {
  const Scratch scratch;
  std::mt19937 random(20240611);
  for (const bool su : {false, true})
    for (const int revision : {1, 2}) {
      const auto valid = valid_file(scratch, revision, su);
      const std::size_t begin = su ? 0 : 3200;
      put_bytes(scratch.file("mutant"), valid);
      for (int round = 0; round < 1500; ++round) {
        auto bytes = valid;
        const int changes = 1 + static_cast<int>(random() % 8);
        for (int change = 0; change < changes; ++change) {
          const std::size_t at = begin + random() % (su ? 240 : 640);
          const std::uint32_t kind = random() % 3;
          bytes[at] = static_cast<std::uint8_t>(kind == 0 ? 0xff : kind == 1 ? 0x7f : random());
        }
        overwrite(scratch.file("mutant"), bytes);
        const Taken taken = taken_by([&] { outcome_of(scratch.file("mutant")); });
        ASSERT_LT(taken.most, bound_bytes) << "round " << round;
      }
    }
}

TEST(DamagedFile, PromisingTwoThousandMillionSamplesTakesNoMemory) {
  const Scratch scratch;
  auto bytes = valid_file(scratch, 2, false);
  store_bytes(&bytes[3268], 4, Endian::big, 2147483647);  // samples a trace
  store_bytes(&bytes[3506], 2, Endian::big, 65535);       // headers a trace
  store_bytes(&bytes[3512], 8, Endian::big, 0x7fffffffffffffff);
  put_bytes(scratch.file("absurd"), bytes);
  const Taken taken = taken_by([&] {
    EXPECT_NE(outcome_of(scratch.file("absurd")).complaint.find("ends within trace 1"), std::string::npos);
  });
  EXPECT_LT(taken.most, bound_bytes);
}

TEST(DamagedFile, PromisingTooMuchTakesNoMoreThanItHoldsAnd64MiB) {
  const Scratch scratch;
  write_file(scratch.file("big"), survey_gather(500'000, 1),
             {5, 2, Endian::big, TextEncoding::ebcdic, false});
  auto bytes = bytes_of(scratch.file("big"));
  store_bytes(&bytes[3268], 4, Endian::big, 2147483647);
  store_bytes(&bytes[3512], 8, Endian::big, 0);
  put_bytes(scratch.file("big"), bytes);
  const std::size_t allowed = bytes.size() + (64 << 20);
  bytes = {};
  const Taken of_file = taken_by([&] { outcome_of(scratch.file("big")); });
  EXPECT_LT(of_file.most, bound_bytes);  // its length shows that nothing of it can be read
  ASSERT_EQ(mkfifo(scratch.file("pipe").c_str(), 0600), 0);
  std::thread writer([&] {
    const std::string line = "cat '" + scratch.file("big") + "' > '" + scratch.file("pipe") + "'";
    EXPECT_EQ(std::system(line.c_str()), 0);
  });
  const Taken of_pipe = taken_by([&] {
    EXPECT_NE(outcome_of(scratch.file("pipe")).complaint.find("ends within trace 1"), std::string::npos);
  });
  writer.join();
  EXPECT_GT(of_pipe.most, std::size_t{20} << 20);  // it was read, and counted
  EXPECT_LT(of_pipe.largest, allowed);
  EXPECT_LT(of_pipe.most, allowed);
}

}  // namespace slipwave::segy_damage_test
