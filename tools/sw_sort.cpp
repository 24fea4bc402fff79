// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "io/output_file.hpp"
#include "io/temporary.hpp"
#include "segy/conversion.hpp"
#include "trace_input.hpp"
#include "traces/sorting.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::vector<std::string> inputs;  // none: standard input
  std::string output = "-";
  std::string key;
  int memory_mib = 256;
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.inputs, "A");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("key", settings.key, "KEY[,...]",
              "sort keys: cdp,offset; a leading - sorts in descending order: --key=-offset");
  options.require("key");
  options.add("memory", settings.memory_mib, "MIB",
              "memory for traces; more than that go through a temporary file");
  settings.input_options.declare(options);
}

/// The file header of the sorted traces.
segy::FileInfo info_of(const segy::Reader& reader, const cli::Context& context,
                       const segy::FileFormat& format, const SortKey& first, const TraceSorter& sorter) {
  segy::FileInfo info = segy::info_as(reader, context.command_line, format);
  info.layout.traces = sorter.records().count();
  info.layout.traces_per_shot = sorter.largest_ensemble();
  if (info.carried) {
    info.carried->set("sort", sorting_code(first));
    info.carried->set("ntrpr", 0);  // the layout's
  }
  return info;
}

void note_needs(const RecordSorter& records, const std::string& directory, const cli::Context& context) {
  const auto mib = [](std::uint64_t bytes) {
    return shown(static_cast<double>(bytes) / (1 << 20), 3) + " MiB";
  };
  std::string needs =
      std::to_string(records.count()) + " traces took " + mib(records.most_held()) + " of memory";
  if (records.on_disk() > 0) needs += " and " + mib(records.on_disk()) + " on disk, in " + directory;
  context.note(needs);
}

/// Puts all traces of a file into the sorter.
void add_all(segy::Reader& reader, TraceSorter& sorter, const Progress& progress) {
  segy::RawTrace trace;
  while (reader.next(trace)) {
    sorter.add(view_of(reader, trace));
    if (progress && reader.size())
      progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
  }
}

void run(const Settings& settings, const cli::Context& context) {
  const auto keys = in_place("--key", [&] { return parse_sort_keys(settings.key); });
  if (settings.memory_mib < 1)
    throw Error("--memory: found " + std::to_string(settings.memory_mib) + ", expected at least 1 MiB",
                ErrorKind::usage);
  auto names = settings.inputs;
  if (names.empty()) names.push_back("-");
  if (std::count(names.begin(), names.end(), "-") > 1)
    throw Error("found standard input twice, expected every input once", ErrorKind::usage);
  segy::Reader reader(names.front(), settings.input_options.to_damage());
  OutputFile out(settings.output, OutputFile::Content::binary);
  const std::string directory = temporary_directory();
  std::string damage;  // of the inputs but the first
  TraceSorter sorter(keys, static_cast<std::uint64_t>(settings.memory_mib) << 20, directory);
  add_all(reader, sorter, context.progress("reading"));
  for (std::size_t n = 1; n < names.size(); ++n) {
    segy::Reader next(names[n], settings.input_options.to_damage());
    const std::string differs = segy::record_difference(next, reader);
    if (!differs.empty()) throw Error(next.name() + ": " + differs + " as in " + reader.name());
    add_all(next, sorter, context.progress("reading " + names[n]));
    if (damage.empty()) damage = next.damage().value_or("");
  }
  note_needs(sorter.records(), directory, context);
  const segy::FileInfo info = info_of(
      reader, context, segy::format_named_by(settings.output, segy::format_of(reader)), keys.front(), sorter);
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  sorter.deliver([&](const segy::RawTrace& sorted) { writer.write(sorted, reader.header().su); });
  for (const std::string& sentence : writer.finish()) context.warn(sentence);
  out.commit();
  for (const auto& sentence : reader.doubts()) context.warn(sentence);
  reader.expect_whole();
  if (!damage.empty()) throw Error(damage + "; its whole traces were used");
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-sort", "Sorts the traces of one or several files.",
                           "[options] [A...] [-o OUTPUT]", "sw-sort line.sgy --key cdp,offset -o sorted.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
