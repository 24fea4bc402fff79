// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "long_form.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_check_test {

// What is written here is read by somebody else: the checker kept beside the checkout, which parses the bytes
// with numpy and asks segyio too.

using namespace slipwave::segy;

namespace {

bool checker_runs() {
  return !shared_folder().empty() &&
         std::system("/usr/bin/python3 -c 'import numpy, segyio' 2>/dev/null") == 0;
}

int check(const std::string& options, const std::string& path) {
  const std::string command = "/usr/bin/python3 '" + (shared_folder() / "tools/check_segy.py").string() +
                              "' " + options + " '" + path + "'";
  return std::system(command.c_str());
}

}  // namespace

TEST(WrittenGather, SatisfiesTheIndependentChecker) {
  if (!checker_runs())
    GTEST_SKIP() << "the checker ../shared/tools/check_segy.py, numpy or segyio is not there";
  const Scratch scratch;
  for (const int receivers : {1, 4}) {
    write_file(scratch.file("g.sgy"), survey_gather(51, receivers), {});
    EXPECT_EQ(check("--profile shot --strict --expect revision=1 --expect format=5 --expect scalco=-100",
                    scratch.file("g.sgy")),
              0);
  }
  write_file(scratch.file("ibm.sgy"), survey_gather(), {1, 1, Endian::big, TextEncoding::ebcdic, false});
  EXPECT_EQ(check("--profile shot --strict --expect format=1", scratch.file("ibm.sgy")), 0);
  write_file(scratch.file("two.sgy"), survey_gather(), {5, 2, Endian::big, TextEncoding::ebcdic, false});
  EXPECT_EQ(check("--profile shot --strict --expect revision=2.1", scratch.file("two.sgy")), 0);
  write_file(scratch.file("g.su"), survey_gather(), {5, 1, Endian::little, TextEncoding::ebcdic, true});
  EXPECT_EQ(check("--su --expect endian=little", scratch.file("g.su")), 0);
}

TEST(WrittenGather, IsReadAlikeInEveryFormatAndByteOrder) {
  if (!checker_runs())
    GTEST_SKIP() << "the checker ../shared/tools/check_segy.py, numpy or segyio is not there";
  const Scratch scratch;
  std::size_t turn = 0;
  for (const SampleFormat& format : sample_formats())
    for (const Endian endian : {Endian::big, Endian::little}) {
      // In the short form each format in one order of bytes.
      if (const auto now = turn++; !long_form() && (now + now / 2) % 2 != 0) continue;
      const std::string path = scratch.file("g.sgy");
      write_file(path, survey_gather(51, 1), {format.code, 2, endian, TextEncoding::ascii, false});
      const std::string facts = "--expect format=" + std::to_string(format.code) +
                                " --expect endian=" + name_of(endian) +
                                " --expect ns=51 --expect dt=2000.0 --expect traces=12" +
                                " --expect min=1 --expect max=100 --expect text=ascii";
      EXPECT_EQ(check(facts, path), 0) << format.name;
    }
}

}  // namespace slipwave::segy_check_test
