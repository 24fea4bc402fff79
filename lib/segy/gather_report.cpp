// SPDX-License-Identifier: BSD-3-Clause
#include "segy/gather_report.hpp"

#include <algorithm>

namespace slipwave::segy {
namespace {

void report_range(Report& report, const std::string& name, const Range& range, const std::string& unit) {
  if (!range.empty()) report.range(name, range.lowest, range.highest, unit);
}

void report_file(Report& report, const FileHeader& header) {
  report.text("format", header.su ? std::string("Seismic Unix")
                                  : "SEG-Y revision " + std::to_string(header.major) + "." +
                                        std::to_string(header.minor));
  report.text("byte order", name_of(header.endian));
  report.text("samples", header.format->name);
  if (header.su) return;
  report.count("format code", header.format->code);
  report.text("text code", name_of(header.encoding));
  if (!header.extended.empty())
    report.count("extended texts", static_cast<std::int64_t>(header.extended.size()));
  if (header.extra_headers != 0) report.count("extra headers", header.extra_headers);
  if (header.feet) report.text("lengths", "in feet, shown in metres");
}

void report_sampling(Report& report, const Description& facts) {
  const SampleAxis& axis = facts.axis;
  const auto last = static_cast<double>(std::max<std::int64_t>(axis.count - 1, 0));
  report.count("traces", facts.traces);
  report.count("shots", facts.shots);
  report.count("samples a trace", axis.count);
  report.number("interval", axis.interval_s, "s");
  report.range("time", axis.start_s, axis.start_s + last * axis.interval_s, "s");
  if (facts.lengths_vary) report.text("times", "vary from trace to trace");
}

/// Coordinates of a file that has no lengths for them, or none that can be read.
std::string unit_of_coordinates(const Description& facts) {
  if (!facts.coordinate_fault.empty()) return "unscaled";
  return facts.arc.empty() ? "m" : facts.arc;
}

void report_positions(Report& report, const Description& facts) {
  const auto unit = unit_of_coordinates(facts);
  const auto report_end = [&](const std::string& end, const Range& range, std::size_t axis, bool given) {
    if (axis == 2)
      report_range(report, end + " z", range, facts.height_fault.empty() ? "m" : "unscaled");
    else if (given)
      report_range(report, end + " " + "xyz"[axis], range, unit);
    else if (axis == 0)
      report.text(end, "no coordinates in the file; placed by its offsets and midpoints");
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    report_end("source", facts.source_m[axis], axis, facts.positions.source);
    report_end("receiver", facts.receiver_m[axis], axis, facts.positions.receiver);
  }
  const std::string remedy = "; sw-shoot --geometry refuses it";
  if (!facts.coordinate_fault.empty()) report.text("coordinates", facts.coordinate_fault + remedy);
  if (!facts.height_fault.empty()) report.text("depths", facts.height_fault + remedy);
  if (!facts.arc.empty()) report.text("coordinates", "in " + facts.arc + " (byte 89)" + remedy);
  if (unit == "m") report_range(report, "offset", facts.offset_m, "m");
  if (unit != "m" || facts.offsets_differ) report_range(report, "offset word (37)", facts.offset_word_m, "m");
  if (unit == "m" && facts.offsets_differ)
    report.text("offsets", "the words (byte 37) are not the distances of the coordinates");
}

}  // namespace

Report report_of(const Description& facts) {
  Report report;
  report_file(report, facts.header);
  report_sampling(report, facts);
  std::vector<Report> components;
  for (const auto& [component, found] : facts.components) {
    auto& said = components.emplace_back();
    said.text("name", name_of(component));
    said.count("traces", found.traces);
    report_range(said, "amplitude", found.sample, unit_of(component));
    said.number("rms", found.rms, unit_of(component));
  }
  report.list("component", components);
  report_positions(report, facts);
  if (!facts.doubts.empty()) report.texts("doubt", facts.doubts);
  if (facts.not_finite != 0) report.count("samples not finite", facts.not_finite);
  if (!facts.header.su) report.texts("text", shown_lines(facts.header.text));
  return report;
}

}  // namespace slipwave::segy
