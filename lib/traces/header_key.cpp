// SPDX-License-Identifier: BSD-3-Clause
#include "traces/header_key.hpp"

#include <algorithm>
#include <cmath>

#include "segy/layout_trace.hpp"
#include "segy/sample_format.hpp"
#include "segy/words.hpp"

namespace slipwave {

namespace {

std::vector<double> samples_of(const TraceView& view) {
  const segy::SampleFormat& format = *view.file->format;
  const auto bytes = view.trace->samples;
  std::vector<double> samples(bytes.size() / static_cast<std::size_t>(format.bytes));
  segy::decode_samples(bytes, format, view.file->endian, samples);
  check_finite(samples);  // no condition holds for NaN: such a trace would be left out unnoticed
  return samples;
}

}  // namespace

TraceView view_of(const segy::Reader& reader, const segy::RawTrace& trace) {
  return {reader.delivered(), reader.si_header(trace), &trace, &reader.header()};
}

enum class HeaderKey::Fact {
  trace,
  component,
  shot,
  channel,
  source_x,
  source_y,
  source_z,
  receiver_x,
  receiver_y,
  receiver_z,
  midpoint_x,
  midpoint_y,
  distance,
  peak,
  rms,
  word
};

struct HeaderKey::Row {
  Fact fact;
  const char* name;
};

const std::vector<HeaderKey::Row>& HeaderKey::rows() {
  static const std::vector<Row> all = {
      {Fact::trace, "trace"},
      {Fact::component, "component"},
      {Fact::shot, "shot"},
      {Fact::channel, "channel"},
      {Fact::source_x, "source_x"},
      {Fact::source_y, "source_y"},
      {Fact::source_z, "source_z"},
      {Fact::receiver_x, "receiver_x"},
      {Fact::receiver_y, "receiver_y"},
      {Fact::receiver_z, "receiver_z"},
      {Fact::midpoint_x, "midpoint_x"},
      {Fact::midpoint_y, "midpoint_y"},
      {Fact::distance, "distance"},
      {Fact::peak, "peak"},
      {Fact::rms, "rms"},
  };
  return all;
}

std::optional<HeaderKey> HeaderKey::named(const std::string& name) {
  for (const Row& row : rows())
    if (name == row.name) return HeaderKey(row.fact, nullptr);
  for (const segy::Field& field : segy::TraceLayout::fields)
    if (field.name == name) return HeaderKey(Fact::word, &field);
  return std::nullopt;
}

const std::vector<std::string>& HeaderKey::names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const Row& row : rows()) names.emplace_back(row.name);
    for (const segy::Field& field : segy::TraceLayout::fields) names.emplace_back(field.name);
    return names;
  }();
  return all;
}

bool HeaderKey::is_component() const { return fact_ == Fact::component; }

double HeaderKey::value(const TraceView& view) const {
  const TraceHeader& header = view.header;
  switch (fact_) {
    case Fact::trace:
      return static_cast<double>(view.number);
    case Fact::component:
      return static_cast<double>(header.component);
    case Fact::shot:
      return static_cast<double>(header.shot);
    case Fact::channel:
      return static_cast<double>(header.channel);
    case Fact::source_x:
      return header.source_m[0];
    case Fact::source_y:
      return header.source_m[1];
    case Fact::source_z:
      return header.source_m[2];
    case Fact::receiver_x:
      return header.receiver_m[0];
    case Fact::receiver_y:
      return header.receiver_m[1];
    case Fact::receiver_z:
      return header.receiver_m[2];
    case Fact::midpoint_x:
      return (header.source_m[0] + header.receiver_m[0]) / 2;
    case Fact::midpoint_y:
      return (header.source_m[1] + header.receiver_m[1]) / 2;
    case Fact::distance:
      return std::hypot(header.receiver_m[0] - header.source_m[0], header.receiver_m[1] - header.source_m[1]);
    case Fact::peak: {
      double peak = 0;
      for (const double sample : samples_of(view)) peak = std::max(peak, std::fabs(sample));
      return peak;
    }
    case Fact::rms: {
      const auto samples = samples_of(view);
      double sum = 0;
      for (const double sample : samples) sum += sample * sample;
      return samples.empty() ? 0 : std::sqrt(sum / static_cast<double>(samples.size()));
    }
    case Fact::word:
      break;
  }
  return static_cast<double>(view.trace->words.get(segy::FieldName<segy::TraceLayout>(*word_)));
}

}  // namespace slipwave
