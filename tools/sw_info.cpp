// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <optional>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "base/history.hpp"
#include "cli/tool.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "planning/plan.hpp"
#include "segy/describe.hpp"
#include "segy/gather_report.hpp"
#include "segy/history.hpp"
#include "segy/sniff.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::vector<std::string> files;
  bool json = false, command = false;
  TraceInput traces;
};

/// What a file is, what is in it, and what is wrong with it (empty: nothing).
struct Finding {
  std::string kind;
  Report report;
  std::string damage;
  std::string history;  // the commands that made it, as far as it says
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.files, "FILE");
  options.require("FILE");
  options.add("json", settings.json, "one JSON object per file and line");
  options.add("command", settings.command,
              "print instead the command that makes each file again, on standard output");
  options.excludes("json", {"command"});
  settings.traces.declare(options);
}

Finding look_at_traces(const std::string& path, const segy::ReadOptions& options,
                       const std::vector<char>& taken) {
  const auto found = segy::describe(path, options, {taken.begin(), taken.end()});
  const auto history = segy::history_of(found.header);
  return {"gather", segy::report_of(found), found.damage.value_or(""),
          history.complete ? history.commands : ""};
}

bool holds_accuracy(const NetcdfFile& file) {
  return file.has_variable("error") && file.dimension_length("setting");
}

Finding look_at_accuracy(const NetcdfFile& file) {
  const auto table = read_accuracy_table(file);
  Finding finding{"accuracy", report_of(table), "", ""};
  Report& report = finding.report;
  if (const auto source = file.text_attribute("", "source")) report.text("source", *source);
  report.text("history", table.history);
  return finding;
}

template <int D>
Finding look_at_model(const NetcdfFile& file) {
  Scene<D> scene;
  scene.model = read_model<D>(file);
  Finding finding{"model", report_of(scene.model), "", ""};
  try {
    check(scene.model, {.allow_auxetic = true, .allow_slow = true});
    scene.survey.sources.push_back({{}, Explosion{}, parse_wavelet("ricker:1")});
    finding.report.text("to shoot", cost_of_a_second(scene));
  } catch (const Error& error) {
    finding.damage = file.shown_name() + ": " + error.what();
  }
  return finding;
}

Finding look_at_netcdf(const NetcdfFile& file) {
  const auto kind = kind_of(file);
  if (kind != "model" && holds_accuracy(file)) return look_at_accuracy(file);
  if (kind != "model") return {kind, report_of(file), "", ""};
  return dimension_of(file) == 3 ? look_at_model<3>(file) : look_at_model<2>(file);
}

/// Of a gather: where the options say what it is, it need not look like one.
Finding look_at(const std::string& path, const segy::ReadOptions& options) {
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  if (begins_netcdf({first.data(), first.size()})) {
    for (const auto& [given, option] :
         {std::pair(options.su, "--su"), std::pair(options.endian.has_value(), "--endian"),
          std::pair(options.format.has_value(), "--format")})
      if (given)
        throw Error(shown_input(path) + ": " + option + " does not apply to this kind of file",
                    ErrorKind::usage);
    const auto file = start.is_regular() ? NetcdfFile::open(path)
                                         : NetcdfFile::open(read_all(path, start.taken()), shown_input(path));
    auto finding = look_at_netcdf(file);
    finding.history = file.text_attribute("", "history").value_or("");
    return finding;
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  std::optional<std::uint64_t> size;
  if (start.is_regular()) size = std::filesystem::file_size(path);
  if (options.su || segy::names_su(path) || options.endian || options.format ||
      segy::looks_like_segy(bytes, size))
    return look_at_traces(path, options, start.taken());
  throw Error(shown_input(path) + ": is " +
              (first.empty() ? "empty" : "not a netCDF, SEG-Y or Seismic Unix file") +
              ", expected a model, snapshots or a gather");
}

void run(const Settings& settings, const cli::Context&) {
  const segy::ReadOptions options = settings.traces.read_options();
  OutputFile out("-", OutputFile::Content::text);
  const auto print = [&](const std::string& text) { out.write(text.data(), text.size()); };
  std::string damage;
  for (const auto& path : settings.files) {
    Finding finding;
    try {
      finding = look_at(path, options);
    } catch (const Error&) {
      out.commit();  // what the files before it hold
      throw;
    }
    const auto name = shown_input(path);
    if (settings.command) {
      const auto command = pipeline_of(finding.history);
      if (!command.starts_with("sw-"))
        throw Error(name + ": does not say by which command of slipwave it was made");
      print(command + "\n");
    } else if (settings.json) {
      Report whole;
      whole.text("file", name);
      whole.text("kind", finding.kind);
      whole.append(finding.report);
      print(whole.json() + "\n");
    } else {
      print(name + ": " + finding.kind + "\n" + finding.report.lines());
    }
    if (damage.empty()) damage = finding.damage;
  }
  out.commit();
  if (!damage.empty()) throw Error(damage);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-info", "Describes models, snapshots, gathers and tables of accuracy.", "[options] FILE...",
       "sw-info model.nc gather.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
