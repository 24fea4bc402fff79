// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/report.hpp"
#include "cli/tool.hpp"
#include "gather/comparison.hpp"
#include "io/output_file.hpp"
#include "trace_pair.hpp"

using namespace slipwave;

namespace {

struct Settings {
  TracePair inputs;
  std::string output = "-";
  std::optional<double> tolerance;
  bool summary = false, json = false;
};

void declare(cli::Options& options, Settings& settings) {
  settings.inputs.declare(options);
  options.add("output,o", settings.output, "FILE", "output file of the table; - is standard output");
  options.add("tolerance", settings.tolerance, "L2",
              "exit with status 1 if |A - B|/|B| of a component exceeds this");
  options.add("summary", settings.summary, "print only the total of each component");
  options.add("json", settings.json,
              "print the totals as one JSON object, without --summary also each trace");
  settings.inputs.input_options.declare(options);
}

std::string row(const std::string& place, const Misfit& misfit) {
  char line[200];
  std::snprintf(line, sizeof line, "%-28s %12.6g %14.6g %12.6g %14.6g\n", place.c_str(), misfit.nrms_percent,
                misfit.relative_l2, misfit.peak_ratio, misfit.lag_s);
  return line;
}

/// "3 vz 1 17": number, component, shot, channel.
std::string place_of(std::int64_t trace, const TraceHeader& header) {
  char place[80];
  std::snprintf(place, sizeof place, "%8lld %-5s %6lld %6lld", static_cast<long long>(trace),
                name_of(header.component), static_cast<long long>(header.shot),
                static_cast<long long>(header.channel));
  return place;
}

void add(Report& report, const Misfit& misfit) {
  report.number("nrms", misfit.nrms_percent, "%");
  report.number("relative l2", misfit.relative_l2, "");
  report.number("peak ratio", misfit.peak_ratio, "");
  report.number("lag", misfit.lag_s, "s");
}

/// What is printed, as lines or as JSON.
class Table {
 public:
  Table(const Settings& settings, bool quiet)
      : settings_(settings), quiet_(quiet), out_(settings.output, OutputFile::Content::text) {
    if (!settings_.json)
      print("#  trace comp    shot  chan       NRMS_%    relative_L2   peak_ratio          lag_s\n");
  }
  void add_trace(std::int64_t number, const TraceHeader& header, const Misfit& misfit) {
    if (settings_.summary) return;
    if (!settings_.json) return print(row(place_of(number, header), misfit));
    auto& trace = traces_.emplace_back();
    trace.count("trace", number);
    trace.text("component", name_of(header.component));
    trace.count("shot", header.shot);
    trace.count("channel", header.channel);
    add(trace, misfit);
  }
  void add_total(Component component, const Misfit& misfit) {
    if (!settings_.json) return print(row("     all " + std::string(name_of(component)), misfit));
    auto& total = totals_.emplace_back();
    total.text("component", name_of(component));
    add(total, misfit);
  }
  void commit() {
    if (settings_.json) {
      Report whole;
      whole.text("a", settings_.inputs.a);
      whole.text("b", settings_.inputs.b);
      whole.list("components", totals_);
      if (!settings_.summary) whole.list("traces", traces_);
      print(whole.json() + "\n");
    }
    out_.commit();
  }

 private:
  void print(const std::string& line) {
    if (!quiet_) out_.write(line.data(), line.size());
  }

  const Settings& settings_;
  bool quiet_;
  OutputFile out_;
  std::vector<Report> totals_, traces_;
};

/// Components have units of their own: each is judged alone.
void check_tolerance(const Settings& settings, const OpenPair& pair, Component component,
                     const Misfit& misfit) {
  if (!settings.tolerance || misfit.relative_l2 <= *settings.tolerance) return;
  throw Error(pair.a.name() + ": relative L2 difference to " + pair.b.name() + " is " +
              shown(misfit.relative_l2) + " in " + name_of(component) + ", expected at most " +
              shown(*settings.tolerance));
}

/// By component, in the order in which they come.
using Comparisons = std::vector<std::pair<Component, Comparison>>;

Comparison& comparison_of(Comparisons& all, Component component, const SampleAxis& axis) {
  for (auto& [known, comparison] : all)
    if (known == component) return comparison;
  return all.emplace_back(component, Comparison(axis)).second;
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.tolerance && !(*settings.tolerance >= 0))
    throw Error("--tolerance: found " + shown(*settings.tolerance) + ", expected it not below 0",
                ErrorKind::usage);
  OpenPair pair(settings.inputs);
  const segy::Reader& a = pair.a;
  Comparisons components;
  Table table(settings, context.quiet);
  segy::Trace trace_a;
  segy::Trace trace_b;
  while (pair.both.next(trace_a, trace_b)) {
    const auto check = [&](const segy::Reader& reader, const segy::Trace& trace) {
      in_place(reader.name() + ": trace " + std::to_string(reader.delivered()),
               [&] { check_finite(trace.samples); });
    };
    check(a, trace_a);
    check(pair.b, trace_b);
    const TraceHeader header = a.si_header(trace_a);
    auto& comparison = comparison_of(components, header.component, a.axis_with_interval());
    table.add_trace(a.delivered(), header, comparison.add(trace_a.samples, trace_b.samples));
  }
  for (auto& [component, comparison] : components) table.add_total(component, comparison.overall());
  table.commit();
  for (auto& [component, comparison] : components)
    check_tolerance(settings, pair, component, comparison.overall());
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-compare",
                           "Compares two gathers: NRMS, relative L2, peak ratio and lag of each trace.",
                           "[options] A B [-o OUTPUT]", "sw-compare new.sgy old.sgy --tolerance 1e-3"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
