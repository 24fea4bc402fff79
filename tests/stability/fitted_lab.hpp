// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fitted_medium.hpp"
#include "lab.hpp"
#include "rock/coefficients.hpp"

namespace slipwave {

/// The largest Courant number at which the PML matches the steps (theory.md (E14d)).
constexpr double matched_cfl = 0.9;

/// How a medium is shaken.
struct Numbers {
  int order = 5, time_order = 2;
  double cfl = 1;
  int zone_cells = 8;
  double pml_hz = 0;  // 0: sponge
  unsigned seed = 1;
};

/// A random wave field on a fitted grid that evolves freely.
template <int D, class Real>
class FittedLab {
 public:
  FittedLab(const Medium<D>& medium, const EdgeLaws<D>& edges, const Numbers& numbers)
      : medium_(medium),
        dt_s_(numbers.cfl * medium_.grid().spacing_m / fastest_across_cells(medium_)),
        domain_(domain_of(medium_, edges, numbers, dt_s_)),
        state_(solver::make_filled_state<D, Real>(domain_, medium_, dt_s_)),
        sweeps_(state_, domain_, numbers.order),
        splitting_(splitting(D, numbers.time_order)) {
    const double fastest = fastest_speed(medium_);
    if (domain_.grid.size() == domain_.model_grid.size()) {
    } else if (numbers.pml_hz > 0) {
      pml_ = std::make_unique<solver::Pml<D, Real>>(state_.layout, domain_, dt_s_, fastest, numbers.pml_hz,
                                                    numbers.time_order);
      sweeps_.use(pml_.get());
    } else if constexpr (D == 2) {
      sponge_ = std::make_unique<Sponge<D, Real>>(domain_, dt_s_, fastest);
    }
    shake(numbers.seed);
  }

  void step() {
    for (std::size_t k = 0; k < splitting_.size(); ++k)
      sweeps_.along(splitting_[k].axis, Real(splitting_[k].fraction), {0, k});
    if (sponge_) sponge_->damp(state_);
  }

  /// With the sponge, whose cells it counts too; without it that of solver::energy().
  double energy() const {
    if (!sponge_) return solver::energy(state_, domain_, medium_);
    double total = 0;
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const double counted = medium_.grid().height(domain_.model_cell(at));
      total += solver::energy_of_cell(state_, domain_, medium_, at) / counted * height(at);
    }
    return total;
  }

 private:
  static solver::Domain<D> domain_of(const Medium<D>& medium, const EdgeLaws<D>& edges,
                                     const Numbers& numbers, double dt_s) {
    Numerics numerics;
    numerics.time_order = numbers.time_order;
    auto domain = solver::make_domain(medium, edges, numbers.zone_cells, {}, numbers.order,
                                      largest_cfl(numerics) / numbers.cfl);
    domain.steps = {&medium, dt_s, numbers.time_order};
    return domain;
  }
  /// Of a cell of the computed grid, in m: the mean over its corners.
  double height(const Index<D>& at) const {
    double sum = 0;
    for (int n = 0; n < 1 << D; ++n) {
      auto corner = at;
      for (int axis = 0; axis < D; ++axis) corner[std::size_t(axis)] += (n >> axis) & 1;
      sum += ((n >> (D - 1)) & 1 ? 1 : -1) * solver::corner_depth(domain_, corner);
    }
    return sum / (1 << (D - 1)) * domain_.grid.spacing_m;
  }

  void shake(unsigned seed) {
    using Rows = solver::FieldRows<D>;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const auto cell = std::size_t(medium_.grid().flat(domain_.model_cell(at)));
      const bool in_model = domain_.in_model(at);
      if (medium_.is_void(cell) || (pml_ && !in_model)) continue;
      const bool solid = medium_.is_solid(cell);
      const double z = double(medium_.rho[cell]) * medium_.vp[cell], pressure = z * uniform(engine);
      for (int row = 0; row < Rows::count; ++row) {
        double value = uniform(engine);
        if (!Rows::is_stored(state_.layout, row)) continue;
        if (row >= D && row < 2 * D)
          value = solid ? z * value : pressure;
        else if (row >= 2 * D)
          value = solid ? 0.3 * z * value : 0;
        auto line = at;
        line[0] = 0;
        state_.field_row(line, row)[at[0]] = Real(value);
      }
    }
  }

  Medium<D> medium_;
  double dt_s_;
  solver::Domain<D> domain_;
  solver::State<D, Real> state_;
  solver::Sweeps<D, Real> sweeps_;
  std::unique_ptr<solver::Pml<D, Real>> pml_;
  std::unique_ptr<Sponge<D, Real>> sponge_;
  std::vector<SweepFraction> splitting_;
};

/// Edges of another law at the top.
inline EdgeLaws<2> edges_below(EdgeLaw top, EdgeLaw others) {
  auto edges = all_edges(others);
  edges[1][0] = top;
  return edges;
}

/// What is known to hold of a regular grid; the long form continues for `long_run` steps.
template <class Real, int D>
void expect_no_growth(const Medium<D>& medium, const EdgeLaws<D>& edges, const Numbers& numbers, int steps,
                      int long_run) {
  SCOPED_TRACE("order " + std::to_string(numbers.order) + ", " + std::to_string(numbers.time_order) +
               " in time, cfl " + std::to_string(numbers.cfl) + ", top " +
               std::to_string(int(edges[D - 1][0])) + ", sides " + std::to_string(int(edges[0][0])) +
               (sizeof(Real) == 4 ? ", float" : ", double"));
  FittedLab<D, Real> lab(medium, edges, numbers);
  expect_no_growth(lab, steps, rounding<Real>(), 10);
  if (long_form()) expect_fall_in_the_long_run(lab, long_run, rounding<Real>(), gain_of_interfaces);
}

}  // namespace slipwave
