#include <cmath>
#include <filesystem>
#include <optional>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "cli/tool.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "segy/describe.hpp"
#include "segy/gather_report.hpp"
#include "segy/sniff.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::vector<std::string> files;
  bool json = false;
  TraceInput traces;
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
  options.add("json", settings.json, "one JSON object per file and line");
  settings.traces.declare(options);
}

Finding look_at_traces(const std::string& path, const segy::ReadOptions& options,
                       const std::vector<char>& taken) {
  const auto found = segy::describe(path, options, {taken.begin(), taken.end()});
  return {"gather", segy::report_of(found), found.damage.value_or("")};
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

template <int D>
Finding look_at_model(const NetcdfFile& file) {
  const auto model = read_model<D>(file);
  Finding finding{"model", report_of(model), ""};
  try {
    check(model, {.allow_auxetic = true, .allow_slow = true});
  } catch (const Error& error) {
    finding.damage = file.shown_name() + ": " + error.what();
  }
  return finding;
}

Finding look_at_netcdf(const NetcdfFile& file) {
  const auto kind = kind_of(file);
  if (kind != "model" && holds_accuracy(file)) return look_at_accuracy(file);
  if (kind != "model") return {kind, report_of(file), ""};
  return dimension_of(file) == 3 ? look_at_model<3>(file) : look_at_model<2>(file);
}

/// Of a gather: where the options say what it is, it need not look like one.
Finding look_at(const std::string& path, const segy::ReadOptions& options) {
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  if (begins_netcdf({first.data(), first.size()})) {
    return look_at_netcdf(start.is_regular()
                              ? NetcdfFile::open(path)
                              : NetcdfFile::open(read_all(path, start.taken()), shown_input(path)));
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
      {"sw-info", "Describes models, snapshots, gathers and tables of accuracy.", "[options] FILE...",
       "sw-info model.nc gather.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
