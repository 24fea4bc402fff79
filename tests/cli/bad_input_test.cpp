// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "bad_models.hpp"
#include "shell.hpp"

namespace slipwave::bad_input_test {
namespace {

namespace fs = std::filesystem;

/// A row of a table: a command, and how it is refused.
struct Row {
  std::string place;  // "shoot.txt:12"
  std::string line;
  int code = 0;
  std::string sentence;  // what follows "sw-X: "; * stands for any characters

  std::string tool() const {
    const auto begin = line.find("sw-");
    return line.substr(begin, line.find(' ', begin) - begin);
  }
  /// With an output that must survive, where the tool has one and the row names none.
  std::string complete() const {
    return line + (tool() == "sw-info" || line.find(" -o ") != std::string::npos ? "" : " -o out");
  }
};

const std::vector<std::string> tables = {"accuracy", "compare", "convert", "diff",   "export",   "filter",
                                         "fracture", "import",  "info",    "layers", "marmousi", "options",
                                         "pairs",    "plot",    "select",  "shoot",  "sort",     "spectrum"};

/// Also where links lead in a circle.
bool exists_as_file(const fs::directory_entry& entry) {
  std::error_code failed;
  return entry.is_regular_file(failed);
}

/// One that need not be read again for every row.
bool is_large(const fs::directory_entry& entry) { return entry.file_size() > (1 << 12); }

/// What any write to it changes.
std::string size_and_time(const fs::directory_entry& entry) {
  const auto written = entry.last_write_time().time_since_epoch().count();
  return std::to_string(entry.file_size()) + " bytes of " + std::to_string(written);
}

/// Two lines a row: the command, then indented "CODE: SENTENCE". Lines with # in front are remarks.
std::vector<Row> rows_of(const std::string& table) {
  std::ifstream file(SLIPWAVE_BAD_INPUT "/" + table + ".txt");
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] != ' ') {
      rows.push_back({table + ".txt:" + std::to_string(number), line, 0, ""});
      continue;
    }
    rows.back().code = std::stoi(line);
    rows.back().sentence = line.substr(line.find(": ") + 2);
  }
  return rows;
}

bool matches(const std::string& text, const std::string& pattern) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return text == pattern;
  if (text.compare(0, star, pattern, 0, star) != 0) return false;
  for (auto at = star; at <= text.size(); ++at)
    if (matches(text.substr(at), pattern.substr(star + 1))) return true;
  return false;
}

/// A directory of all that the tables need, which no row may change.
class Beside : public Shell {
 public:
  Beside() {
    write_bad_models(path(""));
    done("sh " SLIPWAVE_BAD_INPUT "/setup.sh");
    write("out", "older");
  }
  void TestBody() override {}

  /// Everything in the directory, by name; of large files, size and time, since all is read again for every
  /// row.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(path(""))) {
      const auto name = entry.path().filename().string();
      if (!exists_as_file(entry)) {
        all[name] = "";
      } else {
        all[name] = is_large(entry) ? size_and_time(entry) : content(name);
      }
    }
    return all;
  }
  using Shell::files;
  using Shell::run;
};
class BadInput : public ::testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(BadInput, IsRefusedInOneLineAndNothingIsWritten) {
  static const Beside beside;
  const auto before = beside.contents();
  const std::string shot = "shot='--source 100,50 --wavelet ricker:15 --receivers 0:200:50,20 --time 0.1'; ";
  const auto rows = rows_of(GetParam());
  // The short form has every other row of long tables.
  for (std::size_t n = 0; n < rows.size(); n += long_form() || rows.size() < 30 ? 1 : 2) {
    const auto& row = rows[n];
    const Ran ran = beside.run(shot + row.complete());
    EXPECT_EQ(ran.code, row.code) << row.place << ": " << row.line;
    EXPECT_TRUE(matches(ran.err, row.tool() + ": " + row.sentence + "\n"))
        << row.place << ": " << row.line << "\n  said     " << ran.err << "  expected " << row.sentence;
    // sw-info says what it could find out before it says what is wrong.
    EXPECT_TRUE(ran.out.empty() || row.tool() == "sw-info") << row.place << ": " << row.line;
    EXPECT_TRUE(beside.contents() == before)
        << row.place << ": " << row.line << "\n  left " << beside.files();
  }
}

INSTANTIATE_TEST_SUITE_P(Of, BadInput, ::testing::ValuesIn(tables),
                         [](const auto& info) { return info.param; });

TEST(BadInputTables, HoldHundredsOfRowsAndRowsOfEveryTool) {
  std::map<std::string, int> of_tool;
  std::size_t rows = 0;
  std::set<std::string> lines;
  for (const auto& table : tables)
    for (const auto& row : rows_of(table)) {
      ++rows;
      ++of_tool[row.tool()];
      EXPECT_TRUE(lines.insert(row.line).second) << row.place << ": stands twice";
      EXPECT_TRUE(row.code == 1 || row.code == 2) << row.place;
      EXPECT_NE(row.sentence, "") << row.place;
      EXPECT_EQ(row.sentence.find('\n'), std::string::npos) << row.place;
    }
  EXPECT_GE(rows, 300U);
  for (const auto& entry : fs::directory_iterator(SLIPWAVE_BIN)) {
    const auto tool = entry.path().filename().string();
    EXPECT_TRUE(tool.compare(0, 3, "sw-") != 0 || of_tool[tool] >= 9) << tool;
  }
}

}  // namespace slipwave::bad_input_test
