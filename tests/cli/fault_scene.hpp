// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "shell.hpp"

/// A test of what tools do when the machine fails them: a directory with small inputs in `in/`, and commands
/// of every tool on them.
class FaultScene : public Shell {
 protected:
  void SetUp() override;

  struct Command {
    std::string tool, arguments;
    std::string output;  // a name of the ending the tool wants; "": to standard output only

    /// The line with its output there: a file or -.
    std::string to(const std::string& place) const;
    std::string to_file() const { return to(output); }
    /// What the tool says of an output that failed.
    std::string sentence(const std::string& cause) const {
      return tool + ": " + (output.empty() ? "standard output" : output) + ": " + cause + "\n";
    }
  };
  /// One or more for every tool.
  static std::vector<Command> commands();
  /// `line` with the shim loaded into the tool it starts.
  static std::string with_fault(const std::string& fault, const std::string& line);
};
