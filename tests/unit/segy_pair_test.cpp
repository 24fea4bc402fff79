// SPDX-License-Identifier: BSD-3-Clause
#include "segy/pair.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_pair_test {

using namespace slipwave::segy;

namespace {

/// What reading A and B side by side says, file names shortened to "A" and "B".
std::string outcome(const Gather& a, const Gather& b) {
  const Scratch scratch;
  write_file(scratch.file("A"), a, {});
  write_file(scratch.file("B"), b, {});
  std::string sentence;
  try {
    Reader reader_a(scratch.file("A"));
    Reader reader_b(scratch.file("B"));
    PairReader pair(reader_a, reader_b);
    segy::Trace trace_a;
    segy::Trace trace_b;
    int pairs = 0;
    while (pair.next(trace_a, trace_b)) ++pairs;
    return std::to_string(pairs) + " pairs";
  } catch (const Error& error) {
    sentence = error.what();
  }
  const std::string folder = scratch.file("");
  for (auto at = sentence.find(folder); at != std::string::npos; at = sentence.find(folder))
    sentence.erase(at, folder.size());
  return sentence;
}

}  // namespace

TEST(PairReader, DeliversTracesOfTheSameSurvey) {
  EXPECT_EQ(outcome(survey_gather(), survey_gather()), "48 pairs");
}

TEST(PairReader, NamesFileTraceAndFieldThatDiffer) {
  Gather other = survey_gather();
  other.traces[5].header.receiver_m[0] += 12.5;
  EXPECT_EQ(outcome(survey_gather(), other), "B: trace 6: receiver x is 937.5 m, expected 925 m as in A");
  EXPECT_EQ(outcome(survey_gather(51), survey_gather(50)),
            "B: the number of samples is 50, expected 51 as in A");
  EXPECT_EQ(outcome(survey_gather(51, 4, 0.002), survey_gather(51, 4, 0.001)),
            "B: the sample interval is 0.001 s, expected 0.002 s as in A");
  other = survey_gather();
  other.traces.pop_back();
  EXPECT_EQ(outcome(survey_gather(), other), "B: has 47 traces, A has more");
  EXPECT_EQ(outcome(other, survey_gather()), "A: has 47 traces, B has more");
}

}  // namespace slipwave::segy_pair_test
