// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/trace_wavelet.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "gather/trace.hpp"
#include "io/input_bytes.hpp"
#include "segy/reader.hpp"
#include "segy/sniff.hpp"

namespace slipwave {
namespace {

/// Numbers in columns may look like the header of a Seismic Unix trace.
bool holds_traces(const std::string& path) {
  const InputStart start(path, 3600);
  std::vector<std::uint8_t> bytes(start.bytes().begin(), start.bytes().end());
  const auto size = start.is_regular() ? std::optional(InputFile(path).size()) : std::nullopt;
  const auto kind = segy::kind_of(bytes, size);
  if (kind == segy::FileKind::segy) return true;
  const std::span first(bytes.data(), std::min<std::size_t>(bytes.size(), 240));
  return kind == segy::FileKind::su && !segy::looks_like_text(first);
}

shape::Sampled read_trace(const std::string& path, std::int64_t number) {
  segy::Reader reader(path);
  segy::RawTrace skipped;
  while (reader.delivered() + 1 < number)
    if (!reader.next(skipped)) break;
  segy::Trace trace;
  if (reader.delivered() + 1 < number || !reader.next(trace))
    throw Error(path + ": found " + std::to_string(reader.delivered()) +
                    (reader.delivered() == 1 ? " trace" : " traces") + ", expected trace " +
                    std::to_string(number),
                number > 1 ? ErrorKind::usage : ErrorKind::data);
  for (const auto& doubt : reader.doubts()) throw Error(doubt);
  return in_place(path + ": trace " + std::to_string(number), [&] {
    check_finite(trace.samples);
    const auto axis = reader.axis_of(trace);
    if (!(axis.interval_s > 0)) throw Error("found no sampling interval, expected one");
    std::vector<double> times;
    times.reserve(trace.samples.size());
    for (std::size_t n = 0; n < trace.samples.size(); ++n)
      times.push_back(axis.start_s + double(n) * axis.interval_s);
    return sampled_wavelet(std::move(times), std::move(trace.samples));
  });
}

}  // namespace

Wavelet wavelet_named(const std::string& text) {
  if (!text.starts_with("file:")) return parse_wavelet(text);
  std::string path = text.substr(5);
  std::int64_t number = 1;
  const auto colon = path.rfind(':');
  const bool numbered = colon != std::string::npos && colon > 0 && colon + 1 < path.size() &&
                        path.find_first_not_of("0123456789", colon + 1) == std::string::npos &&
                        access(path.c_str(), F_OK) != 0;
  if (numbered) {
    const double given = parse_number(path.substr(colon + 1));
    if (!(given >= 1 && given <= 1e15))
      throw Error("wavelet '" + text + "': traces count from 1", ErrorKind::usage);
    number = std::int64_t(given);
    path.resize(colon);
  }
  if (path.empty() || !(numbered || is_regular_input(path)) || !holds_traces(path)) {
    if (numbered)
      throw Error("wavelet '" + text + "': " + path + " holds no traces, expected SEG-Y or Seismic Unix");
    return parse_wavelet(text);
  }
  return {read_trace(path, number), text};
}

std::string beyond_record(const Wavelet& wavelet, double delay_s, double record_s) {
  const auto* const sampled = std::get_if<shape::Sampled>(&wavelet.shape());
  if (!sampled || delay_s + sampled->duration_s() <= record_s) return "";
  const auto& times = sampled->times_s();
  const auto& values = sampled->values();
  double all = 0, beyond = 0;
  for (std::size_t n = 0; n + 1 < times.size(); ++n) {
    const double energy = values[n] * values[n] * (times[n + 1] - times[n]);
    all += energy;
    if (delay_s + times[n] > record_s) beyond += energy;
  }
  if (!(beyond > 1e-4 * all)) return "";
  return "wavelet " + wavelet.text() + " ends at " + shown(delay_s + sampled->duration_s(), 6) +
         " s, beyond the record of " + shown(record_s) + " s (" + shown(100 * beyond / all, 3) +
         " % of its energy), in samples " + shown(times[times.size() / 2] - times[times.size() / 2 - 1], 6) +
         " s apart: times in its file are in seconds, unless its header line names another unit";
}

}  // namespace slipwave
