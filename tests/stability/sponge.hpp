// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/sweep/domain.hpp"

namespace slipwave {

/// Damps all fields of the zones outside absorbing edges alike, the more the further out. That preserves the
/// impedance and takes energy only: what grows then grows in the sweeps or at the edge behind the zone.
template <int D, class Real>
class Sponge {
 public:
  /// Keeps a reference to the domain.
  Sponge(const solver::Domain<D>& domain, double dt_s, double vp_max) : domain_(domain) {
    for (int axis = 0; axis < D; ++axis) factors_.push_back(factors_of(axis, dt_s, vp_max));
  }
  void damp(solver::State<D, Real>& state) const {
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      auto at = domain_.grid.index(n);
      double factor = 1;
      for (int axis = 0; axis < D; ++axis)
        factor *= factors_[std::size_t(axis)][std::size_t(at[std::size_t(axis)])];
      const auto x = at[0];
      at[0] = 0;
      for (int row = 0; row < state.layout.rows() && factor < 1; ++row)
        state.field_row(at, row)[x] = Real(factor * double(state.field_row(at, row)[x]));
    }
  }

 private:
  /// Of each cell along an axis, over one step.
  std::vector<double> factors_of(int axis, double dt_s, double vp_max) const {
    constexpr double leak = 0.2, power = 2.5;
    constexpr std::int64_t still = max_reach;
    std::vector<double> factors(std::size_t(domain_.grid.shape[std::size_t(axis)]), 1.);
    for (const int side : {0, 1}) {
      const auto width = side ? domain_.high_zone[std::size_t(axis)] : domain_.low_zone[std::size_t(axis)];
      const double strongest =
          -(power + 1) * vp_max * std::log(leak) / (2 * double(width) * domain_.grid.spacing_m);
      for (std::int64_t j = 0; j < width; ++j) {
        const double depth = (double(j) + 0.5) / double(width);
        const auto cell = side ? std::int64_t(factors.size()) - width + j : width - 1 - j;
        factors[std::size_t(cell)] =
            width - j <= still ? 0 : std::exp(-strongest * std::pow(depth, power) * dt_s);
      }
    }
    return factors;
  }
  const solver::Domain<D>& domain_;
  std::vector<std::vector<double>> factors_;  // [axis][cell]
};

}  // namespace slipwave
