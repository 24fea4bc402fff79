#include "solver/effect/sponge.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace slipwave::solver {

template <int D, class Real>
Sponge<D, Real>::Sponge(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max,
                        std::unique_ptr<IncidentWave<D, Real>> incident)
    : layout_(layout), domain_(domain), incident_(std::move(incident)), kernels_(sponge_kernels<Real>()) {
  for (int axis = 0; axis < D; ++axis) {
    const auto factors = zone_factors(domain, axis, dt_s, vp_max);
    factors_[std::size_t(axis)].assign(factors.begin(), factors.end());
  }
  if (incident_ && incident_->needs_whole_step()) {
    rows_.resize(std::size_t(layout.lines()));
    std::iota(rows_.begin(), rows_.end(), 0);
  }
}

template <int D, class Real>
bool Sponge<D, Real>::initialize(State<D, Real>& state) {
  if (incident_) incident_->begin(state);
  return incident_ != nullptr;
}

/// Cells of one row that share the zone and, of an axis other than x, the factor.
template <int D, class Real>
void Sponge<D, Real>::damp(const StepTime& time, int axis, int side, const RowFields<Real>& fields,
                           const IndexRange& cells, Real factor) {
  constexpr std::int64_t piece = 128;
  constexpr int rows = FieldRows<D>::count;
  const auto row = layout_.line_index(fields.row);
  const Real nothing[rows] = {};
  Real room[piece * rows];
  for (std::int64_t first = cells.first; first < cells.last; first += piece) {
    const std::int64_t n = std::min(piece, cells.last - first);
    IncidentValues<Real> target{nothing, 1, false};
    if (incident_) target = incident_->values(time, axis, side, row, first, n, room);
    const auto loop = kernels_.damp[axis == 0][target.by_cell];
    const Real* const factors = axis == 0 ? factors_[0].data() + first : &factor;
    for (int field = 0; field < rows; ++field)
      loop(n, factors, target.values + field * target.pitch, fields.field(field) + first);
  }
}

template <int D, class Real>
void Sponge<D, Real>::apply(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells) {
  const std::int64_t nx = layout_.shape()[0], low = domain_.low_zone[0], high = domain_.high_zone[0];
  const Index<D> row = layout_.line_index(fields.row);
  for (int axis = 1; axis < D; ++axis) {
    const Real factor = factors_[std::size_t(axis)][std::size_t(row[std::size_t(axis)])];
    const int side = row[std::size_t(axis)] < domain_.low_zone[std::size_t(axis)] ? 0 : 1;
    if (factor < 1) damp(time, axis, side, fields, cells, factor);
  }
  damp(time, 0, 0, fields, {cells.first, std::min(cells.last, low)}, 1);
  damp(time, 0, 1, fields, {std::max(cells.first, nx - high), cells.last}, 1);
}

template class Sponge<2, float>;
template class Sponge<2, double>;

}  // namespace slipwave::solver
