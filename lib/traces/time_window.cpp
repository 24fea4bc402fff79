// SPDX-License-Identifier: BSD-3-Clause
#include "traces/time_window.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "segy/geometry.hpp"

namespace slipwave {
namespace {

struct Span {
  std::int64_t first, end;
};

/// Samples within the window, to a millionth of the interval.
Span span_of(const TimeWindow& window, const SampleAxis& axis) {
  const double last = static_cast<double>(axis.count);
  const double first = std::ceil((window.from_s - axis.start_s) / axis.interval_s - 1e-6);
  const double end = std::floor((window.to_s - axis.start_s) / axis.interval_s + 1e-6) + 1;
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, last)),
          static_cast<std::int64_t>(std::clamp(end, 0.0, last))};
}

void set_start(segy::TraceWords& words, const segy::FileHeader& file, double start_s) {
  const bool has_scalar = !file.su && file.major >= 1;
  const double unit_s = 1e-3 * segy::scaled(1, has_scalar ? words.get("tscal") : 1);
  const double word = start_s / unit_s;
  if (std::fabs(word - std::nearbyint(word)) > 1e-6)
    throw Error("its first sample would be at " + shown(start_s, 9) + " s, SEG-Y holds whole milliseconds");
  words.set("delrt", std::llround(word));
}

}  // namespace

TimeWindow parse_time_window(const std::string& text) {
  const auto times = parse_numbers(text, ':');
  if (times.size() != 2 || times[0] > times[1])
    throw Error("found '" + text + "', expected T0:T1 in s, T0 not above T1", ErrorKind::usage);
  return {times[0], times[1]};
}

SampleAxis TimeWindow::cut(const SampleAxis& axis) const {
  const Span span = span_of(*this, axis);
  return {std::max<std::int64_t>(span.end - span.first, 0), axis.interval_s,
          axis.start_s + static_cast<double>(span.first) * axis.interval_s};
}

void TimeWindow::cut(segy::RawTrace& trace, const segy::Reader& reader) const {
  const auto bytes = static_cast<std::size_t>(reader.header().format->bytes);
  reader.axis_with_interval();  // refuses a file that does not say its interval
  const SampleAxis axis = reader.axis_of(trace);
  const SampleAxis left = cut(axis);
  if (left.count < 1)
    throw Error("has no samples from " + shown(from_s) + " to " + shown(to_s) + " s, it goes from " +
                shown(axis.start_s) + " to " +
                shown(axis.start_s + static_cast<double>(axis.count - 1) * axis.interval_s, 9) + " s");
  const auto first = static_cast<std::size_t>(span_of(*this, axis).first);
  trace.samples = trace.samples.subspan(first * bytes, static_cast<std::size_t>(left.count) * bytes);
  set_start(trace.words, reader.header(), left.start_s);
}

}  // namespace slipwave
