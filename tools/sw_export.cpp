// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/history.hpp"
#include "cli/tool.hpp"
#include "grid/true_depth.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "output/snapshot_reader.hpp"
#include "rock/attenuation.hpp"
#include "trace_output.hpp"
#include "traces/section.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string property;
  std::optional<double> time_s;
  TraceOutput output_options;
};

/// "vp, vs, rho or fracture"
std::string names_of_model() {
  std::string names;
  for (const auto& name : property_names()) names += (names.empty() ? "" : ", ") + name;
  return names + " or fracture";
}

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "M");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("property", settings.property, "NAME",
              "model: " + names_of_model() + "; snapshots: vx, vz, p, ...");
  options.require("property");
  options.add("time", settings.time_s, "T", "snapshots: the one nearest to T s [the last]");
  settings.output_options.declare(options);
}

template <int D>
struct Exported {
  Field<D> values;
  SectionFacts facts;
  DepthTake take = DepthTake::nearest;  // where rows follow horizons
};

template <int D>
Exported<D> of_model(const NetcdfFile& file, const Settings& settings) {
  if (settings.time_s)
    throw Error("--time: " + file.shown_name() + " is a model, expected snapshots", ErrorKind::usage);
  const auto model = read_model<D>(file);
  const auto& name = settings.property;
  if (const auto property = find_property(name)) {
    if (!model.medium.has(*property))
      throw Error(file.shown_name() + ": found no variable '" + name + "', expected a model with it",
                  ErrorKind::usage);
    auto values = model.medium[*property];
    // Formats of samples know no infinity.
    std::replace(values.begin(), values.end(), std::numeric_limits<float>::infinity(), elastic_quality);
    return {std::move(values), {name, row_of(*property).shown_unit, {}}};
  }
  if (name != "fracture")
    throw Error("--property: " + file.shown_name() + " is a model: found '" + name + "', expected " +
                    names_of_model(),
                ErrorKind::usage);
  Field<D> codes(model.grid());
  for (std::size_t n = 0; n < model.fracture.size(); ++n) codes[n] = static_cast<float>(model.fracture[n]);
  return {std::move(codes), {name, "", {}}};
}

template <int D>
Exported<D> of_snapshots(NetcdfFile file, const Settings& settings) {
  const SnapshotReader<D> reader(std::move(file));
  const auto time = settings.time_s ? reader.nearest(*settings.time_s) : reader.times_s().size() - 1;
  auto values = reader.read(settings.property, time);
  auto unit = reader.unit(settings.property);
  if (unit == "m s-1") unit = "m/s";
  return {std::move(values),
          {settings.property + " at " + shown(reader.times_s()[time], 9) + " s", unit, {}},
          DepthTake::linear};
}

template <int D>
void write_exported(NetcdfFile file, OutputFile& out, const Settings& settings, const cli::Context& context) {
  std::string history = file.text_attribute("", "history").value_or("");
  append_history(history, context.command_line);
  const bool is_model = kind_of(file) == "model";
  auto exported = is_model ? of_model<D>(file, settings) : of_snapshots<D>(std::move(file), settings);
  const bool fitted = exported.values.grid().rows != nullptr;
  exported.values = in_regular_depth(exported.values, exported.take);
  exported.facts.entries.push_back(context.version);
  exported.facts.history = history;
  in_place(shown_input(settings.input), [&] {
    const auto format = settings.output_options.file_format(settings.output);
    for (const auto& sentence : write_section(out, exported.values, exported.facts, format))
      context.warn(sentence);
  });
  out.commit();
  if (!fitted) return;
  const bool linear = exported.take == DepthTake::linear;
  context.say(shown_input(settings.input) + ": rows follow horizons; resampled to " +
              shown(exported.values.grid()) + " in regular depth, " +
              (linear ? "linearly between cells" : "each takes the cell its centre lies in") +
              "; 0 above the surface");
}

void run(const Settings& settings, const cli::Context& context) {
  settings.output_options.file_format(settings.output);  // refused before anything is read
  expect_other_files(settings.output, {settings.input});
  auto file = NetcdfFile::open(settings.input);
  OutputFile out(settings.output, OutputFile::Content::binary);
  if (dimension_of(file) == 3)
    write_exported<3>(std::move(file), out, settings, context);
  else
    write_exported<2>(std::move(file), out, settings, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-export", "Writes a model property or a snapshot as traces, one per column.",
                           "[options] --property NAME [M] [-o OUTPUT]",
                           "sw-export model.nc --property vp -o vp.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
