#include "solver/effect/sponge.hpp"

#include <algorithm>
#include <numeric>

namespace slipwave::solver {

template <int D, class Real>
Sponge<D, Real>::Sponge(State<D, Real>& state, const Domain<D>& domain, double dt_s, double vp_max,
                        IncidentWave<D, Real>* background)
    : state_(state), domain_(domain), background_(background), kernels_(sponge_kernels<Real>()) {
  for (int axis = 0; axis < D; ++axis) {
    const auto factors = zone_factors(domain, axis, dt_s, vp_max);
    factors_[std::size_t(axis)].assign(factors.begin(), factors.end());
  }
  if (background && background->needs_whole_step()) {
    lines_.resize(std::size_t(state.layout.lines()));
    std::iota(lines_.begin(), lines_.end(), 0);
  }
}

template <int D, class Real>
std::int64_t Sponge<D, Real>::cells() const {
  return domain_.grid.size() - domain_.model_grid.size();
}

/// Cells of one line that share the zone and, of an axis other than x, the factor.
template <int D, class Real>
void Sponge<D, Real>::damp(const StepTime& time, int axis, int side, const Index<D>& line,
                           const IndexRange& columns, Real factor) {
  constexpr std::int64_t piece = 128;
  constexpr int rows = FieldRows<D>::count;
  const Real nothing[rows] = {};
  Real room[piece * rows];
  for (std::int64_t first = columns.first; first < columns.last; first += piece) {
    const std::int64_t n = std::min(piece, columns.last - first);
    IncidentValues<Real> target{nothing, 1, false};
    if (background_) target = background_->values(time, axis, side, line, first, n, room);
    const auto loop = kernels_.damp[axis == 0][target.by_cell];
    const Real* const factors = axis == 0 ? factors_[0].data() + first : &factor;
    for (int row = 0; row < rows; ++row)
      loop(n, factors, target.values + row * target.pitch, state_.field_row(line, row) + first);
  }
}

template <int D, class Real>
void Sponge<D, Real>::run(const StepTime& time, std::int64_t number, const IndexRange& columns) {
  const std::int64_t nx = state_.layout.shape()[0], low = domain_.low_zone[0], high = domain_.high_zone[0];
  const Index<D> line = state_.layout.line_index(number);
  for (int axis = 1; axis < D; ++axis) {
    const Real factor = factors_[std::size_t(axis)][std::size_t(line[std::size_t(axis)])];
    const int side = line[std::size_t(axis)] < domain_.low_zone[std::size_t(axis)] ? 0 : 1;
    if (factor < 1) damp(time, axis, side, line, columns, factor);
  }
  damp(time, 0, 0, line, {columns.first, std::min(columns.last, low)}, 1);
  damp(time, 0, 1, line, {std::max(columns.first, nx - high), columns.last}, 1);
}

template class Sponge<2, float>;
template class Sponge<2, double>;

}  // namespace slipwave::solver
