// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/table.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "io/netcdf_file.hpp"
#include "model_cases.hpp"
#include "scratch.hpp"

namespace slipwave::accuracy_table_test {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Three settings whose numbers are all different: no column can stand for another.
AccuracyTable some_table() {
  AccuracyTable table;
  table.title = "a scene";
  table.history = "sw-accuracy m.nc -o t.nc";
  table.reference = "order 7, 1.25 m";
  table.reference_error = 0.004;
  table.wanted_error = 0.02;
  table.chosen = 1;
  for (int n = 0; n < 3; ++n) {
    const double m = n + 1;
    AccuracyRow row;
    row.order = 3 + 2 * n;
    row.time_order = n == 2 ? 4 : 2;
    row.courant = 0.1 + 0.3 * n;
    row.spacing_m = 10 / m;
    row.slip_order = n;
    row.cells = 5'000'000'001 * (n + 1);  // more than an int holds
    row.steps = 700 + n;
    row.error = 0.03 / m;
    row.late_error = 0.04 / m;
    row.seconds = 11 * m;
    row.memory_bytes = 17 * m * (1 << 20);
    table.rows.push_back(row);
  }
  return table;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const AccuracyTable& found, const AccuracyTable& exact) {
  EXPECT_EQ(found.title, exact.title);
  EXPECT_EQ(found.history, exact.history);
  EXPECT_EQ(found.reference, exact.reference);
  EXPECT_EQ(found.reference_error, exact.reference_error);
  EXPECT_EQ(found.wanted_error, exact.wanted_error);
  EXPECT_EQ(found.chosen, exact.chosen);
  ASSERT_EQ(found.rows.size(), exact.rows.size());
  for (std::size_t n = 0; n < exact.rows.size(); ++n) {
    const auto &a = found.rows[n], &b = exact.rows[n];
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.time_order, b.time_order);
    EXPECT_EQ(a.slip_order, b.slip_order);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_TRUE(same(a.courant, b.courant)) << n;
    EXPECT_TRUE(same(a.spacing_m, b.spacing_m)) << n;
    EXPECT_TRUE(same(a.error, b.error)) << n;
    EXPECT_TRUE(same(a.late_error, b.late_error)) << n;
    EXPECT_TRUE(same(a.seconds, b.seconds)) << n;
    EXPECT_TRUE(same(a.memory_bytes, b.memory_bytes)) << n;
  }
}

class AccuracyTables : public testing::Test {
 protected:
  std::string path() { return scratch_.file("t.nc"); }
  void write(const AccuracyTable& table) {
    OutputFile out(path(), OutputFile::Content::binary);
    write_accuracy_table(out, table, "slipwave test");
  }
  /// A copy of the good file: what `changed` returns true for is made by itself.
  template <class Changed>
  void write_damaged(const Changed& changed) {
    write(some_table());
    const auto good = NetcdfFile::open(path());
    auto file = NetcdfFile::create(scratch_.file("bad.nc"), path());
    file.define_dimension("setting", 3);
    for (const auto& variable : good.variables()) {
      if (changed(file, variable.name)) continue;
      file.define_variable(variable.name, variable.type, variable.dimensions);
      file.put(variable.name, good.get<double>(variable.name).data());
    }
    file.close();
  }
  std::string sentence_of_damaged() {
    const auto bad = scratch_.file("bad.nc");
    const auto sentence = sentence_of([&] { read_accuracy_table(bad); });
    return sentence.rfind(bad + ": ", 0) == 0 ? sentence.substr(bad.size() + 2) : sentence;
  }

  Scratch scratch_;
};

}  // namespace

TEST_F(AccuracyTables, ComeBackAsTheyWereWritten) {
  auto table = some_table();
  write(table);
  expect_same(read_accuracy_table(path()), table);
  // The reference has no error; nobody asked for one.
  table.rows[0].error = table.rows[0].late_error = unknown;
  table.wanted_error.reset();
  table.chosen.reset();
  write(table);
  expect_same(read_accuracy_table(path()), table);
  // Nothing is good enough.
  table.wanted_error = 1e-9;
  write(table);
  expect_same(read_accuracy_table(path()), table);
}

