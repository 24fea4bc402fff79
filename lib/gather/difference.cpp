// SPDX-License-Identifier: BSD-3-Clause
#include "gather/difference.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr double same_place_m = 0.5e-3;

std::string sentence(const std::string& field, const std::string& found, const std::string& expected) {
  return field + " is " + found + ", expected " + expected;
}

}  // namespace

std::string geometry_difference(const TraceHeader& found, const TraceHeader& expected) {
  if (found.shot != expected.shot)
    return sentence("shot", std::to_string(found.shot), std::to_string(expected.shot));
  if (found.channel != expected.channel)
    return sentence("channel", std::to_string(found.channel), std::to_string(expected.channel));
  // Field data seldom say what they are.
  const bool known = found.component != Component::other && expected.component != Component::other;
  if (known && found.component != expected.component)
    return sentence("component", name_of(found.component), name_of(expected.component));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string coordinate(1, "xyz"[axis]);
    if (!(std::fabs(found.source_m[axis] - expected.source_m[axis]) <= same_place_m))
      return sentence("source " + coordinate, shown(found.source_m[axis]) + " m",
                      shown(expected.source_m[axis]) + " m");
    if (!(std::fabs(found.receiver_m[axis] - expected.receiver_m[axis]) <= same_place_m))
      return sentence("receiver " + coordinate, shown(found.receiver_m[axis]) + " m",
                      shown(expected.receiver_m[axis]) + " m");
  }
  return "";
}

std::string sampling_difference(const SampleAxis& found, const SampleAxis& expected) {
  if (found.count != expected.count)
    return sentence("the number of samples", std::to_string(found.count), std::to_string(expected.count));
  if (!(std::fabs(found.interval_s - expected.interval_s) <= 1e-6 * expected.interval_s))
    return sentence("the sample interval", shown(found.interval_s) + " s", shown(expected.interval_s) + " s");
  if (!(std::fabs(found.start_s - expected.start_s) <= 1e-3 * expected.interval_s))
    return sentence("the first sample's time", shown(found.start_s) + " s", shown(expected.start_s) + " s");
  return "";
}

void subtract(std::span<double> samples, std::span<const double> subtrahend) {
  if (samples.size() != subtrahend.size())
    throw Error(
        sentence("the number of samples", std::to_string(subtrahend.size()), std::to_string(samples.size())));
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] -= subtrahend[i];
}

Gather difference(const Gather& a, const Gather& b) {
  if (const std::string differs = sampling_difference(b.axis, a.axis); !differs.empty()) throw Error(differs);
  if (a.traces.size() != b.traces.size())
    throw Error(
        sentence("the number of traces", std::to_string(b.traces.size()), std::to_string(a.traces.size())));
  Gather result = a;
  for (std::size_t i = 0; i < a.traces.size(); ++i)
    in_place("trace " + std::to_string(i + 1), [&] {
      const std::string differs = geometry_difference(b.traces[i].header, a.traces[i].header);
      if (!differs.empty()) throw Error(differs);
      subtract(result.traces[i].samples, b.traces[i].samples);
    });
  return result;
}

}  // namespace slipwave
