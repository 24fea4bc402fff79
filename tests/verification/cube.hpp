// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <random>

#include "accuracy/full_space.hpp"
#include "lab.hpp"
#include "samples.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

inline EdgeLaws<3> edges_all_3d(EdgeLaw law) {
  EdgeLaws<3> edges;
  for (int axis = 0; axis < 3; ++axis) edges[axis] = {law, law};
  return edges;
}

/// One rock, the low corner of the grid at `origin_m`.
inline Medium<3> uniform_cube(const Index<3>& shape, double spacing_m, const Rock& rock,
                              const Point<3>& origin_m = {}) {
  const Grid<3> grid{shape, spacing_m, origin_m};
  return {Field<3>(grid, float(rock.vp)), Field<3>(grid, float(rock.vs)), Field<3>(grid, float(rock.rho))};
}

inline void put(Medium<3>& medium, const Index<3>& cell, const Rock& rock) {
  medium.vp(cell) = float(rock.vp);
  medium.vs(cell) = float(rock.vs);
  medium.rho(cell) = float(rock.rho);
}

/// Lumps of rock, of softer rock, water and void, as blocks of some cells, with streaks in single cells.
inline Medium<3> lumps(const Index<3>& shape, double spacing_m, unsigned seed) {
  auto medium = uniform_cube(shape, spacing_m, {4500, 2250, 2500});
  const Rock others[] = {{2500, 1200, 2000}, {1500, 0, 1000}, {0, 0, 0}, {5500, 3100, 2700}};
  std::mt19937 engine(seed);
  const auto one_of = [&](std::int64_t count) { return std::int64_t(engine() % unsigned(count)); };
  for (int lump = 0; lump < 24; ++lump) {
    Index<3> low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = one_of(shape[axis]);
      high[axis] = std::min(shape[axis], low[axis] + 1 + one_of(12));
    }
    const auto& rock = others[std::size_t(one_of(4))];
    for (std::int64_t k = low[2]; k < high[2]; ++k)
      for (std::int64_t j = low[1]; j < high[1]; ++j)
        for (std::int64_t i = low[0]; i < high[0]; ++i) put(medium, {i, j, k}, rock);
  }
  return medium;
}

/// A wave field in 3-D and its sweeps, without sources, receivers or zones.
template <class Real>
class Cube {
 public:
  using Rows = FieldRows<3>;
  Cube(const Medium<3>& medium, const EdgeLaws<3>& edges, int order, double dt_s, int time_order = 2)
      : medium_(medium),
        domain_(make_domain(medium_, edges, 1, {}, order)),
        state_(std::make_unique<State<3, Real>>(
            make_state<3, Real>(domain_.grid.shape, domain_.material_kind()))),
        sweeps_(*state_, domain_, order),
        splitting_(splitting(3, time_order)) {
    fill_material(*state_, domain_, medium_, dt_s);
  }
  Real& operator()(int row, const Index<3>& at) { return state_->field_row({0, at[1], at[2]}, row)[at[0]]; }
  const Grid<3>& grid() const { return domain_.grid; }
  State<3, Real>& state() { return *state_; }
  Sweeps<3, Real>& sweeps() { return sweeps_; }
  double energy() const { return solver::energy(*state_, domain_, medium_); }
  /// Random values in all cells that carry them: velocities up to 1 m/s, stresses such as belong to them.
  void shake(unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> random(-1, 1);
    for (std::int64_t n = 0; n < grid().size(); ++n) {
      const auto at = grid().index(n);
      const auto cell = std::size_t(n);
      const bool solid = medium_.is_solid(cell), empty = medium_.is_void(cell);
      const double z = medium_.rho[cell] * medium_.vp[cell], pressure = z * random(engine);
      for (int row = 0; row < Rows::count; ++row) {
        const double value = random(engine);
        if (!Rows::is_stored(state_->layout, row)) continue;
        const bool normal = row >= 3 && row < 6;
        (*this)(row, at) = Real(empty ? 0 : row < 3 ? value : solid ? z * value : normal ? pressure : 0);
      }
    }
  }
  void sweep(int axis, double part) { sweeps_.along(axis, Real(part)); }
  /// Many steps, neighbouring sweeps along x made one.
  void steps(std::int64_t count) {
    if (count == 0) return;
    const double end = splitting_.front().fraction;
    sweep(0, end);
    for (std::int64_t n = 0; n < count; ++n) {
      for (std::size_t inner = 1; inner + 1 < splitting_.size(); ++inner)
        sweep(splitting_[inner].axis, splitting_[inner].fraction);
      sweep(0, n + 1 < count ? 2 * end : end);
    }
  }

 private:
  Medium<3> medium_;
  Domain<3> domain_;
  std::unique_ptr<State<3, Real>> state_;  // the sweeps keep a reference
  Sweeps<3, Real> sweeps_;
  std::vector<SweepFraction> splitting_;
};

}  // namespace slipwave::solver
