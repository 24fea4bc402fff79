// SPDX-License-Identifier: BSD-3-Clause
#include "gather/gain.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

struct GainRow {
  Gain::Kind kind;
  const char* name;
  const char* value;  // what stands behind the colon, nullptr: nothing
};

constexpr GainRow gain_rows[] = {
    {Gain::Kind::power, "power", "P"}, {Gain::Kind::exp, "exp", "A"},       {Gain::Kind::agc, "agc", "T"},
    {Gain::Kind::rms, "rms", nullptr}, {Gain::Kind::peak, "peak", nullptr}, {Gain::Kind::scale, "scale", "C"},
    {Gain::Kind::clip, "clip", "C"},
};

[[noreturn]] void refuse_gain(const std::string& text) {
  std::string known;
  for (const GainRow& row : gain_rows)
    known.append(known.empty() ? "" : ", ")
        .append(row.name)
        .append(row.value ? std::string(":") + row.value : "");
  throw Error("found '" + text + "', expected one of " + known, ErrorKind::usage);
}

void divide(std::span<double> samples, double by) {
  if (by > 0)
    for (double& sample : samples) sample /= by;
}

double peak_of(std::span<const double> samples) {
  double peak = 0;
  for (const double sample : samples) peak = std::max(peak, std::fabs(sample));
  return peak;
}

double rms_of(std::span<const double> samples) {
  double sum = 0;
  for (const double sample : samples) sum += sample * sample;
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

template <class Weight>
void weigh(std::span<double> samples, const SampleAxis& axis, Weight weight) {
  for (std::size_t n = 0; n < samples.size(); ++n)
    samples[n] *= weight(axis.start_s + static_cast<double>(n) * axis.interval_s);
}

}  // namespace

Gain parse_gain(const std::string& text) {
  const auto colon = text.find(':');
  for (const GainRow& row : gain_rows) {
    if (text.substr(0, colon) != row.name) continue;
    if ((colon != std::string::npos) != (row.value != nullptr)) refuse_gain(text);
    if (!row.value) return {row.kind, 1};
    const double value = in_place(row.name, [&] { return parse_number(text.substr(colon + 1)); });
    if ((row.kind == Gain::Kind::agc || row.kind == Gain::Kind::clip) && !(value > 0))
      throw Error("found '" + text + "', expected " + row.value + " above 0", ErrorKind::usage);
    if (row.kind == Gain::Kind::scale && value == 0)
      throw Error("found '" + text + "', expected C other than 0", ErrorKind::usage);
    return {row.kind, value};
  }
  refuse_gain(text);
}

void Gains::apply(std::span<double> samples, const SampleAxis& axis) {
  if (samples.empty()) return;
  for (const Gain& gain : gains_) {
    const double value = gain.value;
    switch (gain.kind) {
      case Gain::Kind::power:
        weigh(samples, axis, [value](double t_s) { return t_s > 0 ? std::pow(t_s, value) : 0; });
        break;
      case Gain::Kind::exp:
        weigh(samples, axis, [value](double t_s) { return std::exp(value * t_s); });
        break;
      case Gain::Kind::agc: {
        const double half = std::floor(value / (2 * axis.interval_s) + 1e-9);
        control(samples, static_cast<std::size_t>(std::min(half, static_cast<double>(samples.size() - 1))));
        break;
      }
      case Gain::Kind::rms:
        divide(samples, peak_of(samples));  // first, so that no square overflows or vanishes
        divide(samples, rms_of(samples));
        break;
      case Gain::Kind::peak:
        divide(samples, peak_of(samples));
        break;
      case Gain::Kind::scale:
        for (double& sample : samples) sample *= value;
        break;
      case Gain::Kind::clip:
        for (double& sample : samples) sample = std::clamp(sample, -value, value);
        break;
    }
  }
}

/// Sums over windows of `width` samples are the sum of what is left of one block of that many and of the
/// beginning of the next: nothing is ever subtracted, so weak samples behind strong ones keep their digits.
void Gains::control(std::span<double> samples, std::size_t half) {
  const double unit = peak_of(samples);
  if (!(unit > 0)) return;
  const std::size_t count = samples.size();
  const std::size_t width = 2 * half + 1;
  squares_.assign(count + 2 * half, 0.0);
  for (std::size_t n = 0; n < count; ++n) squares_[n + half] = (samples[n] / unit) * (samples[n] / unit);
  before_ = after_ = squares_;
  const std::size_t padded = squares_.size();
  for (std::size_t block = 0; block < padded; block += width) {
    const std::size_t end = std::min(block + width, padded);
    for (std::size_t n = block + 1; n < end; ++n) before_[n] += before_[n - 1];
    for (std::size_t n = end - 1; n-- > block;) after_[n] += after_[n + 1];
  }
  for (std::size_t n = 0, in_block = 0; n < count; ++n, in_block = in_block + 1 == width ? 0 : in_block + 1) {
    const double sum = in_block == 0 ? before_[n + width - 1] : after_[n] + before_[n + width - 1];
    const std::size_t there = std::min(count - 1, n + half) - (n > half ? n - half : 0) + 1;
    const double rms = std::sqrt(sum / static_cast<double>(there));
    if (rms > 0) samples[n] /= rms * unit;
  }
}

}  // namespace slipwave
