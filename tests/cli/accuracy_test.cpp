// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <tuple>
#include <vector>

#include "shell.hpp"

namespace slipwave::accuracy_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string shots =
    "--source 200,200 --wavelet ricker:15 --receivers 150:450:50,450 --time 0.3 --top absorbing ";
const std::string ladder = "--steps 20,10 --orders 3,7 --cfls 0.9,0.4 --reference 7,0.4,5 ";
/// An explosion in uniform rock: P waves only, and nothing that comes back.
const std::string rock_shot =
    "--source 200,200 --wavelet ricker:25 --receivers 150:450:50,450 --time 0.3 --top absorbing "
    "--record vx,vz ";
/// Columns of the text.
constexpr std::size_t order = 0, courant = 2, step = 3, slip = 4, error = 7, seconds = 9;

/// Rows of the text without its comments, "-" as NaN; the mark of the chosen row is left out.
std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; words >> word && word != "<";)
      rows.back().push_back(word == "-" ? std::numeric_limits<double>::quiet_NaN() : std::stod(word));
  }
  return rows;
}

/// The one number of a line like "all 1.2 3.4" that `sed` found.
double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

class Accuracy : public Shell {
 protected:
  void SetUp() override {
    done("sw-layers --size 600x600 --step 10 --layer 0:2000:0:1000 --layer 300:3000:1500:2200 -o m.nc");
    done("sw-layers --size 600x600 --step 10 --layer 0:3000:1500:2200 -o rock.nc");
  }
};

}  // namespace

TEST_F(Accuracy, OfEverySettingIsALineAndTheCheapestGoodOneIsMarked) {
  const auto text = done("sw-accuracy m.nc " + shots + ladder + "--error 0.3 -o t.nc");
  const auto rows = rows_of(text);
  ASSERT_EQ(rows.size(), 9u) << text;
  for (const auto& row : rows) ASSERT_EQ(row.size(), 11u) << text;
  // The reference first: it has no error.
  EXPECT_TRUE(std::isnan(rows[0][error])) << text;
  EXPECT_EQ(rows[0][step], 5);
  EXPECT_TRUE(has(text, "against order 7, Courant 0.4, 5 m, whose own error is measured as ")) << text;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    EXPECT_GT(rows[n][error], 0) << text;
    EXPECT_GT(rows[n][seconds], 0) << text;
  }
  // The same order and Courant number in smaller cells.
  for (std::size_t n = 1; n <= 4; ++n) {
    EXPECT_EQ(rows[n][step], 20);
    EXPECT_EQ(rows[n + 4][step], 10);
    EXPECT_EQ(rows[n + 4][order], rows[n][order]);
    EXPECT_NEAR(rows[n + 4][courant], rows[n][courant], 1e-3);
    EXPECT_LT(rows[n + 4][error], rows[n][error]) << text;
  }
  EXPECT_LT(rows[8][error], 5) << text;

  double best = std::numeric_limits<double>::infinity();
  for (const auto& row : rows)
    if (row[error] <= 30) best = std::min(best, row[seconds]);
  ASSERT_TRUE(std::isfinite(best)) << text;
  const auto marked = rows_of(done("sw-accuracy m.nc " + shots + ladder + "--error 0.3 | grep '<$'"));
  ASSERT_EQ(marked.size(), 1u);
  EXPECT_LE(marked[0][error], 30);
  const auto line = text.substr(text.rfind('\n', text.find("  <\n") - 1) + 1);
  EXPECT_EQ(rows_of(line)[0][seconds], best) << text;
}

TEST_F(Accuracy, IsTheSameInTheTextInTheFileAndInWhatInfoSays) {
  const auto rows = rows_of(done("sw-accuracy m.nc " + shots + ladder + "--error 0.3 -o t.nc"));
  const auto info = done("sw-info t.nc");
  for (const std::string words :
       {"t.nc: accuracy\n", " order 7, Courant 0.4, 5 m\n", "  30 %\n",
        "order 3, time order 2, courant 0.9, step 20 m", " sw-layers --size 600x600"})
    EXPECT_TRUE(has(info, words)) << words << " in " << info;
  EXPECT_EQ(done("sw-info t.nc | grep -c '^  setting '"), "9\n");
  EXPECT_EQ(done("sw-info --json t.nc | grep -o '\"late_error\"' | wc -l"), "9\n");  // 8, and the chosen one
  if (run("ncdump 2> /dev/null; test $? -ne 127").code != 0) GTEST_SKIP() << "no ncdump (netcdf-bin)";
  const auto dumped = [&](const std::string& name) {
    return done("ncdump -v " + name + " t.nc | sed -n '/^ " + name +
                " =/,/;/p' | tr -d '=;,\\n' | sed 's/^ " + name + " *//'");
  };
  for (const auto& [name, column, scale] :
       {std::tuple{"error", error, 100.}, {"seconds", seconds, 1.}, {"step", step, 1.}}) {
    std::istringstream words(dumped(name));
    for (const auto& row : rows) {
      std::string word;
      ASSERT_TRUE(words >> word) << name;
      const double value = scale * number(word);
      EXPECT_EQ(std::isnan(value), std::isnan(row[column])) << name << ": " << word;
      // The text has three digits.
      if (!std::isnan(value)) {
        EXPECT_NEAR(value, row[column], 0.006 * value) << name;
      }
    }
  }
  const auto header = done("ncdump -h t.nc");
  for (const std::string words : {"setting = 9", ":wanted_error = 0.3", ":chosen = ", "error:units = \"1\""})
    EXPECT_TRUE(has(header, words)) << words << " in " << header;
}

