// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segy/reader.hpp"

namespace slipwave::segy {

/// Two files of the same survey, read side by side in the memory of two traces. Throws Error naming file,
/// trace and field where B's sampling or geometry is not A's, and when one has more traces than the other.
class PairReader {
 public:
  PairReader(Reader& a, Reader& b);
  /// The next trace of each; false after the last ones.
  bool next(Trace& a, Trace& b) { return next_of_both(a, b); }
  /// Reads the next traces without decoding their samples.
  bool next(RawTrace& a, RawTrace& b) { return next_of_both(a, b); }

 private:
  template <class AnyTrace>
  bool next_of_both(AnyTrace& a, AnyTrace& b);
  template <class AnyTrace>
  bool equal_headers(const AnyTrace& a, const AnyTrace& b) const;

  Reader& a_;
  Reader& b_;
};

}  // namespace slipwave::segy
