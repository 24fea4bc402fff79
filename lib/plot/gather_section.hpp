// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave::segy {
class Reader;
}

namespace slipwave::plot {

/// What stands along the axis of traces.
enum class TraceAxis { automatic, x, y, midpoint, offset, depth, number };
/// "auto", "x", "y", "midpoint", "offset", "depth", "trace"; throws a usage Error that lists them.
TraceAxis trace_axis_named(const std::string& name);
std::vector<std::string> trace_axis_names();

/// Which traces of a file are drawn.
struct TraceChoice {
  std::optional<Component> component;  // none: that of the first trace
  std::optional<std::int64_t> shot;    // none: all
};

/// Traces of one component and sampling, side by side.
struct GatherSection {
  Component component = Component::other;
  SampleAxis axis;
  std::vector<TraceHeader> headers;
  std::vector<float> samples;   // axis.count of each trace
  bool others_unasked = false;  // the file has other components, and none was chosen
  std::int64_t first_shot = 0, shots = 0;

  std::size_t traces() const { return headers.size(); }
  const float* trace(std::size_t n) const { return samples.data() + n * std::size_t(axis.count); }
};

/// Reads the chosen traces. Throws Error when there are none, naming what the file has instead, or when
/// traces differ in sampling.
GatherSection read_section(segy::Reader& reader, const TraceChoice& choice);

/// Multiplies the samples by (t / 1 s)^power; times at or before 0 become zero.
void apply_gain(GatherSection& section, double power);

/// Neighbours that belong together: a shot, or a line of receivers.
struct TraceRun {
  std::size_t first = 0, count = 0;
  std::string label;
};

/// Puts the traces in ascending order of `axis` and gives their places on it: one each, strictly ascending.
/// automatic: x, y or depth of the receivers of a single shot where these differ, else the number. offset: x
/// of the receiver less that of the source, or their horizontal distance with this sign where they differ in
/// y. Throws a usage Error when two traces share a place.
struct TracePlaces {
  TraceAxis axis = TraceAxis::number;
  std::vector<double> places;
  // Of traces by number: their shots or, of a single shot, lines of receivers; empty where there are not
  // several of several traces. Else first traces of lines within shots.
  std::string run_name = {};
  std::vector<TraceRun> runs = {};
  std::vector<std::size_t> line_starts = {};
};
TracePlaces order_traces(GatherSection& section, TraceAxis axis);

}  // namespace slipwave::plot