TEST_F(Accuracy, VariesTheSlipCorrectionOnlyWhereSomethingSlips) {
  done("sw-fracture rock.nc --box 200:400,250:350 --dip 30 --friction 0.1 --viscosity 1e4 -o f.nc");
  const std::string few = "--amplitude 1e11 --steps 20 --orders 5 --cfls 0.9 --corrections first,second ";
  const auto text = done("sw-accuracy f.nc " + shots + few + "--reference 7,0.4,10");
  const auto rows = rows_of(text);
  ASSERT_EQ(rows.size(), 3u) << text;
  EXPECT_EQ(rows[1][slip], 1) << text;
  EXPECT_EQ(rows[2][slip], 2) << text;
  EXPECT_NE(rows[1][error], rows[2][error]) << text;
  EXPECT_EQ(rows_of(done("sw-accuracy f.nc " + shots + few + "--without slip")).size(), 2u);
}

TEST_F(Accuracy, TakesTheConfigurationOfAShot) {
  write("shot.cfg",
        "source = 200,200\nwavelet = ricker:15\nreceivers = 150:450:50,450\ntime = 0.3\ntop = absorbing\n"
        "order = 7\nevery = 0.1\nfields = vx\n");
  const std::string few = " --steps 20 --orders 5 --cfls 0.9";
  const auto columns = " | grep -v '^#' | cut -c 1-52";  // up to the errors: times differ
  EXPECT_EQ(done("sw-accuracy m.nc --config shot.cfg" + few + columns),
            done("sw-accuracy m.nc " + shots + few + columns));
}

TEST_F(Accuracy, WantedOfAShotIsMeasuredAndKept) {
  done("sw-layers --size 600x600 --step 2.5 --layer 0:3000:1500:2200 -o fine.nc");
  done("sw-shoot fine.nc " + rock_shot + "--order 7 --cfl 0.4 -o fine.sgy");
  double before = 1;
  for (const double wanted : long_form() ? std::vector{0.04, 0.01} : std::vector{0.04}) {
    const Ran ran = run("sw-shoot rock.nc " + rock_shot + "--error " + std::to_string(wanted) +
                        " --error-gather error.sgy --json -o chosen.sgy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const std::string says = "measured error: ";
    const auto at = ran.err.find(says);
    ASSERT_NE(at, std::string::npos) << ran.err;
    const double share = number(ran.err.substr(at + says.size())) / 100;
    EXPECT_LE(share, wanted) << ran.err;
    EXPECT_TRUE(has(ran.out, "\"error_measured\": {\"value\": ")) << ran.out;
    EXPECT_TRUE(has(done("sw-info chosen.sgy"), "traces")) << ran.err;
    const auto exceeds = [&](double bound) {
      return run("sw-compare chosen.sgy fine.sgy -q --tolerance " + std::to_string(bound)).code;
    };
    EXPECT_EQ(exceeds(wanted), 0) << ran.err;
    // Not bought at any price.
    EXPECT_EQ(exceeds(wanted / 20), 1) << ran.err;
    EXPECT_LT(share, before);
    before = share;
    // A trace of errors for each trace, as large as was said.
    EXPECT_EQ(done("sw-info chosen.sgy | grep '^  traces'"), done("sw-info error.sgy | grep '^  traces'"));
  }
  const Ran never = run("sw-shoot rock.nc " + rock_shot + "--error 1e-4 --budget 0.5 -o most.sgy");
  EXPECT_EQ(never.code, 0) << never.err;
  EXPECT_TRUE(has(never.err, "warning: wanted 0.01 %, reached ")) << never.err;
  EXPECT_TRUE(exists("most.sgy"));
}

TEST_F(Accuracy, OfAShotIsMeasuredAsItIsAndChangesNoTrace) {
  done("sw-shoot m.nc " + shots + "-o plain.sgy");
  const Ran ran = run("sw-shoot m.nc " + shots + "--measure -o measured.sgy");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has(ran.err, "% of all traces (vz ")) << ran.err;
  EXPECT_TRUE(has(ran.err, "by cells of 15 and 22.5 m")) << ran.err;
  done("cmp <(tail -c +3601 plain.sgy) <(tail -c +3601 measured.sgy)");
  const auto plan = done("sw-shoot m.nc " + shots + "--plan --measure");
  EXPECT_TRUE(has(plan, "\n  measured error")) << plan;
  expect_refused(
      "sw-shoot m.nc " + shots + "--plan --error 0.01", 2,
      "sw-shoot: found --plan with --error, which runs the scene to choose; --plan --measure measures "
      "its own setting");
}

