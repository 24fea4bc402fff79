// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave {

/// What can be done to the amplitudes of a trace x(t):
///   power:P  x t^P, t in s; 0 up to t = 0        exp:A    x exp(A t), A in 1/s
///   agc:T    x over its root mean square within T/2 of t (as far as there are samples), T in s
///   rms      x over its root mean square         peak     x over its largest magnitude
///   scale:C  C x                                 clip:C   x, but at most C and at least -C
/// A trace, or a window, of zeros stays zero.
struct Gain {
  enum class Kind { power, exp, agc, rms, peak, scale, clip };
  Kind kind = Kind::scale;
  double value = 1;  // P, A, T or C
};

/// "power:2", "rms", ...: anything else, agc and clip of nothing above zero too, is a usage Error.
Gain parse_gain(const std::string& text);

/// Applies gains to traces of one sampling, in place.
class Gains {
 public:
  explicit Gains(std::vector<Gain> gains) : gains_(std::move(gains)) {}
  /// Sample n of the trace is at axis.start_s + n axis.interval_s.
  void apply(std::span<double> samples, const SampleAxis& axis);

 private:
  void control(std::span<double> samples, std::size_t half);

  std::vector<Gain> gains_;
  std::vector<double> squares_, before_, after_;
};

}  // namespace slipwave
