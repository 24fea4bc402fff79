#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace slipwave {

/// What a trace recorded. p = -(sxx + szz)/2 in 2-D, -(sxx + syy + szz)/3 in 3-D.
enum class Component { vx, vy, vz, p, sxx, syy, szz, sxy, sxz, syz, other };

/// "vx" .. "syz", "other".
const char* name_of(Component component);
/// The component of that name; throws Error listing the names otherwise.
Component component_named(const std::string& name);
/// "m/s", "Pa" or "" (other).
const char* unit_of(Component component);

/// Times of the samples of every trace of a gather: start + n interval, n = 0 .. count-1.
struct SampleAxis {
  std::int64_t count = 0;
  double interval_s = 0;
  double start_s = 0;
  bool operator==(const SampleAxis&) const = default;
};

/// Where and what, in SI; z points down from the surface.
struct TraceHeader {
  std::int64_t shot = 1;     // field record, 1-based
  std::int64_t channel = 1;  // receiver number within its component, 1-based
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