TEST_F(AccuracyTables, SayWhatTheirColumnsAre) {
  write(some_table());
  const auto file = NetcdfFile::open(path());
  EXPECT_EQ(file.text_attribute("", "source"), "slipwave test");
  EXPECT_EQ(file.variables().size(), 11u);
  for (const auto& variable : file.variables()) {
    EXPECT_EQ(variable.dimensions, std::vector<std::string>{"setting"}) << variable.name;
    EXPECT_TRUE(file.text_attribute(variable.name, "long_name")) << variable.name;
    EXPECT_TRUE(file.text_attribute(variable.name, "units")) << variable.name;
  }
  EXPECT_EQ(file.get<double>("step"), (std::vector<double>{10, 5, 10. / 3}));
  EXPECT_EQ(file.text_attribute("step", "units"), "m");
  EXPECT_EQ(file.text_attribute("seconds", "units"), "s");
  EXPECT_EQ(file.get<double>("error"), (std::vector<double>{0.03, 0.015, 0.01}));
}

TEST_F(AccuracyTables, WithoutAColumnAreRefusedByItsName) {
  std::vector<std::string> names;
  write_damaged([&](NetcdfFile&, const std::string& name) {
    names.push_back(name);
    return false;
  });
  EXPECT_EQ(sentence_of_damaged(), "no error");
  ASSERT_EQ(names.size(), 11u);
  for (const auto& missing : names) {
    write_damaged([&](NetcdfFile&, const std::string& name) { return name == missing; });
    EXPECT_EQ(sentence_of_damaged(), "found no variable " + missing + ", expected a table of sw-accuracy");
  }
}

TEST_F(AccuracyTables, WithAColumnOfAnotherSizeOrTypeAreRefused) {
  for (const std::string wrong : {"order", "seconds"}) {
    write_damaged([&](NetcdfFile& file, const std::string& name) {
      if (name != wrong) return false;
      file.define_dimension("other", 2);
      file.define_variable(name, NetcdfFile::Type::f64, {"other"});
      file.put(name, std::vector<double>{1, 2}.data());
      return true;
    });
    EXPECT_EQ(sentence_of_damaged(), "found 2 values of " + wrong + ", expected 3");
    write_damaged([&](NetcdfFile& file, const std::string& name) {
      if (name != wrong) return false;
      file.define_variable(name, NetcdfFile::Type::text, {"setting"});
      file.put_text(name, {"one", "two", "three"});
      return true;
    });
    EXPECT_EQ(sentence_of_damaged().rfind(wrong + ": ", 0), 0u) << sentence_of_damaged();
  }
}

TEST_F(AccuracyTables, WithCountsThatAreNoneAreRefused) {
  for (const double count : {-1., unknown, 1e300}) {
    write_damaged([&](NetcdfFile& file, const std::string& name) {
      if (name != "steps") return false;
      file.define_variable(name, NetcdfFile::Type::f64, {"setting"});
      file.put(name, std::vector<double>{1, count, 2}.data());
      return true;
    });
    EXPECT_EQ(sentence_of_damaged(), "found steps = " + shown(count) + ", expected a count");
  }
}

TEST_F(AccuracyTables, WithAChoiceThatIsNoRowAreRefused) {
  for (const double chosen : {-1., 3., 1e30, unknown, 0.5}) {
    write_damaged([&](NetcdfFile& file, const std::string& name) {
      if (name == "order") file.put_attribute("", "chosen", std::vector<double>{chosen});
      return false;
    });
    EXPECT_EQ(sentence_of_damaged(), "found chosen = " + shown(chosen) + ", expected a row below 3");
  }
}

TEST_F(AccuracyTables, OfOtherKindsOfFilesAreRefused) {
  auto file = NetcdfFile::create(scratch_.file("bad.nc"), "bad.nc");
  file.define_dimension("x", 3);
  file.close();
  EXPECT_EQ(sentence_of_damaged(), "found no dimension setting, expected a table of sw-accuracy");
  EXPECT_EQ(sentence_of([] { read_accuracy_table("none.nc"); }), "none.nc: No such file or directory");
}

