// SPDX-License-Identifier: BSD-3-Clause
#include "plot/magnitudes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace slipwave::plot {
namespace {

constexpr int shift = 15;  // of 31 bits, 8 of exponent and 8 of fraction stay
constexpr std::uint32_t infinity = 0x7f800000u;

}  // namespace

Magnitudes::Magnitudes() : counts_((infinity >> shift) + 1, 0) {}

void Magnitudes::add(std::span<const float> values) {
  for (const float value : values) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value) & 0x7fffffffu;
    if (bits == 0 || bits >= infinity) continue;
    ++counts_[bits >> shift];
    ++count_;
    largest_ = std::max(largest_, std::fabs(value));
    lowest_ = std::min(lowest_, value);
    highest_ = std::max(highest_, value);
  }
}

double Magnitudes::percentile(double percent) const {
  if (percent == 100 || count_ == 0) return largest_;
  const double wanted = percent / 100 * double(count_);
  double below = 0;
  for (std::uint32_t bin = 0; bin < counts_.size(); ++bin) {
    const auto here = double(counts_[bin]);
    if (here > 0 && below + here >= wanted) {
      const double low = std::bit_cast<float>(bin << shift), high = std::bit_cast<float>((bin + 1) << shift);
      return std::min(low + (wanted - below) / here * (high - low), double(largest_));
    }
    below += here;
  }
  return largest_;
}

}  // namespace slipwave::plot
