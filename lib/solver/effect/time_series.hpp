// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace slipwave::solver {

/// Samples at equal intervals, interpolated by quintics; zero before the first and after the last.
class TimeSeries {
 public:
  TimeSeries() = default;
  TimeSeries(std::vector<float> samples, double first_s, double interval_s)
      : samples_(std::move(samples)), first_s_(first_s), interval_s_(interval_s) {}
  /// Writes the values at t_s + (first + i) step_s, of i from 0 to count - 1.
  template <class Real>
  void values(double t_s, double step_s, std::int64_t first, std::int64_t count, Real* to) const;
  /// Whether it is zero everywhere between two times.
  bool is_zero(double from_s, double to_s) const { return to_s < first_s_ || from_s > end_s(); }
  bool empty() const { return samples_.empty(); }
  double first_s() const { return first_s_; }
  double end_s() const { return first_s_ + interval_s_ * double(samples_.size()); }
  double interval_s() const { return interval_s_; }
  std::int64_t memory_bytes() const { return std::int64_t(samples_.capacity() * sizeof(float)); }

 private:
  std::vector<float> samples_;
  double first_s_ = 0, interval_s_ = 1;
};

}  // namespace slipwave::solver
