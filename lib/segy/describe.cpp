// SPDX-License-Identifier: BSD-3-Clause
#include "segy/describe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "base/error.hpp"
#include "segy/extension.hpp"
#include "segy/reader.hpp"

namespace slipwave::segy {
namespace {

/// Sum of squares that neither overflows nor loses small samples: scaled by the largest magnitude so far.
class SquareSum {
 public:
  /// `count` samples of at most `magnitude`, the sum of whose squares over magnitude^2 is `sum`.
  void add(double sum, double magnitude, std::int64_t count) {
    count_ += count;
    if (magnitude > largest_) {
      const double ratio = largest_ / magnitude;
      sum_ = sum + sum_ * ratio * ratio;
      largest_ = magnitude;
    } else if (magnitude > 0) {
      const double ratio = magnitude / largest_;
      sum_ += sum * ratio * ratio;
    }
  }
  void add(const SquareSum& other) {
    if (other.count_ > 0) add(other.sum_, other.largest_, other.count_);
  }
  double rms() const { return count_ == 0 ? 0 : largest_ * std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double largest_ = 0;
  double sum_ = 0;
  std::int64_t count_ = 0;
};

/// What one pass over the samples of a trace finds, in lanes that a processor takes side by side.
struct Lanes {
  static constexpr std::size_t count = 8;
  std::array<double, count> lowest;
  std::array<double, count> highest;
  std::array<double, count> squares;

  Lanes() {
    lowest.fill(std::numeric_limits<double>::infinity());
    highest.fill(-std::numeric_limits<double>::infinity());
    squares.fill(0);
  }
  void see(std::size_t lane, double sample) {
    lowest[lane] = sample < lowest[lane] ? sample : lowest[lane];
    highest[lane] = sample > highest[lane] ? sample : highest[lane];
    squares[lane] += sample * sample;
  }
};

/// Byte 37, which is rounded or cut to whole units.
void see_offset(Description& facts, const Trace& trace, double offset_m) {
  const auto place =
      place_words(trace.words, facts.header, extension_of(trace.extensions, facts.header.endian));
  facts.offset_word_m.see(place.offset_m);
  const double beyond = std::fabs(std::fabs(place.offset_m) - std::fabs(offset_m));
  facts.offsets_differ = facts.offsets_differ || (place.offset_m != 0 && beyond > place.unit_m);
}

/// Words as they are where their scalar cannot be one.
void see_scalars(Description& facts, const Trace& trace, TraceHeader& header) {
  const auto& words = trace.words;
  const auto fault_of = [](const char* byte, std::int64_t scalar) {
    return is_length_scalar(scalar)
               ? ""
               : "scalar " + std::to_string(scalar) + " (byte " + byte + ") is no power of ten";
  };
  if (const auto fault = fault_of("71", words.get("scalco")); !fault.empty()) {
    facts.coordinate_fault = fault;
    header.source_m[0] = double(words.get("sx")), header.source_m[1] = double(words.get("sy"));
    header.receiver_m[0] = double(words.get("gx")), header.receiver_m[1] = double(words.get("gy"));
  }
  if (const auto fault = fault_of("69", words.get("scalel")); !fault.empty()) {
    facts.height_fault = fault;
    header.source_m[2] = double(words.get("sdepth") - words.get("selev"));
    header.receiver_m[2] = -double(words.get("gelev"));
  }
  if (const auto arc = arc_of(words); !arc.empty()) facts.arc = arc;
}

void see_header(Description& facts, const Trace& trace, TraceHeader header) {
  ++facts.components[header.component].traces;
  see_scalars(facts, trace, header);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    facts.source_m[axis].see(header.source_m[axis]);
    facts.receiver_m[axis].see(header.receiver_m[axis]);
  }
  const double x = header.receiver_m[0] - header.source_m[0], y = header.receiver_m[1] - header.source_m[1];
  const double offset = y == 0 ? x : std::copysign(std::hypot(x, y), x != 0 ? x : y);
  facts.offset_m.see(offset);
  see_offset(facts, trace, offset);
}

/// What has been seen of the samples of a component.
struct Seen {
  Range sample;
  SquareSum squares;
  std::int64_t not_finite = 0;
};

void see_each(Seen& seen, const std::vector<double>& samples) {
  for (const double sample : samples) {
    if (!std::isfinite(sample)) {
      ++seen.not_finite;
      continue;
    }
    seen.sample.see(sample);
    seen.squares.add(1, std::fabs(sample), 1);
  }
}

void see_samples(Seen& seen, const std::vector<double>& samples) {
  Lanes lanes;
  std::size_t i = 0;
  for (; i + Lanes::count <= samples.size(); i += Lanes::count)
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) lanes.see(lane, samples[i + lane]);
  for (std::size_t lane = 0; i < samples.size(); ++i, ++lane) lanes.see(lane, samples[i]);
  const double sum = std::accumulate(lanes.squares.begin(), lanes.squares.end(), 0.0);
  const double lowest = *std::min_element(lanes.lowest.begin(), lanes.lowest.end());
  const double highest = *std::max_element(lanes.highest.begin(), lanes.highest.end());
  const double magnitude = std::max(std::fabs(lowest), std::fabs(highest));
  // A sum in this range holds no NaN, no infinity, no overflow and no underflow that matters.
  const bool plain = (sum > 1e-250 && sum < 1e300) || (sum == 0 && magnitude == 0);
  if (!plain) return see_each(seen, samples);
  seen.sample.see(lowest);
  seen.sample.see(highest);
  seen.squares.add(sum == 0 ? 0 : sum / (magnitude * magnitude), magnitude,
                   static_cast<std::int64_t>(samples.size()));
}

}  // namespace

Description describe(const std::string& path, const ReadOptions& options,
                     std::vector<std::uint8_t> already_read) {
  Reader reader(path, options, std::move(already_read));
  Description facts;
  facts.header = reader.header();
  facts.axis = reader.axis();
  facts.positions = reader.positions();
  std::map<Component, Seen> seen;
  Trace trace;
  std::optional<std::int64_t> shot;
  std::unordered_set<std::int64_t> shots;
  try {
    while (reader.next(trace)) {
      const TraceHeader header = reader.si_header(trace);
      if (shot != header.shot) shots.insert(header.shot);
      shot = header.shot;
      facts.lengths_vary = facts.lengths_vary || !(reader.axis_of(trace) == facts.axis);
      see_header(facts, trace, header);
      see_samples(seen[header.component], trace.samples);
    }
  } catch (const Error& error) {
    facts.damage = error.what();
  }
  facts.traces = reader.delivered();
  facts.doubts = reader.doubts();
  facts.shots = static_cast<std::int64_t>(shots.size());
  SquareSum all;
  for (const auto& [component, of_it] : seen) {
    auto& said = facts.components[component];
    said.sample = of_it.sample;
    said.rms = of_it.squares.rms();
    facts.not_finite += of_it.not_finite;
    if (!of_it.sample.empty()) {
      facts.sample.see(of_it.sample.lowest);
      facts.sample.see(of_it.sample.highest);
    }
    all.add(of_it.squares);
  }
  facts.rms = all.rms();
  return facts;
}

}  // namespace slipwave::segy
