#include <cmath>
#include <cstdio>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "base/input_bytes.hpp"
#include "base/netcdf_container.hpp"
#include "base/netcdf_file.hpp"
#include "base/output_file.hpp"
#include "cli/tool.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "segy/describe.hpp"
#include "segy/sniff.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::vector<std::string> files;
  bool json = false;
};

/// What a file is, what is in it, and what is wrong with it (empty: nothing).
struct Finding {
  std::string kind;
  Report report;
  std::string damage;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.files, "FILE");
  options.require("FILE");
  options.add("json", settings.json, "one JSON object a line for each file");
}

void report_range(Report& report, const std::string& name, const segy::Range& range,
                  const std::string& unit) {
  if (!range.empty()) report.range(name, range.lowest, range.highest, unit);
}

Finding look_at_traces(const std::string& path, const std::vector<char>& taken) {
  const auto found = segy::describe(path, {}, {taken.begin(), taken.end()});
  Finding finding{"gather", {}, found.damage.value_or("")};
  Report& report = finding.report;
  const auto& header = found.header;
  report.text("format", header.su ? std::string("Seismic Unix")
                                  : "SEG-Y revision " + std::to_string(header.major) + "." +
                                        std::to_string(header.minor));
  report.text("byte order", header.endian == segy::Endian::big ? "big" : "little");
  if (header.format) report.text("samples", header.format->name);
  report.count("traces", found.traces);
  report.count("shots", found.shots);
  report.count("samples a trace", found.axis.count);
  report.number("interval", found.axis.interval_s, "s");
  report.range(
      "time", found.axis.start_s,
      found.axis.start_s + double(std::max<std::int64_t>(found.axis.count - 1, 0)) * found.axis.interval_s,
      "s");
  if (found.lengths_vary) report.text("lengths", "vary from trace to trace");
  std::vector<Report> components;
  for (const auto& [component, traces] : found.components) {
    components.emplace_back();
    components.back().text("name", name_of(component));
    components.back().count("traces", traces);
  }
  report.list("component", components);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    report_range(report, std::string("source ") + "xyz"[axis], found.source_m[axis], "m");
    report_range(report, std::string("receiver ") + "xyz"[axis], found.receiver_m[axis], "m");
  }
  report_range(report, "offset", found.offset_m, "m");
  report_range(report, "amplitude", found.sample, "");
  report.number("rms", found.rms, "");
  if (found.not_finite) report.count("samples not finite", found.not_finite);
  return finding;
}

bool holds_accuracy(const NetcdfFile& file) {
  return file.has_variable("error") && file.dimension_length("setting");
}

/// Percent of a relative error; a reference has none.
void report_error(Report& report, const std::string& name, double error) {
  if (!std::isnan(error)) report.number(name, 100 * error, "%");
}

Report report_of(const AccuracyRow& row) {
  Report report;
  report.count("order", row.order);
  report.count("time order", row.time_order);
  report.number("courant", row.courant, "");
  report.number("step", row.spacing_m, "m");
  if (row.slip_order > 0) report.count("slip order", row.slip_order);
  report.count("cells", row.cells);
  report.count("steps", row.steps);
  report_error(report, "error", row.error);
  report_error(report, "late error", row.late_error);
  report_error(report, "predicted error", row.predicted_error);
  report.number("time", row.seconds, "s");
  report.number("predicted time", row.predicted_seconds, "s");
  report.number("memory", row.memory_bytes / (1 << 20), "MiB");
  return report;
}

Finding look_at_accuracy(const NetcdfFile& file) {
  const auto table = read_accuracy_table(file);
  Finding finding{"accuracy", {}, ""};
  Report& report = finding.report;
  report.text("title", table.title);
  report.text("reference", table.reference);
  std::vector<Report> settings;
  for (const auto& row : table.rows) settings.push_back(report_of(row));
  report.list("setting", settings);
  if (table.wanted_error) report_error(report, "wanted error", *table.wanted_error);
  if (table.chosen) report.list("chosen", {settings[*table.chosen]});
  if (const auto source = file.text_attribute("", "source")) report.text("source", *source);
  report.text("history", table.history);
  return finding;
}

Finding look_at_netcdf(const NetcdfFile& file) {
  const auto kind = kind_of(file);
  if (kind != "model" && holds_accuracy(file)) return look_at_accuracy(file);
  if (kind != "model") return {kind, report_of(file), ""};
  const auto model = read_model<2>(file);
  Finding finding{kind, report_of(model), ""};
  try {
    check(model, {.allow_auxetic = true});
  } catch (const Error& error) {
    finding.damage = file.shown_name() + ": " + error.what();
  }
  return finding;
}

Finding look_at(const std::string& path) {
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  if (begins_netcdf({first.data(), first.size()})) {
    return look_at_netcdf(start.is_regular()
                              ? NetcdfFile::open(path)
                              : NetcdfFile::open(read_all(path, start.taken()), shown_input(path)));
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (segy::looks_like_segy(bytes)) return look_at_traces(path, start.taken());
  throw Error(shown_input(path) + ": is " +
              (first.empty() ? "empty" : "no netCDF, SEG-Y or Seismic Unix file") +
              ", expected a model, snapshots or a gather");
}

void run(const Settings& settings, const cli::Context&) {
  OutputFile out("-", OutputFile::Content::text);
  const auto print = [&](const std::string& text) { out.write(text.data(), text.size()); };
  std::string damage;
  for (const auto& path : settings.files) {
    Finding finding;
    try {
      finding = look_at(path);
    } catch (const Error&) {
      out.commit();  // what the files before it hold
      throw;
    }
    const auto name = shown_input(path);
    if (settings.json) {
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
      {"sw-info", "Says what is in models, snapshots, gathers and tables of accuracy.", "[options] FILE...",
       "sw-info model.nc gather.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
