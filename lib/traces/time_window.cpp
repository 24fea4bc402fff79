// SPDX-License-Identifier: BSD-3-Clause
#include "traces/time_window.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "segy/time_words.hpp"

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

std::size_t TimeWindow::first_of(const SampleAxis& axis) const {
  return static_cast<std::size_t>(span_of(*this, axis).first);
}

void TimeWindow::check_reach(const SampleAxis& axis, const std::string& name) const {
  if (cut(axis).count < 1)
    throw Error("found " + shown(from_s) + ":" + shown(to_s) + ", no sample of " + name +
                    " lies there: it goes from " + shown(axis.start_s) + " to " +
                    shown(axis.start_s + static_cast<double>(axis.count - 1) * axis.interval_s, 9) + " s",
                ErrorKind::usage);
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
  const auto first = first_of(axis);
  trace.samples = trace.samples.subspan(first * bytes, static_cast<std::size_t>(left.count) * bytes);
  const auto& file = reader.header();
  segy::set_first_sample(trace.words, left.start_s, !file.su && file.major >= 1);
}

}  // namespace slipwave
