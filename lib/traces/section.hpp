// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grid/field.hpp"
#include "io/output_file.hpp"
#include "segy/writer.hpp"

namespace slipwave {

/// Depth in traces: what software takes for 1 ms is 1 m.
inline constexpr double seconds_a_metre = 1e-3;

/// What a section in depth shows.
struct SectionFacts {
  std::string quantity;              // "vp", "vz at 0.4 s"
  std::string unit;                  // "m/s", "Pa", ...
  std::vector<std::string> entries;  // of the textual header: where it comes from
  std::string history = {};          // commands that made it, one a line
};

/// Writes a section or a volume as traces, a column each, from the top down: sample n lies at depth (n - 1/2)
/// h for n = 1, 2, ..., with h the step of the grid and h/1 m the sample interval in ms. Traces and midpoints
/// (cdp) count from 1, x fastest; cross-lines and shot points count along x, in-lines along y; source,
/// receiver and midpoint lie at the x and y of the column. Throws Error when the format cannot hold the step
/// or a value; returns sentences about what it holds less exactly. Committing `out` is the caller's business.
template <int D>
std::vector<std::string> write_section(OutputFile& out, const Field<D>& section, const SectionFacts& facts,
                                       const segy::FileFormat& format);

}  // namespace slipwave
