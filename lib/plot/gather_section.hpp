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
enum class TraceAxis { automatic, x, y, midpoint, offset, azimuth, depth, number };
/// "auto", "x", "y", "midpoint", "offset", "azimuth", "depth", "trace"; throws a usage Error that lists them.
TraceAxis trace_axis_named(const std::string& name);
std::vector<std::string> trace_axis_names();

/// Components by name: "vz", several as "vx,vz", or "all".
struct ComponentChoice {
  std::vector<Component> components = {};  // none: that of the first trace
  bool all = false;
  bool has(Component component) const;
};
/// Throws a usage Error for an unknown name or one given twice.
ComponentChoice parse_components(const std::string& text);

/// Which traces of a file are drawn.
struct TraceChoice {
  ComponentChoice of = {};
  std::optional<std::int64_t> shot = {};  // none: all
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

/// Reads the chosen traces, a section for each component: in the order of the choice or, of all, of the file.
/// Throws Error when there are none of one, naming what the file has instead, or when traces differ in
/// sampling.
std::vector<GatherSection> read_sections(segy::Reader& reader, const TraceChoice& choice);

/// Multiplies the samples by (t / 1 s)^power; times at or before 0 become zero. A power that single precision
/// does not hold at one of the times is a usage Error.
void apply_gain(GatherSection& section, double power);

/// Neighbours that belong together: a shot, or a line of receivers.
struct TraceRun {
  std::size_t first = 0, count = 0;
  std::string label;
};

/// Puts the traces in ascending order of `axis` and gives their places on it: one each, strictly ascending.
/// automatic, of a single shot: the azimuth of receivers on a ring about the source; that one of their x, y
/// and depth which differs for all, and most; the offset where that does; of a trace of each of several shots
/// the midpoint, or the offset where they share one or their receiver; else the number. offset: x of the
/// receiver less that of the source, or their horizontal distance with this sign where they differ in y.
/// azimuth: of the receiver from the source, degrees from +x towards +y. Throws a usage Error when two traces
/// share a place.
struct TracePlaces {
  TraceAxis axis = TraceAxis::number;
  std::vector<double> places;
  // Of traces by number: their shots or, of a single shot, lines of receivers; empty where there are not
  // several of several traces. Else first traces of lines within shots.
  std::string run_name = {};
  std::vector<TraceRun> runs = {};
  std::vector<std::size_t> line_starts = {};
  std::string in_each_run = {};  // "receiver x 20 to 580 m" where all runs have that; else empty
};
TracePlaces order_traces(GatherSection& section, TraceAxis axis);

}  // namespace slipwave::plot
