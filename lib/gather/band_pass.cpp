// SPDX-License-Identifier: BSD-3-Clause
#include "gather/band_pass.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

double sinc(double x) {
  const double arm = std::numbers::pi * x;
  return std::fabs(arm) < 1e-8 ? 1 : std::sin(arm) / arm;
}

/// Response of a low-pass that is 1 up to `pass` and falls linearly to 0 at `stop`.
double low_pass(double pass_hz, double stop_hz, double t_s) {
  return (pass_hz + stop_hz) * sinc((pass_hz + stop_hz) * t_s) * sinc((stop_hz - pass_hz) * t_s);
}

}  // namespace

double Ormsby::weight(double f_hz) const {
  const double f = std::fabs(f_hz);
  if (f >= f2_hz && f <= f3_hz) return 1;
  if (f <= f1_hz || f >= f4_hz) return 0;
  return f < f2_hz ? (f - f1_hz) / (f2_hz - f1_hz) : (f4_hz - f) / (f4_hz - f3_hz);
}

double Ormsby::impulse_response(double t_s) const {
  return low_pass(f3_hz, f4_hz, t_s) - low_pass(f1_hz, f2_hz, t_s);
}

Ormsby parse_ormsby(std::string_view text) {
  const auto f = parse_numbers(text, ',');
  const bool ordered = f.size() == 4 && 0 <= f[0] && f[0] <= f[1] && f[1] <= f[2] && f[2] <= f[3] && f[3] > 0;
  if (!ordered)
    throw Error("found '" + std::string(text) + "', expected F1,F2,F3,F4 in Hz, none below the one before it",
                ErrorKind::usage);
  return {f[0], f[1], f[2], f[3]};
}

Convolution band_pass(const SampleAxis& axis, const Ormsby& band) {
  const double nyquist_hz = 0.5 / axis.interval_s;
  if (band.f4_hz > nyquist_hz * (1 + 1e-9))
    throw Error("found F4 = " + shown(band.f4_hz) + " Hz, expected at most the Nyquist frequency " +
                    shown(nyquist_hz, 9) + " Hz of samples every " + shown(axis.interval_s) + " s",
                ErrorKind::usage);
  const double longest_s = static_cast<double>(axis.count - 1) * axis.interval_s;
  return {static_cast<std::size_t>(axis.count),
          sampled_kernel([&](double t_s) { return band.impulse_response(t_s); }, -longest_s, longest_s,
                         axis.interval_s)};
}

}  // namespace slipwave
