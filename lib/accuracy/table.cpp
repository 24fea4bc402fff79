// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/table.hpp"

#include <cmath>
#include <cstdio>

namespace slipwave {
namespace {

std::string figure(double value) {
  if (std::isnan(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string percent(double share) { return figure(100 * share); }

/// Percent of a relative error; a reference has none.
void report_error(Report& report, const std::string& name, double error) {
  if (!std::isnan(error)) report.number(name, 100 * error, "%");
}

Report report_of(const AccuracyRow& row) {
  Report report;
  report.count("order", row.order);
  report.count("time order", row.time_order);
  if (row.monotone) report.count("monotone", row.monotone);
  report.number("courant", row.courant, "");
  report.number("step", row.spacing_m, "m");
  if (row.slip_order > 0) report.count("slip order", row.slip_order);
  report.count("cells", row.cells);
  report.count("steps", row.steps);
  report_error(report, "error", row.error);
  report_error(report, "late error", row.late_error);
  report.number("time", row.seconds, "s");
  report.number("memory", row.memory_bytes / (1 << 20), "MiB");
  return report;
}

}  // namespace

Report report_of(const AccuracyTable& table) {
  Report report;
  report.text("title", table.title);
  report.text("reference", table.reference);
  if (table.reference_error) report_error(report, "error of the reference", *table.reference_error);
  std::vector<Report> settings;
  for (const auto& row : table.rows) settings.push_back(report_of(row));
  report.list("setting", settings);
  if (table.wanted_error) report_error(report, "wanted error", *table.wanted_error);
  if (table.chosen) report.list("chosen", {settings[*table.chosen]});
  return report;
}

std::optional<std::size_t> cheapest(const std::vector<AccuracyRow>& rows, double wanted) {
  std::optional<std::size_t> best;
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (rows[n].error <= wanted && (!best || rows[n].seconds < rows[*best].seconds)) best = n;
  return best;
}

std::string text_of(const AccuracyTable& table) {
  std::string text =
      "# " + table.title + "\n# errors: relative L2 in percent against " + table.reference +
      (table.reference_error ? ", whose own error is measured as " + percent(*table.reference_error) : "") +
      "; late: in the last quarter of the traces\n";
  text += "# order time courant   step_m slip      cells  steps    error     late    cpu_s      MiB\n";
  for (std::size_t n = 0; n < table.rows.size(); ++n) {
    const auto& row = table.rows[n];
    char line[240];
    std::snprintf(line, sizeof line, "%7d %4d %7.3g %8.4g %4d %10lld %6lld %8s %8s %8s %8s%s%s\n", row.order,
                  row.time_order, row.courant, row.spacing_m, row.slip_order,
                  static_cast<long long>(row.cells), static_cast<long long>(row.steps),
                  percent(row.error).c_str(), percent(row.late_error).c_str(), figure(row.seconds).c_str(),
                  figure(row.memory_bytes / (1 << 20)).c_str(), row.monotone ? "  monotone" : "",
                  table.chosen == n ? "  <" : "");
    text += line;
  }
  if (table.wanted_error)
    text += table.chosen
                ? "# < the cheapest with an error of at most " + percent(*table.wanted_error) + " %\n"
                : "# none has an error of at most " + percent(*table.wanted_error) + " %\n";
  return text;
}

}  // namespace slipwave
