// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "shell.hpp"

namespace slipwave::convert_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Convert : public Shell {
 protected:
  /// g.sgy: 13 receivers, vx and vz, 201 samples.
  void shoot() const {
    done(
        "sw-layers --size 300x200 --step 5 --layer 0:2500:1250:2200 | sw-shoot - --source 150,20 "
        "--wavelet ricker:30 --receivers 0:300:25,10 --time 0.2 --record vx,vz -o g.sgy");
  }
  /// The big-endian 16-bit word at `byte` (from 1) of a file.
  std::string word(const std::string& file, int byte) const {
    return done("od --endian=big -An -t d2 -N 2 -j " + std::to_string(byte - 1) + " " + file);
  }
};

}  // namespace

TEST_F(Convert, CopiesBytesThatKeepTheirFormat) {
  shoot();
  done("sw-convert g.sgy | cmp -i 3200 - g.sgy");
  done("cat g.sgy | sw-convert | cmp -i 3200 - g.sgy");
  done("sw-convert g.sgy -o out.sgy; cmp -i 3200 out.sgy g.sgy");
  EXPECT_TRUE(has(done("head -c 3200 out.sgy | dd conv=ascii status=none"), "sw-convert "));
}

TEST_F(Convert, GoesThereAndBackThroughPipes) {
  shoot();
  done("sw-convert g.sgy --su | sw-convert | sw-diff - g.sgy | sw-info - | grep -c 'amplitude 0 [mP]'");
  done(
      "sw-convert g.sgy --format double --revision 2 --endian little | sw-convert --format ieee --revision 1 "
      "--endian big | cmp -i 3200 - g.sgy");
}

TEST_F(Convert, WritesWhatItsOptionsSay) {
  shoot();
  done("sw-convert g.sgy --format ibm --revision 0 --text ascii -o old.sgy");
  EXPECT_EQ(done("head -c 4 old.sgy"), "C 1 ");
  EXPECT_EQ(word("old.sgy", 3225), "      1\n");
  EXPECT_EQ(word("old.sgy", 3501), "      0\n");
  done("sw-convert g.sgy --format 6 --revision 2 -o two.sgy");
  EXPECT_EQ(word("two.sgy", 3225), "      6\n");
  EXPECT_EQ(word("two.sgy", 3501), "    513\n");  // 2.1
  done("sw-convert g.sgy --endian little -o little.sgy");
  EXPECT_EQ(word("little.sgy", 3225), "   1280\n");
  done("sw-convert g.sgy --su --endian big -o g.su");
  EXPECT_EQ(done("stat -c %s g.su"), std::to_string(26 * (240 + 4 * 201)) + "\n");
  EXPECT_EQ(word("g.su", 115), "    201\n");
}

TEST_F(Convert, BelievesTheUserAboutTheInput) {
  shoot();
  done("cp g.sgy four.sgy; printf '\\0\\004' | dd of=four.sgy bs=1 seek=3224 conv=notrunc status=none");
  expect_refused("sw-convert four.sgy -o out.sgy", 1,
                 "sw-convert: four.sgy: sample format code 4 (fixed point with gain) is ambiguous; say what "
                 "the samples are (--format or --input-format)");
  done("sw-convert four.sgy --input-format ieee | cmp -i 3200 - g.sgy");
  expect_refused("sw-info four.sgy", 1,
                 "sw-info: four.sgy: sample format code 4 (fixed point with gain) is ambiguous; say what the "
                 "samples are (--format or --input-format)");
  EXPECT_TRUE(has(done("sw-info four.sgy --format ieee"), "traces           26\n"));
}

TEST_F(Convert, RefusesWhatIsNoSegyAndLeavesNothing) {
  shoot();
  write("empty", "");
  write("notes", std::string(5000, 'x'));
  write("out.sgy", "older");
  const auto before = files();
  struct Case {
    std::string line;
    int code;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"sw-convert none", 1, "none: No such file or directory"},
      {"sw-convert .", 1, ".: is a directory, expected a file"},
      {"sw-convert empty", 1, "empty: is empty, expected SEG-Y or Seismic Unix traces"},
      {"sw-convert < empty", 1, "standard input: is empty, expected SEG-Y or Seismic Unix traces"},
      {"sw-convert notes", 1,
       "notes: is neither SEG-Y nor Seismic Unix: no textual header, no sample format, no plausible trace "
       "header"},
      {"head -c 4000 g.sgy | sw-convert", 1, "standard input: ends within trace 1: 400 of 1044 bytes"},
      {"head -c 2000 g.sgy | sw-convert", 1,
       "standard input: 2000 bytes, expected at least the 3600 of the SEG-Y headers"},
      {"sw-convert g.sgy --format int16 --revision 3", 2,
       "--revision: found '3', expected one of same, 0, 1, 2"},
      {"sw-convert g.sgy --format float", 2,
       "--format: sample format \"float\", expected one of ibm, int32, int16, ieee, double, int24, int8, "
       "int64, "
       "uint32, uint16, uint64, uint24, uint8"},
      {"sw-convert g.sgy --format double", 2,
       "sample format double exists since revision 2, the file is of revision 1"},
      {"sw-convert g.sgy --su --format ibm", 2, "sample format ibm, Seismic Unix holds ieee only"},
      {"sw-convert g.sgy --su --revision 1", 2,
       "found --su and --revision, expected one of them: Seismic Unix has no such thing"},
      {"sw-convert g.sgy --su --text ascii", 2,
       "found --su and --text, expected one of them: Seismic Unix has no such thing"},
  };
  for (const auto& [line, code, message] : cases) {
    expect_refused(line + " -o out.sgy", code, "sw-convert: " + message);
    EXPECT_EQ(content("out.sgy"), "older") << line;
    EXPECT_EQ(files(), before) << line;
  }
}

TEST_F(Convert, NamesTheSampleThatDoesNotFit) {
  shoot();
  // the third sample of the second trace becomes NaN, then 1e30
  const std::string at = std::to_string(3600 + 1044 + 240 + 8);
  done("printf '\\177\\300\\0\\0' | dd of=g.sgy bs=1 seek=" + at + " conv=notrunc status=none");
  for (const std::string options : {"", "--format ibm", "--endian little"})
    expect_refused("sw-convert g.sgy " + options + " -o out.sgy", 1,
                   "sw-convert: g.sgy: trace 2: sample 3: nan, expected a finite number");
  done("printf '\\161\\111\\362\\312' | dd of=g.sgy bs=1 seek=" + at + " conv=notrunc status=none");
  expect_refused("sw-convert g.sgy --format int32 -o out.sgy", 1,
                 "sw-convert: g.sgy: trace 2: sample 3: 1.0000000150474662e+30 does not fit a signed integer "
                 "of 32 bits");
  EXPECT_FALSE(exists("out.sgy"));
}

TEST_F(Convert, NeedsTheMemoryOfOneTrace) {
  shoot();
  // 100 000 traces of zeros behind the headers of a real file: 104 MB in 60 MB of address space
  const std::string zeros = "(head -c 3600 g.sgy; head -c 104400000 /dev/zero) |";
  for (const std::string tool : {"sw-convert --format ibm", "sw-convert", "sw-convert --su"}) {
    const std::string headers = tool.ends_with("--su") ? "0" : "3600";
    EXPECT_EQ(done(zeros + "(ulimit -v 60000; " + tool + ") | wc -c"),
              std::to_string(104400000 + std::stoi(headers)) + "\n")
        << tool;
  }
}

}  // namespace slipwave::convert_test