TEST_F(Accuracy, OfTheLastLineIsThatOfDirectWaves) {
  const auto last = [&](const std::string& time) {
    return done("sw-shoot rock.nc --source 300,300 --wavelet ricker:15 --receivers 100:500:100,450 --time " +
                time + " -v -o last.sgy 2>&1 | tail -1");
  };
  const auto plan = done(
      "sw-shoot rock.nc --source 300,300 --wavelet ricker:15 --receivers 100:500:100,450 "
      "--time 0.4 --plan --json");
  const std::string says = "expected error ", planned = "\"dispersion_of_direct_P_waves\": {\"value\": ";
  const auto some = last("0.4");
  ASSERT_TRUE(has(some, says)) << some;
  ASSERT_TRUE(has(plan, planned)) << plan;
  EXPECT_EQ(number(some.substr(some.find(says) + says.size())),
            number(plan.substr(plan.find(planned) + planned.size())));
  EXPECT_TRUE(has(last("0.01"), "no direct wave arrives")) << last("0.01");
}

TEST_F(Accuracy, OfBadInputIsRefusedInOneLineBeforeAnythingIsRun) {
  const std::string tool = "timeout 60 sw-accuracy m.nc -o t.nc ";
  const std::string endless = "--source 200,200 --wavelet ricker:15 --receivers 150,450 --time 3000 ";
  write("t.nc", "older");
  struct Case {
    std::string line;
    int code;
    std::string message;
  };
  const std::vector<Case> cases = {
      {tool + endless + "--orders 5,4", 2, "--orders: found 4, expected one of 1, 3, 5, 7, 9, 11"},
      {tool + endless + "--orders 5,x", 2, "--orders: found 'x', expected a number"},
      {tool + endless + "--order 5", 2, "unknown option --order; did you mean --orders?"},
      {tool + endless + "--time-orders 3", 2, "--time-orders: found 3, expected one of 2, 4"},
      {tool + endless + "--cfls 0", 2, "--cfls: found 0, expected numbers above 0"},
      {tool + endless + "--corrections third", 2,
       "--corrections: found third, expected first, second, exponential or centred"},
      {tool + endless + "--reference 7,0.4", 2, "--reference: found 7,0.4, expected ORDER,CFL,STEP"},
      {tool + endless + "--error 0", 2, "--error: found 0, expected it above 0"},
      {tool + endless + "--error -1", 2, "--error: found -1, expected it above 0"},
      {tool + "--wavelet ricker:15 --receivers 1,1 --time 1", 2,
       "--source is missing; give it, or --case full-space"},
      {tool + "--source 1,1 --wavelet ricker:15 --receivers 1,1", 2,
       "--time is missing; give it, or --case full-space"},
      {tool + endless + "--source 700,1", 2,
       "source 2 at x=700 z=1 lies outside the model, expected x=0..600 z=0..600"},
      {"timeout 60 sw-accuracy none.nc -o t.nc " + endless, 1, "none.nc: No such file or directory"},
      {"timeout 60 sw-accuracy m.nc -o nowhere/t.nc " + endless, 1,
       "nowhere/t.nc: No such file or directory"},
  };
  const auto before = files();
  for (const auto& [line, code, message] : cases) {
    expect_refused(line, code, "sw-accuracy: " + message);
    EXPECT_EQ(files(), before) << line;
  }
  for (const std::string steps : {"1000", "20,1000"}) {
    const Ran ran = run(tool + endless + "--steps " + steps);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(has(ran.err, "1000")) << ran.err;
  }
  EXPECT_EQ(content("t.nc"), "older");
  EXPECT_EQ(files(), before);
}

TEST_F(Accuracy, OfAModelWithoutSenseIsRefusedByPlace) {
  if (run("/usr/bin/python3 -c 'import netCDF4'").code != 0)
    GTEST_SKIP() << "no /usr/bin/python3 with netCDF4 (Debian: python3-netcdf4)";
  write("set.py", R"(
import netCDF4
m = netCDF4.Dataset('rock.nc', 'a'); m.set_auto_mask(False)
m['vs'][2, 3] = float('nan')
)");
  done("/usr/bin/python3 set.py");
  for (const std::string tool : {"sw-accuracy", "sw-shoot --error 0.01"})
    expect_refused(tool + " rock.nc -o t.nc " + shots, 1,
                   tool.substr(0, tool.find(' ')) +
                       ": rock.nc: vs at x=35 z=25 is NaN, expected a finite number not below zero");
  EXPECT_FALSE(exists("t.nc"));
}

TEST_F(Accuracy, OfAFullSpaceIsBelowAPercentAfterTwentyWavelengthsLong) {
  const auto text =
      done("sw-accuracy --case full-space --steps 5,4 --orders 7 --cfls 0.4 --error 0.01 -o t.nc");
  EXPECT_TRUE(has(text, "against the closed form")) << text;
  const auto rows = rows_of(text);
  ASSERT_EQ(rows.size(), 2u) << text;
  EXPECT_GT(rows[0][error], 1) << text;
  EXPECT_LT(rows[1][error], 1) << text;
  EXPECT_TRUE(has(text, "  <\n")) << text;
}

}  // namespace slipwave::accuracy_test