TEST_F(AccuracyTables, ThatClaimMoreRowsThanTheFileHoldsAreRefused) {
  // Before so much memory is asked for.
  auto file = NetcdfFile::create(scratch_.file("bad.nc"), "bad.nc");
  file.define_dimension("setting", std::size_t(1) << 40);
  file.define_variable("order", NetcdfFile::Type::i32, {"setting"}, {true, {1024}});
  file.put("order", {0}, {2}, std::vector<int>{5, 7}.data());
  file.close();
  EXPECT_NE(sentence_of_damaged().find("which cannot hold as many"), std::string::npos)
      << sentence_of_damaged();
}

TEST(CheapestRow, IsTheFastestOfThoseThatAreGoodEnough) {
  auto rows = some_table().rows;  // errors 3, 1.5 and 1 %; 11, 22 and 33 s
  EXPECT_EQ(cheapest(rows, 0.5), 0u);
  EXPECT_EQ(cheapest(rows, 0.02), 1u);
  EXPECT_EQ(cheapest(rows, 0.01), 2u);  // at most, not below
  EXPECT_EQ(cheapest(rows, 0.0099), std::nullopt);
  EXPECT_EQ(cheapest({}, 1), std::nullopt);
  std::swap(rows[0].seconds, rows[2].seconds);
  EXPECT_EQ(cheapest(rows, 0.5), 2u);
  rows[2].error = unknown;  // the reference
  EXPECT_EQ(cheapest(rows, 0.5), 1u);
}

TEST(TextOfATable, HasALineARowUnderItsHeadings) {
  auto table = some_table();
  table.rows[0].error = table.rows[0].late_error = unknown;
  std::istringstream lines(text_of(table));
  std::vector<std::string> comments, rows;
  for (std::string line; std::getline(lines, line);) (line[0] == '#' ? comments : rows).push_back(line);
  ASSERT_EQ(comments.size(), 4u);
  EXPECT_EQ(comments[0], "# a scene");
  EXPECT_NE(comments[1].find("in percent against order 7, 1.25 m, whose own error is measured as 0.4;"),
            std::string::npos);
  EXPECT_EQ(comments[3], "# < the cheapest with an error of at most 2 %");
  const auto words = [](const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> all;
    for (std::string word; stream >> word;) all.push_back(word);
    return all;
  };
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(words(rows[0]), (std::vector<std::string>{"3", "2", "0.1", "10", "0", "5000000001", "700", "-",
                                                      "-", "11", "17"}));
  EXPECT_EQ(words(rows[1]), (std::vector<std::string>{"5", "2", "0.4", "5", "1", "10000000002", "701", "1.5",
                                                      "2", "22", "34", "<"}));
  EXPECT_EQ(words(rows[2]), (std::vector<std::string>{"7", "4", "0.7", "3.333", "2", "15000000003", "702",
                                                      "1", "1.33", "33", "51"}));
  EXPECT_EQ(words(comments[2]),
            (std::vector<std::string>{"#", "order", "time", "courant", "step_m", "slip", "cells", "steps",
                                      "error", "late", "cpu_s", "MiB"}));
}

TEST(TextOfATable, EndsColumnsUnderTheEndsOfTheirHeadings) {
  auto table = some_table();
  for (auto& row : table.rows) row.cells /= 1000;
  std::istringstream lines(text_of(table));
  std::vector<std::vector<std::size_t>> ends;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("# ", 0) == 0 && line.rfind("# order", 0) != 0) continue;
    ends.emplace_back();
    for (std::size_t n = 0; n < line.size(); ++n)
      if (line[n] != ' ' && line[n] != '#' && line[n] != '<' && (n + 1 == line.size() || line[n + 1] == ' '))
        ends.back().push_back(n);
  }
  ASSERT_EQ(ends.size(), 4u);
  for (const auto& row : ends) EXPECT_EQ(row, ends[0]);
}

TEST(TextOfATable, SaysWhenNoneIsGoodEnoughAndNothingWhenNobodyAsked) {
  auto table = some_table();
  table.chosen.reset();
  table.wanted_error = 1e-4;
  EXPECT_NE(text_of(table).find("\n# none has an error of at most 0.01 %\n"), std::string::npos);
  EXPECT_EQ(text_of(table).find('<'), std::string::npos);
  table.wanted_error.reset();
  EXPECT_EQ(text_of(table).find("at most"), std::string::npos);
}

}  // namespace slipwave::accuracy_table_test
