// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/report.hpp"
#include "cli/tool.hpp"
#include "gather/comparison.hpp"
#include "gather/nrms.hpp"
#include "io/output_file.hpp"
#include "segy/writer.hpp"
#include "trace_pair.hpp"
#include "traces/time_window.hpp"

using namespace slipwave;

namespace {

struct Settings {
  TracePair inputs;
  std::string output = "-";
  std::optional<double> tolerance;
  bool summary = false, json = false;
  std::vector<std::string> times;
  std::optional<double> nrms_s;
};

/// What is compared: all of the traces, or the samples of a window.
struct Part {
  std::optional<TimeWindow> window;
  std::string name;  // "0.1:0.5"; empty: all
};

void declare(cli::Options& options, Settings& settings) {
  settings.inputs.declare(options);
  options.add("output,o", settings.output, "FILE", "output file of the table; - is standard output");
  options.add("time", settings.times, "T1:T2",
              "compare only samples from T1 to T2, s; repeat for several windows");
  options.add(
      "nrms", settings.nrms_s, "LENGTH",
      "write traces instead of the table: NRMS in % over windows of this length, s, about each sample");
  options.add("tolerance", settings.tolerance, "L2",
              "exit with status 1 if |A - B|/|B| of a component exceeds this");
  options.add("summary", settings.summary, "print only the total of each component");
  options.add("json", settings.json,
              "print the totals as one JSON object, without --summary also each trace");
  settings.inputs.input_options.declare(options);
}

std::string row(const std::string& place, const Part& part, const Misfit& misfit) {
  char line[200];
  std::snprintf(line, sizeof line, "%-28s %12.6g %14.6g %12.6g %14.6g", place.c_str(), misfit.nrms_percent,
                misfit.relative_l2, misfit.peak_ratio, misfit.lag_s);
  return line + (part.window ? "  " + part.name : "") + "\n";
}

/// "3 vz 1 17": number, component, shot, channel.
std::string place_of(std::int64_t trace, const TraceHeader& header) {
  char place[80];
  std::snprintf(place, sizeof place, "%8lld %-5s %6lld %6lld", static_cast<long long>(trace),
                name_of(header.component), static_cast<long long>(header.shot),
                static_cast<long long>(header.channel));
  return place;
}

void add(Report& report, const Part& part, const Misfit& misfit) {
  if (part.window) report.range("time", part.window->from_s, part.window->to_s, "s");
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
      print("#  trace comp    shot  chan       NRMS_%    relative_L2   peak_ratio          lag_s" +
            std::string(settings_.times.empty() ? "\n" : "  time_s\n"));
  }
  void add_trace(std::int64_t number, const TraceHeader& header, const Part& part, const Misfit& misfit) {
    if (settings_.summary) return;
    if (!settings_.json) return print(row(place_of(number, header), part, misfit));
    auto& trace = traces_.emplace_back();
    trace.count("trace", number);
    trace.text("component", name_of(header.component));
    trace.count("shot", header.shot);
    trace.count("channel", header.channel);
    add(trace, part, misfit);
  }
  void add_total(Component component, const Part& part, const Misfit& misfit) {
    if (!settings_.json) return print(row("     all " + std::string(name_of(component)), part, misfit));
    auto& total = totals_.emplace_back();
    total.text("component", name_of(component));
    add(total, part, misfit);
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
void check_tolerance(const Settings& settings, const OpenPair& pair, Component component, const Part& part,
                     const Misfit& misfit) {
  if (!settings.tolerance || misfit.relative_l2 <= *settings.tolerance) return;
  throw Error(
      pair.a.name() + ": relative L2 difference to " + pair.b.name() + " is " + shown(misfit.relative_l2) +
      " in " + name_of(component) +
      (part.window ? " from " + shown(part.window->from_s) + " to " + shown(part.window->to_s) + " s" : "") +
      ", expected at most " + shown(*settings.tolerance));
}

/// By component and window, in the order in which they come.
struct Compared {
  Component component;
  std::size_t part;
  Comparison comparison;
};
using Comparisons = std::vector<Compared>;

Comparison& comparison_of(Comparisons& all, Component component, std::size_t part, const SampleAxis& axis) {
  for (auto& known : all)
    if (known.component == component && known.part == part) return known.comparison;
  return all.emplace_back(Compared{component, part, Comparison(axis)}).comparison;
}

std::vector<Part> parts_of(const Settings& settings, const segy::Reader& reader) {
  if (settings.times.empty()) return {Part{}};
  std::vector<Part> parts;
  for (const auto& text : settings.times)
    in_place("--time", [&] {
      parts.push_back({parse_time_window(text), text});
      parts.back().window->check_reach(reader.axis_with_interval(), reader.name());
    });
  return parts;
}

void check_samples(const segy::Reader& reader, const segy::Trace& trace) {
  in_place(reader.name() + ": trace " + std::to_string(reader.delivered()),
           [&] { check_finite(trace.samples); });
}

void compare(const Settings& settings, OpenPair& pair, const cli::Context& context) {
  const segy::Reader& a = pair.a;
  const auto parts = parts_of(settings, a);
  Comparisons all;
  Table table(settings, context.quiet);
  segy::Trace trace_a, trace_b;
  while (pair.both.next(trace_a, trace_b)) {
    check_samples(a, trace_a);
    check_samples(pair.b, trace_b);
    const TraceHeader header = a.si_header(trace_a);
    a.axis_with_interval();
    for (std::size_t n = 0; n < parts.size(); ++n) {
      std::span<const double> of_a = trace_a.samples, of_b = trace_b.samples;
      SampleAxis axis = a.axis_of(trace_a);
      if (parts[n].window) {
        const auto first = parts[n].window->first_of(axis);
        axis = parts[n].window->cut(axis);
        if (axis.count < 1)
          throw Error(a.name() + ": trace " + std::to_string(a.delivered()) + ": has no samples in --time " +
                      parts[n].name);
        of_a = of_a.subspan(first, std::size_t(axis.count));
        of_b = of_b.subspan(first, std::size_t(axis.count));
      }
      auto& comparison = comparison_of(all, header.component, n, axis);
      table.add_trace(a.delivered(), header, parts[n], comparison.add(of_a, of_b));
    }
  }
  for (auto& [component, part, comparison] : all)
    table.add_total(component, parts[part], comparison.overall());
  table.commit();
  for (auto& [component, part, comparison] : all)
    check_tolerance(settings, pair, component, parts[part], comparison.overall());
  pair.warn_of_doubts(context);
  pair.expect_whole();
}

/// A gather of percentages with the places and times of A.
void write_nrms(const Settings& settings, OpenPair& pair, const cli::Context& context) {
  const SampleAxis& axis = pair.a.axis_with_interval();
  if (!(*settings.nrms_s > 0))
    throw Error("--nrms: found " + shown(*settings.nrms_s) + " s, expected it above 0", ErrorKind::usage);
  if (!settings.times.empty() || settings.tolerance || settings.summary || settings.json)
    throw Error("--nrms writes traces, expected none of --time, --tolerance, --summary and --json with it",
                ErrorKind::usage);
  const auto half = std::size_t(std::min(*settings.nrms_s / 2 / axis.interval_s, 1e9));
  OutputFile out(settings.output, OutputFile::Content::binary);
  segy::FileInfo info = segy::info_like(pair.a, context.command_line, settings.output);
  segy::Writer writer(out, info);
  segy::Trace trace_a, trace_b;
  while (pair.both.next(trace_a, trace_b)) {
    check_samples(pair.a, trace_a);
    check_samples(pair.b, trace_b);
    trace_a.samples = nrms_over_time(trace_a.samples, trace_b.samples, half);
    trace_a.words.set("trid", segy::code_of(Component::other));
    writer.write(trace_a, pair.a.header().su);
  }
  for (const auto& sentence : writer.finish()) context.warn(sentence);
  out.commit();
  pair.warn_of_doubts(context);
  pair.expect_whole();
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.tolerance && !(*settings.tolerance >= 0))
    throw Error("--tolerance: found " + shown(*settings.tolerance) + ", expected it not below 0",
                ErrorKind::usage);
  OpenPair pair(settings.inputs);
  if (settings.nrms_s)
    write_nrms(settings, pair, context);
  else
    compare(settings, pair, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{
      "sw-compare",
      "Compares two gathers: NRMS, relative L2, peak ratio and lag of each trace, or NRMS over time.",
      "[options] A B [-o OUTPUT]", "sw-compare new.sgy old.sgy --tolerance 1e-3"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
