// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/history.hpp"
#include "scratch.hpp"
#include "segy/conversion.hpp"
#include "segy/history.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_history_test {

using namespace slipwave::segy;

namespace {

class HistoryInTraces : public ::testing::Test {
 protected:
  FileHeader written(const FileFormat& format, const std::string& history) const {
    OutputFile out(path_, OutputFile::Content::binary);
    write_gather(out, survey_gather(11, 2), format, {{"slipwave test"}, history});
    out.commit();
    return Reader(path_).header();
  }
  Scratch scratch_;
  std::string path_ = scratch_.file("history.sgy");
};

std::string long_command() {
  std::string command = "sw-layers --size 100x100 --step 5";
  for (int n = 0; n < 120; ++n) command += " --layer " + std::to_string(n) + ":2000:1000:2000";
  return command + " --title '" + std::string(200, 'x') + "'";
}

}  // namespace

TEST_F(HistoryInTraces, StandsInTheTextWhereItHasRoom) {
  const std::string history = "sw-layers --size 100x100 --step 5\nsw-shoot --source 1,2 --receivers " +
                              std::string(150, '1') + ",5 --time 1";
  for (const int revision : {0, 1, 2}) {
    const auto header = written({5, revision}, history);
    EXPECT_TRUE(header.extended.empty());
    EXPECT_EQ(history_of(header).commands, history);
    EXPECT_TRUE(history_of(header).complete);
  }
}

TEST_F(HistoryInTraces, StandsInAStanzaWhereTheTextChangesItOrHasNoRoom) {
  for (const std::string& history : {long_command() + "\nsw-shoot --time 1",
                                     std::string("sw-select --where 'shot=1|shot=2' --name caf\xc3\xa9")})
    for (const auto encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
      FileFormat format;
      format.encoding = encoding;
      const auto header = written(format, history);
      ASSERT_FALSE(header.extended.empty());
      EXPECT_EQ(history_of(header).commands, history);
    }
  const auto old = history_of(written({5, 0}, long_command()));
  EXPECT_FALSE(old.complete) << "revision 0 has no stanzas, and must not pass for whole";
}

TEST_F(HistoryInTraces, GoesOnThroughOtherToolsInOneStanza) {
  const std::string history = long_command() + "\nsw-shoot --time 1";
  written({}, history);
  Reader reader(path_);
  const auto info = info_as(reader, "sw-filter a.sgy --gain rms", {});
  EXPECT_EQ(info.history, history + "\nsw-filter --gain rms");
  EXPECT_TRUE(info.extended.empty());
  const std::string next = path_ + ".next";
  {
    OutputFile out(next, OutputFile::Content::binary);
    Writer writer(out, info);
    RawTrace trace;
    while (reader.next(trace)) writer.write(trace, false);
    out.commit();
  }
  EXPECT_EQ(segy::history_of(Reader(next).header()).commands, info.history);
  std::filesystem::remove(next);
}

}  // namespace slipwave::segy_history_test
