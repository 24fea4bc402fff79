#pragma once

#include "segy/reader.hpp"

namespace slipwave::segy {

/// Two files of the same survey, read side by side in the memory of two traces. Throws Error naming file,
/// trace and field where B's sampling or geometry is not A's, and when one has more traces than the other.
class PairReader {
 public:
  PairReader(Reader& a, Reader& b);
  /// The next trace of each; false after the last ones.
  bool next(Trace& a, Trace& b);

 private:
  Reader& a_;
  Reader& b_;
};

}  // namespace slipwave::segy
