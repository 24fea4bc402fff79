#include "solver/absorbing.hpp"

#include <numeric>

#include "base/parallel.hpp"

namespace slipwave::solver {

template <int D, class Real>
AbsorbingZones<D, Real>::AbsorbingZones(State<D, Real>& state, const Domain<D>& domain, double dt_s,
                                        double vp_max, Background<D, Real>* background)
    : state_(state), domain_(domain), background_(background) {
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
std::int64_t AbsorbingZones<D, Real>::cells() const {
  return domain_.grid.size() - domain_.model_grid.size();
}

/// Cells of one line that share the zone and factor of an axis other than x.
template <int D, class Real>
void AbsorbingZones<D, Real>::damp(int axis, int side, const Index<D>& line, std::int64_t x_first,
                                   std::int64_t count, Real factor) {
  constexpr std::int64_t piece = 64;
  Real target[piece] = {};
  for (int row = 0; row < FieldRows<D>::count; ++row) {
    Real* u = state_.field_row(line, row) + x_first;
    for (std::int64_t done = 0; done < count; done += piece) {
      const std::int64_t n = std::min(piece, count - done);
      if (background_) background_->values(axis, side, line, x_first + done, n, row, target);
      const Real* along = factors_[0].data() + x_first + done;
      for (std::int64_t i = 0; i < n; ++i)
        u[done + i] = target[i] + (axis == 0 ? along[i] : factor) * (u[done + i] - target[i]);
    }
  }
}

template <int D, class Real>
void AbsorbingZones<D, Real>::run(const StepTime& time) {
  if (background_) background_->advance(time);
  const std::int64_t lines = state_.layout.lines(), nx = state_.layout.shape()[0];
  const std::int64_t low = domain_.low_zone[0], high = domain_.high_zone[0];
  parallel_for(lines, 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t number = begin; number < end; ++number) {
      const Index<D> line = state_.layout.line_index(number);
      for (int axis = 1; axis < D; ++axis) {
        const Real factor = factors_[std::size_t(axis)][std::size_t(line[std::size_t(axis)])];
        const int side = line[std::size_t(axis)] < domain_.low_zone[std::size_t(axis)] ? 0 : 1;
        if (factor < 1) damp(axis, side, line, 0, nx, factor);
      }
      if (low > 0) damp(0, 0, line, 0, low, 1);
      if (high > 0) damp(0, 1, line, nx - high, high, 1);
    }
  });
}

template class AbsorbingZones<2, float>;
template class AbsorbingZones<2, double>;

}  // namespace slipwave::solver
