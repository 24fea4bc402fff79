// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gather/component.hpp"

namespace slipwave {

/// Times of the samples of every trace of a gather: start + n interval, n = 0 .. count-1.
struct SampleAxis {
  std::int64_t count = 0;
  double interval_s = 0;
  double start_s = 0;
  bool operator==(const SampleAxis&) const = default;
};

/// This header says where a trace is and what it holds, in SI; z points down from the surface.
struct TraceHeader {
  std::int64_t shot = 1;     // field record, 1-based
  std::int64_t channel = 1;  // receiver number within its component, 1-based
  std::int64_t bin = 0;      // midpoint bin (cdp); 0: by the midpoint
  Component component = Component::other;
  std::array<double, 3> source_m{};    // x, y, z
  std::array<double, 3> receiver_m{};  // x, y, z
  double water_depth_source_m = 0;     // thickness of fluid above rock at the source, 0 on land
  double water_depth_receiver_m = 0;
};

struct Trace {
  TraceHeader header;
  std::vector<double> samples;
};

/// Throws Error "sample 17: nan, expected a finite number" for the first that is none; samples count from 1.
void check_finite(std::span<const double> samples);

/// Traces of equal length.
struct Gather {
  SampleAxis axis;
  std::vector<Trace> traces;
};

}  // namespace slipwave
