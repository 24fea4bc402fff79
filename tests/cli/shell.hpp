// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "long_form.hpp"

/// What a command line left behind.
struct Ran {
  int code = 0;  // of bash with pipefail: of the last command that failed; 128 + N when a signal ended it
  std::string out, err;
  double peak_mib = 0;  // resident memory of the largest process
};

/// A test that runs shell lines in a fresh temporary directory, removed afterwards, with the tools of this
/// build first on PATH. The name of a file in a line is relative to that directory. A line may use
///   await 'COMMAND'  until the command succeeds, for half a minute at most, then says what it waited for
///   next_second      until the clock shows another second, so that a time of making would differ
class Shell : public ::testing::Test {
 protected:
  Shell();
  ~Shell() override;

  Ran run(const std::string& line) const;
  /// Runs and expects exit 0 and nothing on stderr; returns stdout.
  std::string done(const std::string& line) const;
  /// Runs and expects this exit code and exactly this line on stderr.
  void expect_refused(const std::string& line, int code, const std::string& message) const;

  /// What a command begins with to be so many processes; nothing without MPI.
  static std::string on_ranks(int count);

  std::string path(const std::string& name) const { return directory_ + '/' + name; }
  bool exists(const std::string& name) const;
  std::string content(const std::string& name) const;
  void write(const std::string& name, const std::string& content) const;
  /// Names of all files in the directory, hidden ones too, sorted, blanks between.
  std::string files() const;

 private:
  std::string directory_;
};
