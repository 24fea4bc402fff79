#include "solver/matched_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipwave::solver {
namespace {

// Chosen by measuring what 20 cells send back of P and S waves of 30 Hz under all angles: of leaks 1e-4 to
// 1e-7, powers 2 and 3 and alphas of 1/2 to 4 times pi f these were best but for the largest alpha, which
// serves the one frequency at the cost of lower ones.
/// Amplitude left of a P wave that goes straight through the layer and back.
constexpr double leak = 1e-4;
/// Growth of d into the layer.
constexpr int power = 3;
/// Plain damping of all fields beside the stretch, as a share of d. Without it plates (rock between two
/// reflecting edges or voids, which reach into the layer) grew: they carry waves whose energy runs against
/// their phase. From 0.01 on none of the media tried grew; 0.02 costs a factor of two in what comes back
/// under 60 degrees.
constexpr double plain_share = 0.02;

}  // namespace

template <int D, class Real>
MatchedLayer<D, Real>::MatchedLayer(const Layout<D>& layout, const Domain<D>& domain, double dt_s,
                                    double vp_max, double slow_hz)
    : layout_(layout) {
  for (int n = 0; n < D; ++n) {
    auto& axis = axes_[std::size_t(n)];
    axis.cells = domain.grid.shape[std::size_t(n)];
    axis.low = domain.low_zone[std::size_t(n)];
    axis.high = domain.high_zone[std::size_t(n)];
    for (std::int64_t slot = 0; slot < axis.low + axis.high; ++slot) {
      const auto width = slot < axis.low ? axis.low : axis.high;
      const auto inside = slot < axis.low ? axis.low - 1 - slot : slot - axis.low;
      const double depth = (double(inside) + 0.5) / double(width);
      const double length = double(width) * domain.grid.spacing_m;
      const double d = -(power + 1) * vp_max * std::log(leak) / (2 * length) * std::pow(depth, power);
      const double alpha = 2 * std::numbers::pi * slow_hz * (1 - depth);
      Factors factors;
      for (const int half : {0, 1}) {
        const double time = half ? dt_s / 2 : dt_s, sum = d + alpha;
        const double lost = -std::expm1(-sum * time);
        factors.kept[std::size_t(half)] = Real(std::exp(-plain_share * d * time));
        factors.of_memory[std::size_t(half)] = Real(lost / (sum * dt_s));
        factors.of_change[std::size_t(half)] = Real(d / sum * (1 - lost / (sum * time)));
        factors.left[std::size_t(half)] = Real(1 - lost);
        factors.added[std::size_t(half)] = Real(lost * d / sum * dt_s / time);
      }
      axis.factors.push_back(factors);
    }
    std::int64_t rows = FieldRows<D>::count;
    if (n > 0) rows *= axis.low + axis.high;
    for (int other = 1; other < D; ++other)
      if (other != n) rows *= layout.shape()[std::size_t(other)];
    const auto values = rows * (n == 0 ? axis.low + axis.high : layout.padded_nx());
    axis.memory = Buffer<Real>(values);
    std::fill(axis.memory.data(), axis.memory.data() + values, Real(0));
  }
}

template <int D, class Real>
bool MatchedLayer<D, Real>::covers(int axis, const Index<D>& line) const {
  const auto& layer = axes_[std::size_t(axis)];
  return axis == 0 ? layer.low + layer.high > 0 : layer.holds(line[std::size_t(axis)]);
}

template <int D, class Real>
Real* MatchedLayer<D, Real>::memory_of(int axis, const Index<D>& line, int field_row) {
  auto& layer = axes_[std::size_t(axis)];
  std::int64_t number = 0;
  for (int other = D - 1; other > 0; --other) {
    const bool own = other == axis;
    number = number * (own ? layer.low + layer.high : layout_.shape()[std::size_t(other)]) +
             (own ? layer.slot(line[std::size_t(other)]) : line[std::size_t(other)]);
  }
  const auto row = number * FieldRows<D>::count + field_row;
  return layer.memory.data() + row * (axis == 0 ? layer.low + layer.high : layout_.padded_nx());
}

template <int D, class Real>
void MatchedLayer<D, Real>::keep(int axis, const Index<D>&, std::int64_t count, const Real* row,
                                 Real* to) const {
  if (axis > 0) {
    std::copy(row, row + count, to);
    return;
  }
  const auto& layer = axes_[0];
  std::copy(row, row + layer.low, to);
  std::copy(row + layer.cells - layer.high, row + layer.cells, to + layer.low);
}

template <int D, class Real>
void MatchedLayer<D, Real>::stretch(int axis, const Index<D>& line, int field_row, std::int64_t count,
                                    Real scale, const Real* before, Real* row, bool remember) {
  const auto& layer = axes_[std::size_t(axis)];
  const std::size_t half = scale < Real(0.75);
  Real* const memory = memory_of(axis, line, field_row);
  const auto one = [&](const Factors& factors, Real was, Real& now, Real& phi) {
    const Real change = now - was;
    now -= factors.of_memory[half] * phi + factors.of_change[half] * change;
    now *= factors.kept[half];
    if (remember) phi = factors.left[half] * phi + factors.added[half] * change;
  };
  if (axis > 0) {
    const auto& factors = layer.factors[std::size_t(layer.slot(line[std::size_t(axis)]))];
    for (std::int64_t i = 0; i < count; ++i) one(factors, before[i], row[i], memory[line[0] + i]);
    return;
  }
  for (std::int64_t i = 0; i < layer.low; ++i)
    one(layer.factors[std::size_t(i)], before[i], row[i], memory[i]);
  Real* const high = row + layer.cells - layer.high - layer.low;
  for (std::int64_t i = layer.low; i < layer.low + layer.high; ++i)
    one(layer.factors[std::size_t(i)], before[i], high[i], memory[i]);
}

template <int D, class Real>
std::int64_t MatchedLayer<D, Real>::memory_bytes() const {
  std::int64_t values = 0;
  for (const auto& axis : axes_) values += axis.memory.size();
  return values * std::int64_t(sizeof(Real));
}

template class MatchedLayer<2, float>;
template class MatchedLayer<2, double>;

}  // namespace slipwave::solver
