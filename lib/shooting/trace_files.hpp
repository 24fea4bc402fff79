// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "checkpoint/run_state.hpp"
#include "gather/trace.hpp"
#include "io/output_file.hpp"
#include "segy/writer.hpp"
#include "shooting/output_options.hpp"

namespace slipwave {

/// The SEG-Y files of a run. They are opened before the shots that go into them are simulated, so that a name
/// that cannot be written costs no computing.
class TraceFiles {
 public:
  /// `components`: what is recorded; empty where there are no traces. `textual_header`: of every file.
  /// `warn` hears, once each, what a file holds less exactly than it was recorded.
  TraceFiles(const OutputOptions& options, std::vector<Component> components, const segy::FileFormat& format,
             segy::Heading textual_header, std::function<void(const std::string&)> warn);

  /// Whether every shot has files of its own.
  bool one_per_shot() const { return one_per_shot_; }
  /// Opens the files of a shot that are not open.
  void open(std::size_t shot);
  /// Whether all files of a shot exist under their names.
  bool exist(std::size_t shot) const;
  /// Writes the traces of all finished shots and puts the files in place; the state releases the traces.
  void write(RunState& state, std::size_t shots);
  /// After an unstable shot: puts files of their own of shots that finished in place.
  void write_finished(RunState& state, std::size_t shots);
  /// After an unstable shot: writes what all shots recorded under other names (unstable_name) with one more
  /// line of textual header. Adds each name to `written` once the file is in place.
  void write_unstable(RunState& state, std::size_t shots, const std::string& line,
                      std::vector<std::string>& written) const;

 private:
  std::vector<std::string> write_file(const std::string& name, OutputFile& file, const Gather& gather,
                                      const segy::Heading& textual_header) const;
  void warn_once(const std::vector<std::string>& sentences);
  std::string name(std::size_t shot, Component component) const;
  std::map<std::string, Gather> gathers_by_file(RunState& state, std::size_t shots) const;

  const OutputOptions& options_;
  std::vector<Component> components_;
  segy::FileFormat format_;
  segy::Heading textual_header_;
  std::function<void(const std::string&)> warn_;
  std::set<std::string> warned_;
  bool one_per_shot_;
  std::map<std::string, OutputFile> files_;  // open ones
};

}  // namespace slipwave
