// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gather/trace.hpp"
#include "segy/field.hpp"
#include "segy/reader.hpp"

namespace slipwave {

/// A trace of a file with what conditions and sort keys may ask of it.
struct TraceView {
  std::int64_t number = 0;  // in its file, from 1
  TraceHeader header;       // in SI
  const segy::RawTrace* trace = nullptr;
  const segy::FileHeader* file = nullptr;  // of the file, for its sample format
};

/// The trace that `reader` delivered last; valid until the next one.
TraceView view_of(const segy::Reader& reader, const segy::RawTrace& trace);

/// Something about a trace that has a name and a value:
///   trace                              number in the file, from 1
///   component                          vx, vz, p, ..., other (ordered so; Component's number)
///   shot, channel                      fldr and tracf by their meaning
///   source_x, _y, _z, receiver_x, ...  positions in m, z down
///   midpoint_x, midpoint_y             half way between source and receiver, m
///   distance                           between source and receiver along the surface, m, never negative
///   peak, rms                          largest magnitude and root mean square of the samples
/// and every word of the trace header by its name (offset, cdp, fldr, sx, ...), as it stands in the file.
class HeaderKey {
 public:
  /// Nothing when there is no such name.
  static std::optional<HeaderKey> named(const std::string& name);
  /// All names, those in SI first.
  static const std::vector<std::string>& names();

  bool is_component() const;
  double value(const TraceView& view) const;

 private:
  enum class Fact;
  HeaderKey(Fact fact, const segy::Field* word) : fact_(fact), word_(word) {}

  struct Row;
  static const std::vector<Row>& rows();

  Fact fact_;
  const segy::Field* word_;  // of Fact::word
};

}  // namespace slipwave
