// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "segy/describe.hpp"
#include "segy_shared.hpp"

namespace slipwave::segy_corpus_test {

// Files other people wrote, and the table of facts that stands in the README beside them.

using namespace slipwave::segy;

namespace {

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::stringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const auto first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? ""
                                               : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

void expect_number(double found, const std::string& cell) {
  if (cell == "-") return;
  const double expected = std::stod(cell);
  EXPECT_NEAR(found, expected, 1e-8 * std::fabs(expected));
}

}  // namespace

TEST(Corpus, IsReadWithTheFactsOfItsReadme) {
  const auto folder = shared_folder() / "data/segy-corpus";
  if (shared_folder().empty() || !std::filesystem::exists(folder / "README.md"))
    GTEST_SKIP() << "the corpus ../shared/data/segy-corpus is not there";
  std::ifstream readme(folder / "README.md");
  int files = 0;
  for (std::string row; std::getline(readme, row);) {
    if (!row.starts_with("| ") || row.starts_with("| file")) continue;
    const auto cells = cells_of(row);
    ASSERT_GE(cells.size(), 13U);
    SCOPED_TRACE(cells[0]);
    ++files;
    const Description facts = describe((folder / cells[0]).string());
    const bool su = cells[0].ends_with(".su");
    EXPECT_EQ(facts.header.su, su);
    EXPECT_EQ(name_of(facts.header.endian), cells[3]);
    EXPECT_EQ(su ? "-" : name_of(facts.header.encoding), cells[4]);
    EXPECT_EQ(std::to_string(facts.axis.count), cells[5]);
    expect_number(facts.axis.interval_s * 1e6, cells[6]);
    EXPECT_EQ(std::to_string(facts.header.format->code), cells[7]);
    EXPECT_EQ(std::to_string(facts.traces), cells[8]);
    EXPECT_EQ(std::to_string(facts.header.extended.size()), cells[9]);
    expect_number(facts.sample.lowest, cells[10]);
    expect_number(facts.sample.highest, cells[11]);
    expect_number(facts.rms, cells[12]);
    EXPECT_EQ(facts.damage.has_value(), cells[0] == "broken.sgy");
  }
  EXPECT_GE(files, 20);
}

TEST(Corpus, OffsetsAreThoseOfTheFilesNotOfCoordinatesTheyLack) {
  const auto folder = shared_folder() / "data/segy-corpus";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the corpus ../shared/data/segy-corpus is not there";
  const auto offset_of = [&](const char* name) {
    const auto offset = describe((folder / name).string()).offset_m;
    EXPECT_EQ(offset.lowest, offset.highest) << name;
    return offset.lowest;
  };
  EXPECT_EQ(offset_of("f3.sgy"), 0);
  EXPECT_EQ(offset_of("small.sgy"), 1);
  EXPECT_EQ(offset_of("shot-gather.sgy"), 1);
}

TEST(Corpus, TimeScalarOfTheDelayIsApplied) {
  const auto file = shared_folder() / "data/segy-corpus/delay-scalar.sgy";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the corpus ../shared/data/segy-corpus is not there";
  EXPECT_DOUBLE_EQ(describe(file.string()).axis.start_s, 1);
}

}  // namespace slipwave::segy_corpus_test
