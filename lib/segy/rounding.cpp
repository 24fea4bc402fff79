// SPDX-License-Identifier: BSD-3-Clause
#include "segy/rounding.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace slipwave::segy {
namespace {

/// Relative L2 error of samples from which on rounding is worth a word: that of a peak of some 30 units.
constexpr double tolerated_error = 0.01;

/// Floats of one or two words: they lose what is below their range, and nothing worth a word above it.
bool is_float(const SampleFormat& format) { return format.code == 1 || format.code == 5 || format.code == 6; }

bool is_unsigned(const SampleFormat& format) { return format.code >= 10; }

}  // namespace

void Rounding::see(Component component, std::span<const double> samples,
                   std::span<const std::uint8_t> encoded, Endian endian) {
  double largest = 0;
  for (const double sample : samples) largest = std::max(largest, std::fabs(sample));
  if (largest == 0) return;
  decoded_.resize(samples.size());
  decode_samples(encoded, *format_, endian, decoded_);
  auto& seen = components_[component];
  bool any = false;
  double squares = 0, lost = 0;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double change = decoded_[n] - samples[n];
    any |= decoded_[n] != 0;
    squares += samples[n] * samples[n];
    lost += change * change;
  }
  seen.largest = std::max(seen.largest, largest);
  seen.squares += squares;
  seen.squares_lost += lost;
  ++seen.traces;
  seen.zeroed += any ? 0 : 1;
}

/// A power of ten that brings the largest sample below the end of the format's range.
std::string Rounding::remedy(double largest) const {
  const int bits = 8 * format_->bytes - (is_unsigned(*format_) ? 0 : 1);
  const double end = is_float(*format_) ? 1 : std::ldexp(1.0, std::min(bits, 52));
  const double power = std::floor(std::log10(end) - std::log10(largest));
  return "scale them first: sw-filter --gain scale:" + shown(std::pow(10.0, std::min(power, 300.0)));
}

std::vector<std::string> Rounding::sentences() const {
  std::vector<std::string> sentences;
  std::int64_t traces = 0, zeroed = 0;
  double largest = 0;
  for (const auto& [component, seen] : components_) {
    traces += seen.traces;
    zeroed += seen.zeroed;
    largest = std::max(largest, seen.largest);
  }
  const std::string name = format_->name;
  if (traces > 0 && zeroed == traces)
    throw Error("every sample would become 0: the largest is " + shown(largest, 3) + ", sample format " +
                name +
                (is_float(*format_) ? " holds no numbers as small as that; " : " holds whole numbers; ") +
                remedy(largest));
  for (const auto& [component, seen] : components_) {
    const std::string of = components_.size() > 1 ? std::string(name_of(component)) + ": " : "";
    const double error = std::sqrt(seen.squares_lost / seen.squares);
    if (seen.zeroed > 0)
      sentences.push_back(of + std::to_string(seen.zeroed) + " of " + std::to_string(seen.traces) +
                          " traces become zeros in sample format " + name + "; " + remedy(seen.largest));
    else if (!is_float(*format_) && error > tolerated_error)
      sentences.push_back(of + "sample format " + name + " rounds samples by " + shown(100 * error, 2) +
                          " % (relative L2; the largest is " + shown(seen.largest, 3) + "); " +
                          remedy(seen.largest));
  }
  return sentences;
}

}  // namespace slipwave::segy
