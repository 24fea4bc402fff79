// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/report.hpp"
#include "io/output_file.hpp"

namespace slipwave {

class NetcdfFile;

/// One way of computing a scene and what it gave. NaN: not known.
struct AccuracyRow {
  int order = 5;           // of the reconstruction in space
  int time_order = 2;      // of the splitting
  int monotone = 0;        // 1: sweeps keep to the criterion of monotonicity
  double courant = 0;      // vp_max dt/h
  double spacing_m = 0;    // cell size
  int slip_order = 0;      // of the slip correction, 3: exponential; 0: nothing slips
  std::int64_t cells = 0;  // computed ones, zones included
  std::int64_t steps = 0;
  double error = 0;       // relative L2 over all traces against the reference
  double late_error = 0;  // the same for the last quarter of the traces: what has travelled longest
  double seconds = 0;     // of the processor, all threads together
  double memory_bytes = 0;
};

/// What accuracy costs: the result of sw-accuracy.
struct AccuracyTable {
  std::string title;
  std::string history;                    // command lines
  std::string reference;                  // what errors are measured against: "order 7, 1.25 m"
  std::optional<double> reference_error;  // of that, as it was measured
  std::optional<double> wanted_error;     // relative, where the user said how much is allowed
  std::optional<std::size_t> chosen;      // the cheapest row below wanted_error
  std::vector<AccuracyRow> rows;
};

/// The row of least seconds whose error is at most `wanted`, if there is one.
std::optional<std::size_t> cheapest(const std::vector<AccuracyRow>& rows, double wanted);

/// Columns for people, a line a row; lines that begin with # say what they are.
std::string text_of(const AccuracyTable& table);

/// What --json and sw-info say of it, but for its history.
Report report_of(const AccuracyTable& table);

/// netCDF: one variable along the dimension `setting` for each column, docs/formats.md. `version` is that of
/// the tool that writes.
void write_accuracy_table(OutputFile& out, const AccuracyTable& table, const std::string& version);
/// Reads what write_accuracy_table wrote; "-" is standard input. Throws an Error naming what is missing.
AccuracyTable read_accuracy_table(const std::string& path);
AccuracyTable read_accuracy_table(const NetcdfFile& file);

}  // namespace slipwave
