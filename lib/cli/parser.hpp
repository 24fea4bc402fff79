// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/tool.hpp"

namespace slipwave::cli {

/// One declared option: how it is shown and where its text goes.
struct Options::Option {
  std::string name;         // long, without dashes
  std::string short_name;   // one letter or empty
  std::string placeholder;  // empty: a switch
  std::string help;
  std::string shown_default;
  std::string heading;  // above it in --help
  bool common = false;  // shown by --help where not all are
  bool many = false;
  bool required = false;
  bool provenance = true;                                      // the bytes of the output may depend on it
  std::function<void(const std::vector<std::string>&)> store;  // throws Error "found .., expected .."
};

/// One positional argument, or all the rest.
struct Options::Positional {
  std::string placeholder;
  bool many = false;
  bool required = false;
  std::function<void(const std::vector<std::string>&)> store;
};

/// What goes with one option: it needs one of the others, or excludes all of them.
struct Options::Rule {
  std::string name;
  std::vector<std::string> others;
  bool excludes = false;
  std::string why;
};

/// What every tool understands beside its own options.
struct CommonSettings {
  bool quiet = false, verbose = false, help = false, help_all = false, version = false;
  int threads = 0;
  std::string config, log;
};

/// Reads a command line and the --config file into the bound settings. All errors are usage Errors of one
/// sentence; a name nobody declared is answered with the nearest one.
class Parser {
 public:
  explicit Parser(const ToolInfo& info) : info_(info) {}
  /// The tool's declarations go in here; the common ones follow in parse().
  Options& options() { return options_; }
  void declare_common();
  void parse(int argc, const char* const* argv);
  const CommonSettings& common() const { return common_; }
  /// Returns the command line, as Context::command_line holds it. After parse().
  const std::string& command_line() const { return command_line_; }
  /// The text of --help or --help-all.
  std::string help() const;

 private:
  using Values = std::map<std::string, std::vector<std::string>>;

  void read_command_line(int argc, const char* const* argv);
  void read_config();
  void add_to_command_line(const std::string& name, const std::vector<std::string>& values,
                           const std::vector<std::string>& words);
  void check_rules() const;
  bool is_excluded(const std::string& name) const;
  void store();
  bool is_declared(const std::string& word) const;
  bool has_more() const;
  bool is_provenance(const std::string& name) const;
  [[noreturn]] void refuse_without_value(const std::string& name) const;
  std::string nearest(const std::string& name, bool config) const;

  ToolInfo info_;
  Options options_;
  CommonSettings common_;
  Values given_;
  std::set<std::string> own_, in_force_;  // options of the command line, and those of the config file, too
  std::vector<std::string> arguments_;
  std::string command_line_;  // inputs first, then options of the command line and of the config file
};

/// Whether a switch of that value in a config file is on; throws a usage Error on a word that says neither.
bool truth_of(const std::string& text);

/// `word` as a POSIX shell must be given it.
std::string quoted(const std::string& word);

}  // namespace slipwave::cli
