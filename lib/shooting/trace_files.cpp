// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/trace_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "segy/writer.hpp"
#include "shooting/output_names.hpp"

namespace slipwave {

TraceFiles::TraceFiles(const OutputOptions& options, std::vector<Component> components,
                       const segy::FileFormat& format, segy::Heading textual_header,
                       std::function<void(const std::string&)> warn)
    : options_(options),
      components_(std::move(components)),
      format_(format),
      textual_header_(std::move(textual_header)),
      warn_(std::move(warn)),
      one_per_shot_(holds(options.traces, "{shot}")) {}

std::string TraceFiles::name(std::size_t shot, Component component) const {
  return name_for(options_.traces, options_.number_of(shot), name_of(component));
}

void TraceFiles::open(std::size_t shot) {
  for (const Component component : components_) {
    const auto file = name(shot, component);
    if (files_.count(file) == 0) files_.try_emplace(file, file, OutputFile::Content::binary);
  }
}

bool TraceFiles::exist(std::size_t shot) const {
  return std::all_of(components_.begin(), components_.end(), [&](Component component) {
    const auto file = name(shot, component);
    return file == "-" || access(file.c_str(), F_OK) == 0;
  });
}

/// The traces of all finished shots, moved out of the state, by the names of their files.
std::map<std::string, Gather> TraceFiles::gathers_by_file(RunState& state, std::size_t shots) const {
  std::map<std::string, Gather> gathers;
  for (std::size_t shot = 1; shot <= shots; ++shot) {
    Gather* const gather = state.gather(shot);
    if (!gather) continue;
    for (auto& trace : gather->traces) {
      trace.header.shot += options_.first_shot - 1;
      auto& collected = gathers[name(shot, trace.header.component)];
      collected.axis = gather->axis;
      collected.traces.push_back(std::move(trace));
    }
  }
  return gathers;
}

/// Returns what the file holds less exactly.
std::vector<std::string> TraceFiles::write_file(const std::string& name, OutputFile& file,
                                                const Gather& gather,
                                                const segy::Heading& textual_header) const {
  auto sentences = segy::write_gather(file, gather, segy::format_named_by(name, format_), textual_header);
  file.commit();
  return sentences;
}

void TraceFiles::warn_once(const std::vector<std::string>& sentences) {
  for (const auto& sentence : sentences)
    if (warned_.insert(sentence).second) warn_(sentence);
}

void TraceFiles::write(RunState& state, std::size_t shots) {
  for (std::size_t shot = 1; shot <= shots; ++shot)
    if (state.gather(shot)) open(shot);
  auto gathers = gathers_by_file(state, shots);
  for (auto& [name, file] : files_) {
    warn_once(write_file(name, file, gathers[name], textual_header_));
  }
  files_.clear();
  for (std::size_t shot = 1; shot <= shots; ++shot)
    if (state.finished(shot)) state.release(shot);
}

void TraceFiles::write_finished(RunState& state, std::size_t shots) {
  for (const auto& [name, gather] : gathers_by_file(state, shots)) {
    warn_once(write_file(name, files_.at(name), gather, textual_header_));
  }
}

void TraceFiles::write_unstable(RunState& state, std::size_t shots, const std::string& line,
                                std::vector<std::string>& written) const {
  auto textual_header = textual_header_;
  textual_header.entries.push_back(line);
  for (const auto& [name, gather] : gathers_by_file(state, shots)) {
    OutputFile file(unstable_name(name), OutputFile::Content::binary);
    write_file(name, file, gather, textual_header);
    written.push_back(unstable_name(name));
  }
}

}  // namespace slipwave
