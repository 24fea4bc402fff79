// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/faces_in_space.hpp"
#include "solver/sweep/tilted_cells.hpp"

namespace slipwave::solver {

/// Cells in 3-D whose axes of symmetry are turned from those of the grid (theory/anisotropy.md). The loops of
/// a sweep take them for orthorhombic ones along it; then this overwrites their outgoing waves, the states of
/// their faces, and adds to their stresses what is missing. Cells of a medium share what is known of it. In
/// bent rows, whose loops take cells for isotropic ones, these are all anisotropic cells, in sweeps along the
/// rows.
template <class Real>
class TiltedCells<3, Real> {
 public:
  TiltedCells() = default;
  /// `stencils` by axis and pair, at the order that reaches `reach` cells.
  TiltedCells(const Domain<3>& domain, int reach,
              const std::array<std::array<InterfaceStencils, 3>, 3>& stencils);

  bool empty() const { return cells_.empty(); }
  /// Whether a row holds any in these columns.
  bool any(std::int64_t row, const IndexRange& columns) const;

  using PairFields = TiltedPairFields<Real>;
  using Pairs = std::array<PairFields, 3>;
  /// Outgoing waves of the cells of these columns of a row, from the fields of all pairs; `b` is dt/(rho h)
  /// of the first of them. `metric`: of a bent row, the pairs are then (v, J s).
  void reconstruct(int axis, std::int64_t row, const IndexRange& columns, const Kernels<Real>& kernels,
                   std::int64_t stride, const Pairs& pairs, const Real* b, Real scale,
                   OutgoingWaves<Real> outgoing, const BentAlong<Real>* metric = nullptr) const;
  /// The rows of cells before and behind faces; none beyond the grid. The cell before a face stands `shift`
  /// columns before that behind it.
  struct Sides {
    std::int64_t lo, hi, shift;
  };
  static constexpr std::int64_t none = -1;
  /// States of the faces before the cells of these columns, between the outgoing waves of the cells before
  /// (`below`) and behind them; of a bent row with half of J of the faces.
  void solve(int axis, const Sides& sides, const IndexRange& columns, OutgoingWaves<Real> below,
             OutgoingWaves<Real> above, const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
             InterfaceStates<Real> faces, const Real* half_face = nullptr) const;
  /// Adds to the stresses of these columns, advanced as orthorhombic ones; `size` is that of the fraction of
  /// the step, `shear` the shear stress that no pair of the sweep has.
  void add_stress(int axis, std::int64_t row, const IndexRange& columns, Real size, const Real* b,
                  InterfaceStates<Real> lo, InterfaceStates<Real> hi, const SweptRows<Real>& rows,
                  Real* shear) const;
  /// The same of a bent row, advanced as isotropic ones.
  void add_bent_stress(int axis, std::int64_t row, const IndexRange& columns, Real size, const Real* b,
                       InterfaceStates<Real> lo, InterfaceStates<Real> hi, const SweptRows<Real>& rows,
                       Real* shear) const;

  std::int64_t memory_bytes() const;

 private:
  /// Cells whose values are expanded at once.
  static constexpr std::int64_t at_once = 64;
  struct Cell {
    std::int32_t x, medium;
  };
  static constexpr std::size_t motions = 9, impedances = 3, stresses = 13, bent_stresses = 18;
  /// Of a medium in sweeps along an axis; components are those of the pairs.
  struct OfAxis {
    std::array<Real, impedances + motions> waves;  // impedances, then the motion of each wave
    std::array<Real, symmetric> impedance;         // as a matrix
    std::array<Real, stresses> missing;            // stiffnesses times the density
    std::array<Real, bent_stresses> missing_in_bent;
  };
  struct Medium {
    std::array<OfAxis, 3> along;
  };
  /// A cell whose stencils end at interfaces or edges, by its number.
  struct Ending {
    std::int64_t cell;
    int reach;  // of the reconstruction
    std::array<InterfaceStencil, 3> stencils;
  };
  /// Values of a run of cells, one row each.
  template <std::size_t Count>
  struct Expanded {
    Real values[Count][at_once];
    std::int64_t filled = 0;
    std::int32_t of = -1;
  };
  static OfAxis of_axis(const TiltedMediumInSpace& medium, int axis);
  IndexRange cells_of(std::int64_t row, const IndexRange& columns) const;
  /// The first number behind cells that follow each other from `first` on, at most `last`.
  std::int64_t end_of_run(std::int64_t first, std::int64_t last) const;
  template <std::size_t Count>
  void expand(std::int64_t first, std::int64_t count, int axis, const std::array<Real, Count> OfAxis::*values,
              Expanded<Count>& to) const;
  void add_endings(const Domain<3>& domain, int axis, int reach,
                   const std::array<InterfaceStencils, 3>& stencils);
  void reconstruct_run(int axis, const IndexRange& run, const Kernels<Real>& kernels, std::int64_t stride,
                       std::int64_t at, const Pairs& pairs, const Real* b, Real scale,
                       OutgoingWaves<Real> outgoing) const;
  void reconstruct_bent_run(int axis, const IndexRange& run, const Kernels<Real>& kernels,
                            std::int64_t stride, std::int64_t at, const Pairs& pairs, const Real* b,
                            Real scale, const BentAlong<Real>& metric, OutgoingWaves<Real> outgoing) const;
  template <int Order>
  void reconstruct_ending(int axis, const Ending& ending, std::int64_t stride, std::int64_t at,
                          const Pairs& pairs, Real b, Real scale, const BentAlong<Real>* metric,
                          OutgoingWaves<Real> outgoing) const;
  /// Impedances beside a run of faces, from column `from` on: those of cells where there are some, else of
  /// the material.
  void impedances_beside(int axis, std::int64_t row, const IndexRange& columns,
                         const MaterialRows<Real>& material, std::int64_t from,
                         Expanded<symmetric>& to) const;

  int reach_ = 0;
  std::vector<Cell> cells_;                // by row, then x
  std::vector<std::int64_t> first_cells_;  // of each row, and the end
  std::vector<Medium> media_;
  std::array<std::vector<Ending>, 3> endings_;
};

}  // namespace slipwave::solver
