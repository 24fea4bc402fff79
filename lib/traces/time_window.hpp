// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segy/reader.hpp"

namespace slipwave {

/// The samples of a trace from one time to another, ends included.
struct TimeWindow {
  double from_s = 0, to_s = 0;

  /// Leaves these samples of a trace that `reader` delivered and sets its delay (byte 109). Throws Error when
  /// there are none of them, or when the header cannot hold the time of the first.
  void cut(segy::RawTrace& trace, const segy::Reader& reader) const;
  /// Throws a usage Error where it leaves nothing of an axis, that of `name`.
  void check_reach(const SampleAxis& axis, const std::string& name) const;
  /// What is left of an axis; count 0 when nothing is.
  SampleAxis cut(const SampleAxis& axis) const;
  /// The sample of that axis that is the first of what is left.
  std::size_t first_of(const SampleAxis& axis) const;
};

/// "T0:T1" in s, T0 <= T1; else a usage Error.
TimeWindow parse_time_window(const std::string& text);

}  // namespace slipwave
