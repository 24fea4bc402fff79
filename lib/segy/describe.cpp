#include "segy/describe.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "segy/reader.hpp"

namespace slipwave::segy {
namespace {

/// Sum of squares that neither overflows nor loses small samples: scaled by the largest magnitude so far.
class SquareSum {
 public:
  void add(double value) {
    const double magnitude = std::fabs(value);
    ++count_;
    if (magnitude > largest_) {
      const double ratio = largest_ / magnitude;
      sum_ = 1 + sum_ * ratio * ratio;
      largest_ = magnitude;
    } else if (magnitude > 0) {
      const double ratio = magnitude / largest_;
      sum_ += ratio * ratio;
    }
  }
  double rms() const { return count_ == 0 ? 0 : largest_ * std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double largest_ = 0;
  double sum_ = 0;
  std::int64_t count_ = 0;
};

void see_header(Description& facts, const TraceHeader& header) {
  ++facts.components[header.component];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    facts.source_m[axis].see(header.source_m[axis]);
    facts.receiver_m[axis].see(header.receiver_m[axis]);
  }
  facts.offset_m.see(header.receiver_m[0] - header.source_m[0]);
}

void see_samples(Description& facts, SquareSum& squares, const std::vector<double>& samples) {
  for (const double sample : samples) {
    if (!std::isfinite(sample)) {
      ++facts.not_finite;
      continue;
    }
    facts.sample.see(sample);
    squares.add(sample);
  }
}

}  // namespace

Description describe(const std::string& path, const ReadOptions& options,
                     std::vector<std::uint8_t> already_read) {
  Reader reader(path, options, std::move(already_read));
  Description facts;
  facts.header = reader.header();
  facts.axis = reader.axis();
  SquareSum squares;
  Trace trace;
  std::optional<std::int64_t> shot;
  try {
    while (reader.next(trace)) {
      const TraceHeader header = reader.si_header(trace);
      if (shot != header.shot) ++facts.shots;
      shot = header.shot;
      facts.lengths_vary = facts.lengths_vary || !(reader.axis_of(trace) == facts.axis);
      see_header(facts, header);
      see_samples(facts, squares, trace.samples);
    }
  } catch (const Error& error) {
    facts.damage = error.what();
  }
  facts.traces = reader.delivered();
  facts.rms = squares.rms();
  return facts;
}

}  // namespace slipwave::segy
