// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace slipwave {

/// Shapes a wavelet can have (theory.md (W1)-(W4)). Each is zero outside 0 .. duration_s(), has its largest
/// magnitude near 1 and gives its amplitude spectrum |integral of w exp(-2 pi i f t) dt|, in seconds.
namespace shape {

/// w = (1 - 2 a^2) exp(-a^2), a = pi F (t - delay), delay = 1.5/F. It starts and ends at 1e-8 of its peak.
struct Ricker {
  double peak_hz;
  double value(double t_s) const;
  double delay_s() const { return 1.5 / peak_hz; }
  double start_s() const { return 0; }
  double duration_s() const { return 3 / peak_hz; }
  double nominal_hz() const { return peak_hz; }
  double fine_interval_s() const { return 1 / (64 * peak_hz); }
  double amplitude_spectrum(double hz) const;
};

/// w = exp(-a^2), a = pi F (t - delay), delay = 1.5/F. It starts and ends at 3e-10 of its peak. The Ricker
/// wavelet of the same F is, up to a factor, its second derivative.
struct Gaussian {
  double frequency_hz;
  double value(double t_s) const;
  double delay_s() const { return 1.5 / frequency_hz; }
  double start_s() const { return 0; }
  double duration_s() const { return 3 / frequency_hz; }
  double nominal_hz() const { return frequency_hz; }
  double fine_interval_s() const { return 1 / (64 * frequency_hz); }
  double amplitude_spectrum(double hz) const;
};

/// w = sin(2 pi F t) for `cycles` (a multiple of 1/2) periods from t = 0 on. It starts and ends at zero, with
/// a kink.
struct Sine {
  double frequency_hz;
  double cycles;
  double value(double t_s) const;
  double delay_s() const { return 0; }
  double start_s() const { return 0; }
  double duration_s() const { return cycles / frequency_hz; }
  double nominal_hz() const { return frequency_hz; }
  double fine_interval_s() const { return 1 / (256 * frequency_hz); }
  double amplitude_spectrum(double hz) const;
};

/// A natural cubic spline through samples at growing times that start at 0 or later; zero before and after.
class Sampled {
 public:
  /// times_s and values of equal size, at least 2; delay_s is what was added to the times of the file.
  Sampled(std::vector<double> times_s, std::vector<double> values, double delay_s);
  double value(double t_s) const;
  double delay_s() const { return delay_s_; }
  double start_s() const { return times_s_.front(); }
  double duration_s() const { return times_s_.back(); }
  double nominal_hz() const;
  double fine_interval_s() const;
  double amplitude_spectrum(double hz) const;
  const std::vector<double>& times_s() const { return times_s_; }
  const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> times_s_, values_;
  std::vector<double> bend_;  // second derivatives at the samples
  double delay_s_;
};

}  // namespace shape

/// What a source does in time: a dimensionless function of time in seconds that starts at t = 0. A value:
/// copies are independent.
class Wavelet {
 public:
  using Shape = std::variant<shape::Ricker, shape::Gaussian, shape::Sine, shape::Sampled>;
  Wavelet(Shape shape, std::string text) : shape_(std::move(shape)), text_(std::move(text)) {}

  /// w(t); zero before 0 and after duration_s().
  double operator()(double t_s) const;
  /// The time that counts as zero of the wavelet: the peak of Ricker and Gaussian, the beginning of a sine,
  /// the time 0 of a file. Arrivals appear this much later than the travel time.
  double delay_s() const;
  double duration_s() const;
  /// The frequency it is known by: F; for files the one of the largest amplitude.
  double nominal_hz() const;
  /// |integral of w exp(-2 pi i f t) dt|, s.
  double amplitude_spectrum(double hz) const;
  /// The frequency above which lies `share` of the wavelet in the root-mean-square sense, that is share^2 of
  /// its energy (W5). 0.01: 2.5 F for Ricker, 8.8 F for one cycle of a sine (its kinks).
  double highest_frequency_hz(double share = 0.01) const;
  const Shape& shape() const { return shape_; }
  /// Returns the wavelet as it was asked for: "ricker:30".
  const std::string& text() const { return text_; }

 private:
  Shape shape_;
  std::string text_;
};

/// "ricker:F", "gauss:F", "sine:F[:CYCLES]" (1 cycle unless given) or "file:PATH", F in Hz. Anything else is
/// a usage Error; what is wrong in the file is a data Error that names file and line.
Wavelet parse_wavelet(const std::string& text);

/// A wavelet through samples at growing times, s, of equal number. One that begins before 0 is shifted to
/// begin at 0; a first or last sample that is not zero is led from and to zero over one sample interval.
/// Throws a data Error where there are fewer than two, only zeros, or samples too near to each other.
shape::Sampled sampled_wavelet(std::vector<double> times_s, std::vector<double> values);

/// Reads samples: two columns, time in s and value, or one column of values with a line "# dt=SECONDS"
/// somewhere before the first (the first value is at t = 0). A header line may name the columns, in any
/// order, and the unit of time ("time.ms"). Columns are separated by blanks, tabs, a comma or a semicolon;
/// empty lines and lines that begin with # are skipped. Times must grow, by 1e-15 s and 1e-12 of the whole at
/// least, and lie within 1e9 s of 0; values are at most 1e100. What becomes of them: sampled_wavelet().
shape::Sampled read_wavelet(const std::string& path);

}  // namespace slipwave
