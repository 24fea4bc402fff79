// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "accuracy/full_space.hpp"
#include "scene/splitting.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

using Rock = UniformMedium;

inline Medium<2> uniform_medium(std::int64_t nx, std::int64_t nz, double spacing_m, const Rock& rock) {
  const Grid<2> grid{{nx, nz}, spacing_m, {0, 0}};
  return {Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)), Field<2>(grid, float(rock.rho))};
}

inline void put(Medium<2>& medium, const Index<2>& cell, const Rock& rock) {
  medium.vp(cell) = float(rock.vp);
  medium.vs(cell) = float(rock.vs);
  medium.rho(cell) = float(rock.rho);
}

inline EdgeLaws<2> edges_all(EdgeLaw law) {
  EdgeLaws<2> edges;
  for (int axis = 0; axis < 2; ++axis) edges[axis] = {law, law};
  return edges;
}

/// A wave field and its sweeps, without sources, receivers or zones: fields are set and read cell by cell.
template <class Real>
class Lab {
 public:
  enum Row { vx, vz, sxx, szz, sxz };

  /// With `split` faces between cells.
  Lab(const Medium<2>& medium, const EdgeLaws<2>& edges, int order, double dt_s, int time_order = 2,
      std::vector<SplitFace<2>> split = {})
      : medium_(medium),
        domain_(domain_with(make_domain(medium_, edges, 1, {}, order), std::move(split))),
        state_(std::make_unique<State<2, Real>>(
            make_state<2, Real>(domain_.grid.shape, domain_.material_kind()))),
        sweeps_(std::make_unique<Sweeps<2, Real>>(*state_, domain_, order)),
        splitting_(splitting(2, time_order)) {
    fill_material(*state_, domain_, medium_, dt_s);
    sweeps_->split_faces(domain_, dt_s, 1);
  }
  Real& operator()(Row row, std::int64_t i, std::int64_t k) { return state_->field_row({0, k}, row)[i]; }
  const Grid<2>& grid() const { return domain_.grid; }
  State<2, Real>& state() { return *state_; }
  const Domain<2>& domain() const { return domain_; }
  SplitFaces<2, Real>* split() { return sweeps_->split(); }
  double energy() const { return solver::energy(*state_, domain_, medium_); }

  void keep_monotone() { sweeps_->keep_monotone(); }
  void sweep(int axis, double part) { sweeps_->along(axis, Real(part)); }
  /// The step of (E3) or (E16).
  void step() {
    for (const auto& [axis, part] : splitting_) sweep(axis, part);
  }
  /// Many of them, neighbouring sweeps along x made one.
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
  static Domain<2> domain_with(Domain<2> domain, std::vector<SplitFace<2>> split) {
    for (auto& face : split) face.behind = domain.computed_cell(face.behind);
    domain.split = std::move(split);
    return domain;
  }
  Medium<2> medium_;
  Domain<2> domain_;
  std::unique_ptr<State<2, Real>> state_;  // the sweeps keep a reference
  std::unique_ptr<Sweeps<2, Real>> sweeps_;
  std::vector<SweepFraction> splitting_;
};

/// Of an error that falls from `coarse` to `fine` as the spacing falls to half.
inline double observed_order(double coarse, double fine) { return std::log2(coarse / fine); }

/// sqrt(sum of squared differences / sum of squares of `exact`).
inline double relative_error(const std::vector<double>& found, const std::vector<double>& exact) {
  double difference = 0, size = 0;
  for (std::size_t n = 0; n < exact.size(); ++n) {
    difference += (found[n] - exact[n]) * (found[n] - exact[n]);
    size += exact[n] * exact[n];
  }
  return std::sqrt(difference / size);
}

}  // namespace slipwave::solver
