// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

#include "gather/convolution.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// Corners of a band-pass that is a trapezoid over frequency, without phase (Ormsby):
///   W(f) = 0 up to f1, grows linearly to 1 at f2, 1 up to f3, falls linearly to 0 at f4, and 0 beyond.
/// f1 = f2 = 0 leaves the low side open. Equal corners make a step, the corner itself inside.
struct Ormsby {
  double f1_hz = 0, f2_hz = 0, f3_hz = 0, f4_hz = 0;

  /// W(|f|).
  double weight(double f_hz) const;
  /// The integral of W exp(2 pi i f t) over all f, in Hz; with sinc x = sin(pi x)/(pi x)
  ///   h(t) = (f3 + f4) sinc((f3 + f4) t) sinc((f4 - f3) t) - (f1 + f2) sinc((f1 + f2) t) sinc((f2 - f1) t).
  double impulse_response(double t_s) const;
};

/// "F1,F2,F3,F4" in Hz, 0 <= F1 <= F2 <= F3 <= F4, F4 above 0; else a usage Error.
Ormsby parse_ormsby(std::string_view text);

/// The filter for traces of this sampling, y_n = dt sum_m h((n - m) dt) x_m: all lags, so what comes out is
/// that of the endless filter. Throws usage Error when f4 is above the Nyquist frequency.
Convolution band_pass(const SampleAxis& axis, const Ormsby& band);

}  // namespace slipwave
