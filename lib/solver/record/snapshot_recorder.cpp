// SPDX-License-Identifier: BSD-3-Clause
#include "solver/record/snapshot_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

template <int D, class Real>
bool SnapshotRecorder<D, Real>::due(const StepTime& time) const {
  if (!every_s_ || time.end_s() > duration_s_ + time.dt_s) return false;
  // The tolerance counts a step that ends on a multiple, up to rounding, as past it.
  const auto multiple = [&](double t) { return std::floor(t / *every_s_ + 1e-9); };
  return multiple(time.end_s()) > multiple(time.end_s() - time.dt_s);
}

template <int D, class Real>
bool SnapshotRecorder<D, Real>::prepare(std::int64_t first, std::int64_t last, double dt_s) {
  for (step_ = first; step_ < last; ++step_)
    if (due({step_, dt_s})) break;
  if (step_ == last) return false;
  fields_ = Buffer<Real>(layout_.total());
  return true;
}

template <int D, class Real>
void SnapshotRecorder<D, Real>::read(const StepTime& time, const RowFields<const Real>& fields,
                                     const IndexRange& cells) {
  if (time.step != step_) return;
  Real* const to = fields_.data() + layout_.line(layout_.line_index(fields.row));
  for (int row = 0; row < layout_.rows(); ++row)
    std::copy(fields.field(row) + cells.first, fields.field(row) + cells.last,
              to + row * layout_.row_pitch() + cells.first);
}

template <int D, class Real>
Field<D> SnapshotRecorder<D, Real>::field(Component component) const {
  Field<D> field(domain_.model_grid);
  const std::int64_t nx = domain_.model_grid.shape[0], lines = domain_.model_grid.size() / nx;
  const auto pitch = layout_.row_pitch();
  const auto terms = slipwave::row_of(component).terms_in(D);
  const int count = int(terms.size());
  parallel_for(lines, 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      const Index<D> first = domain_.computed_cell(domain_.model_grid.index(line * nx));
      if (!domain_.owns(first[D - 1])) continue;
      const Real* const cells = fields_.data() + layout_.cell(first);
      auto out = field.line(line);
      for (std::int64_t i = 0; i < nx; ++i) {
        double value = count == 1 ? -0. : 0.;  // a field alone keeps the sign of its zeros
        for (const auto& term : terms)
          if (const int row = row_of<D>(term.field); FieldRows<D>::is_stored(layout_, row))
            value += cells[FieldRows<D>::stored(layout_, row) * pitch + i] / Real(term.sign * count);
        out[std::size_t(i)] = float(value / unit_);
      }
    }
  });
  return field;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class SnapshotRecorder);

}  // namespace slipwave::solver
