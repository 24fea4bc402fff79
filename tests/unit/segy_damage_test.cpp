#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <random>

#include "base/error.hpp"
#include "segy/describe.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

// Damaged input gives an answer or a sentence, in memory bounded by what the input holds.

using namespace slipwave;
using namespace slipwave::segy;

namespace {

std::size_t& largest_request() {
  static thread_local std::size_t largest = 0;
  return largest;
}

void* noted(std::size_t count) {
  largest_request() = std::max(largest_request(), count);
  if (void* const memory = std::malloc(count == 0 ? 1 : count)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t count) { return noted(count); }
void* operator new[](std::size_t count) { return noted(count); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

constexpr std::size_t bound_bytes = 4 << 20;

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
        largest_request() = 0;
        ASSERT_NO_THROW(outcome_of(scratch.file("mutant"))) << "round " << round;
        ASSERT_LT(largest_request(), bound_bytes) << "round " << round;
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
  largest_request() = 0;
  EXPECT_NE(outcome_of(scratch.file("absurd")).complaint.find("ends within trace 1"), std::string::npos);
  EXPECT_LT(largest_request(), bound_bytes);
}
