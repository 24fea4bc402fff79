#pragma once

#include "solver/sweep/sweep_filter.hpp"

namespace slipwave::solver {

/// Reads the fields at the end of time steps and changes nothing.
template <int D, class Real>
class Record {
 public:
  virtual ~Record() = default;
  /// Whether it reads anything of a row at the end of that step.
  virtual bool reads(const StepTime& time, std::int64_t row) const = 0;
  /// All that it ever reads, on all ranks: rows of the last axis and columns of the one before it.
  virtual Box box() const = 0;
  /// Reads what it needs of these cells of a row. Rows may be some steps apart, as for effects.
  virtual void read(const StepTime& time, const RowFields<const Real>& fields, const IndexRange& cells) = 0;
  /// Step after step, once all rows have been read.
  virtual void finish(const StepTime&) {}
};

}  // namespace slipwave::solver
