// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "io/input_bytes.hpp"
#include "io/output_file.hpp"
#include "segy/conversion.hpp"
#include "trace_input.hpp"
#include "traces/expression.hpp"
#include "traces/selection.hpp"
#include "traces/time_window.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string where, time;
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "A");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("where", settings.where, "CONDITION",
              "traces to keep: component=vz and 100<=offset<500, shot=1:9:2 or not cdp>40, ...");
  options.add("time", settings.time, "T0:T1", "keep only the samples from T0 to T1, s");
  settings.input_options.declare(options);
}

std::optional<Expression> condition_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return in_place("--where", [&] {
    Expression condition(text);
    if (condition.kind() != Expression::Kind::truth)
      throw Error("'" + text + "' is not a condition; use one like offset>=100", ErrorKind::usage);
    return condition;
  });
}

/// The file header says how many traces follow. Files are read for it beforehand, pipes cannot be: 0.
SelectionCounts counts_of(const Settings& settings, const Expression& condition) {
  if (!is_regular_input(settings.input)) return {};
  segy::Reader reader(settings.input, settings.input_options.to_damage());
  return count_selected(reader, condition);
}

segy::FileInfo info_of(const segy::Reader& reader, const cli::Context& context,
                       const segy::FileFormat& format, const std::optional<SelectionCounts>& counts,
                       const std::optional<TimeWindow>& window) {
  segy::FileInfo info = segy::info_as(reader, context.command_line, format);
  if (window && reader.axis_with_interval().count > 0) info.axis = window->cut(info.axis);
  info.axis.count =
      std::max<std::int64_t>(info.axis.count, 1);  // none: the first trace will be refused by name
  if (!counts) return info;
  info.layout.traces = counts->traces;
  info.layout.traces_per_shot = counts->per_shot;
  if (info.carried) info.carried->set("ntrpr", 0);  // the layout's
  return info;
}

void run(const Settings& settings, const cli::Context& context) {
  const auto condition = condition_of(settings.where);
  std::optional<TimeWindow> window;
  if (!settings.time.empty()) window = in_place("--time", [&] { return parse_time_window(settings.time); });
  if (!condition && !window) throw Error("nothing to select: give --where or --time", ErrorKind::usage);
  std::optional<SelectionCounts> counts;
  if (condition) counts = counts_of(settings, *condition);
  segy::Reader reader(settings.input, settings.input_options.to_damage());
  if (window && reader.axis_with_interval().count > 0)
    in_place("--time", [&] { window->check_reach(reader.axis(), reader.name()); });
  OutputFile out(settings.output, OutputFile::Content::binary);
  const segy::FileInfo info = info_of(
      reader, context, segy::format_named_by(settings.output, segy::format_of(reader)), counts, window);
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  const Progress progress = context.progress("selecting");
  segy::RawTrace trace;
  while (reader.next(trace)) {
    const bool taken = in_place(reader.name() + ": trace " + std::to_string(reader.delivered()), [&] {
      if (condition && condition->value(view_of(reader, trace)) == 0) return false;
      if (window) window->cut(trace, reader);
      return true;
    });
    if (taken) writer.write(trace, reader.header().su);
    if (progress && reader.size())
      progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
  }
  if (condition && writer.written() == 0)
    throw Error(reader.name() + ": none of " + std::to_string(reader.delivered()) + " traces meets '" +
                settings.where + "', expected at least one");
  for (const std::string& sentence : writer.finish()) context.warn(sentence);
  context.note(std::to_string(writer.written()) + " of " + std::to_string(reader.delivered()) + " traces");
  out.commit();
  for (const auto& sentence : reader.doubts()) context.warn(sentence);
  reader.expect_whole();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-select", "Selects traces by a condition, and samples between two times.",
                           "[options] [A] [-o OUTPUT]",
                           "sw-select gather.sgy --where 'component=vz and offset>=100' -o vz.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
