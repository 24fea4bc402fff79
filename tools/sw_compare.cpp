#include <cstdio>
#include <optional>
#include <string>

#include "base/error.hpp"
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
  bool summary = false;
};

void declare(cli::Options& options, Settings& settings) {
  settings.inputs.declare(options);
  options.add("output,o", settings.output, "FILE", "output file of the table; - is standard output");
  options.add("tolerance", settings.tolerance, "L2",
              "exit with status 1 if |A - B|/|B| of all traces exceeds this");
  options.add("summary", settings.summary, "print only the totals of each component and of all traces");
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

void run(const Settings& settings, const cli::Context& context) {
  if (settings.tolerance && !(*settings.tolerance >= 0))
    throw Error("--tolerance: found " + shown(*settings.tolerance) + ", expected it not below 0",
                ErrorKind::usage);
  OpenPair pair(settings.inputs);
  const segy::Reader& a = pair.a;
  std::vector<std::pair<Component, Comparison>> components;  // in the order in which they come
  const auto comparison_of = [&](Component component) -> Comparison& {
    for (auto& [known, comparison] : components)
      if (known == component) return comparison;
    return components.emplace_back(component, Comparison(a.axis_with_interval())).second;
  };
  OutputFile out(settings.output, OutputFile::Content::text);
  const auto print = [&](const std::string& line) {
    if (!context.quiet) out.write(line.data(), line.size());
  };
  print("#  trace comp    shot  chan       NRMS_%    relative_L2   peak_ratio          lag_s\n");
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
    const Misfit misfit = comparison_of(header.component).add(trace_a.samples, trace_b.samples);
    if (!settings.summary) print(row(place_of(a.delivered(), header), misfit));
  }
  // Together they mix units: whichever component has the largest numbers decides.
  Comparison together(a.axis_with_interval());
  for (auto& [component, comparison] : components) {
    together.include(comparison);
    if (components.size() > 1)
      print(row("     all " + std::string(name_of(component)), comparison.overall()));
  }
  const Misfit all = together.overall();
  print(row("     all", all));
  out.commit();
  if (settings.tolerance && !(all.relative_l2 <= *settings.tolerance))
    throw Error(a.name() + ": relative L2 difference to " + pair.b.name() + " is " + shown(all.relative_l2) +
                ", expected at most " + shown(*settings.tolerance));
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
