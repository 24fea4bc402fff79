// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gather/trace.hpp"
#include "segy/file_header.hpp"
#include "segy/geometry.hpp"

namespace slipwave::segy {

/// Lowest and highest of what was seen; empty() before anything was.
struct Range {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  void see(double value) {
    if (value < lowest) lowest = value;
    if (value > highest) highest = value;
  }
  bool empty() const { return lowest > highest; }
};

/// The traces of a component. Each has a unit of its own.
struct ComponentSamples {
  std::int64_t traces = 0;
  Range sample;  // finite ones
  double rms = 0;
};

/// What is in a file of traces. Samples are plain numbers, before any trace weighting.
struct Description {
  FileHeader header;
  SampleAxis axis;            // of the first trace
  bool lengths_vary = false;  // traces have other numbers of samples, or start at other times
  std::int64_t traces = 0;    // whole ones
  std::int64_t shots = 0;     // different field records
  std::map<Component, ComponentSamples> components;
  Range source_m[3];  // x, y, z
  Range receiver_m[3];
  PositionsGiven positions;
  Range offset_m;               // receiver minus source, with the sign of its first part that is not 0
  Range offset_word_m;          // byte 37
  bool offsets_differ = false;  // that of some trace is not 0 and not the distance of its ends
  /// Units of coordinates that are not lengths (arc_of()); "" of lengths.
  std::string arc;
  /// What coordinates cannot be read with: "scalar 82 (byte 71)"; "" where they can. They are words then.
  std::string coordinate_fault, height_fault;
  Range sample;  // finite samples of all components, whatever their units
  double rms = 0;
  std::int64_t not_finite = 0;
  std::vector<std::string> doubts;    // Reader::doubts()
  std::optional<std::string> damage;  // what stopped the reading before the end ("ends within trace 4: ...")
};

/// Reads everything, in the memory of one trace and the number of each shot. Throws Error when the headers
/// cannot be read; what goes wrong later stands in `damage`.
Description describe(const std::string& path, const ReadOptions& options = {},
                     std::vector<std::uint8_t> already_read = {});

}  // namespace slipwave::segy
