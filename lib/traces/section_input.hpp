// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "grid/imported_field.hpp"
#include "segy/reader.hpp"

namespace slipwave {

/// Reads a property of a model in depth, a column a trace from the top down: traces along a line are a
/// section, those of several in-lines a volume. In-lines and cross-lines are told by their numbers (bytes 189
/// and 193, or 9 and 21) or by the places of the traces (bytes 181, 73 and 81), in any order of the traces; x
/// runs along the map's x where a line does, else along the cross-lines, y a quarter turn counter-clockwise
/// of it. A delay (byte 109) is the depth of the first sample, 1 ms standing for 1 m.
///
/// Throws Error naming file and bytes where headers contradict a regular grid of cells of `step_m`: lines of
/// unequal length, other or uneven distances, gathers with offsets, columns that begin at different depths.
/// `trusted` false: headers are not looked at, traces are the columns of a section. `said` holds what was
/// taken for what: where the model lies on the map, a sample interval that fits no depth.
ImportedField read_section(segy::Reader& reader, double step_m, bool trusted = true);

}  // namespace slipwave
