// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/messages.hpp"
#include "base/progress.hpp"

namespace slipwave::cli {

/// What --help, --version and messages say of a tool.
struct ToolInfo {
  std::string name;      // "sw-layers"
  std::string summary;   // one line: what it does
  std::string synopsis;  // "[options] [MODEL] [-o OUTPUT]"
  std::string example;   // one command line that works
};

/// In place of the help of an option that --help does not show: one for who checks the program.
inline constexpr const char* hidden = "";

/// Declares options bound to the tool's Settings. Names are the long option names without dashes; "output,o"
/// gives a short form. Every option can also stand in the file given by --config, the command line wins.
class Options {
 public:
  /// A value; `to` keeps its present content where the option is not given (shown as the default in --help).
  /// Where that is empty, an empty value is refused: it would pass for no option. Only a TEXT may be empty.
  void add(const std::string& name, std::string& to, const std::string& placeholder, const std::string& help);
  void add(const std::string& name, double& to, const std::string& placeholder, const std::string& help);
  void add(const std::string& name, int& to, const std::string& placeholder, const std::string& help);
  /// A number without a default.
  void add(const std::string& name, std::optional<double>& to, const std::string& placeholder,
           const std::string& help);
  void add(const std::string& name, std::optional<int>& to, const std::string& placeholder,
           const std::string& help);
  /// May be given several times.
  void add(const std::string& name, std::vector<std::string>& to, const std::string& placeholder,
           const std::string& help);
  /// A switch: given or not.
  void add(const std::string& name, bool& to, const std::string& help);
  /// One word of a fixed list; anything else is a usage error that names the list.
  void add_choice(const std::string& name, std::string& to, std::vector<std::string> choices,
                  const std::string& help);
  /// Must be given: its absence is a usage error. `name` of an option without its short form, or the
  /// placeholder of a positional argument. Options of which one must be given are the tool's own business.
  void require(const std::string& name);
  /// `name` says nothing without one of `others`: on the command line alone it is a usage error. In the file
  /// of --config, which several commands may share, it waits for a command that has one of them.
  void needs(const std::string& name, const std::vector<std::string>& others);
  /// `name` and any of `others` are a usage error, `why` in a few words; of one in the file of --config and
  /// one on the command line the latter counts.
  void excludes(const std::string& name, const std::vector<std::string>& others, const std::string& why = "");
  /// Returns the names of all options declared so far.
  std::vector<std::string> names() const;
  /// Headings of --help: each stands above the option named with it; those declared after that one are under
  /// it, too.
  void headings(const std::vector<std::pair<std::string, std::string>>& first_and_title);
  /// Names the options that --help shows; the others, --help-all. Without it --help shows all of them.
  void common(const std::vector<std::string>& names);
  /// Positional arguments, in order; the last may be a vector that takes all the rest.
  void positional(std::string& to, const std::string& placeholder);
  void positional(std::vector<std::string>& to, const std::string& placeholder);
  /// Names that may stand in the file of --config for another tool and mean nothing to this one.
  void pass_over(std::vector<std::string> names) { passed_over_ = std::move(names); }
  /// Declares --threads (only for tools that compute).
  void add_threads();
  /// Declares --log: for tools whose runs are long.
  void add_log();

 private:
  friend class Parser;
  struct Option;
  struct Positional;
  struct Rule;
  Options();
  ~Options();
  Option& declare(const std::string& name, const std::string& placeholder, const std::string& help);
  Option& declared(const std::string& name);

  std::vector<Option> options_;
  std::vector<Positional> positionals_;
  std::vector<Rule> rules_;
  std::vector<std::string> passed_over_;
};

/// A file of all that is said, with the time of each line: one that is there is continued.
class Log {
 public:
  /// `first`: what stands before all else, once there is anything. Throws Error where the file cannot be
  /// written.
  Log(const std::string& path, std::string first);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  /// "2026-11-25 23:05:41 sentence".
  void write(const std::string& sentence);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What run() gets beside its settings.
struct Context {
  /// Provenance: program name without path, names of inputs, then options, those of --config among them,
  /// quoted as a shell needs them. What does not change the bytes of the output is left out (-o that splits
  /// nothing, --threads, -q, -v, checkpoints), so they are the same wherever they are written.
  std::string command_line;
  std::string tool;     // "sw-layers"
  std::string version;  // "slipwave 0.2.0"
  bool quiet = false;
  bool verbose = false;
  int threads = 0;     // 0: not given
  Log* log = nullptr;  // of --log: takes all sentences, those of --verbose too
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();

  /// One line on stderr "sw-x: warning: ..." unless --quiet.
  void warn(const std::string& sentence) const;
  /// One line on stderr "sw-x: ..." unless --quiet.
  void say(const std::string& sentence) const;
  /// One line on stderr under --verbose.
  void note(const std::string& sentence) const;
  /// The last line of a run, on a terminal or under --verbose: this sentence, the time since the tool began
  /// and the largest memory that it took.
  void close(const std::function<std::string()>& sentence) const;
  /// A bar with rate and ETA on a terminal, a line every 10 % under --verbose without one, else nothing.
  /// `things` is what is counted, "steps" or "bytes".
  Progress progress(const std::string& what, const std::string& things = "bytes") const;
  /// These for what knows nothing of tools; they hold a copy of this.
  Messages messages() const;
};

/// Thrown to end a tool with this exit status and without a word: another process says why.
struct EndSilently {
  int status = 0;
};

/// One line on stderr "TOOL: sentence", as errors are said.
void say_error(const std::string& tool, const std::string& sentence);

/// The body of every main: options, --help, --version, --config, -q, -v, errors to one line and exit codes.
int run_tool(int argc, char** argv, const ToolInfo& info, const std::function<void(Options&)>& declare,
             const std::function<void(const Context&)>& run);

}  // namespace slipwave::cli
