// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/bent_waves_in_space.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/metric.hpp"

namespace slipwave::solver {

/// Anisotropic cells of bent rows in sweeps across the rows in 3-D (theory/anisotropy.md), upright rock and
/// tilted; along the rows TiltedCells has them. The loops take them for isotropic ones; then this overwrites
/// their outgoing waves, the states of their faces, and adds to their stresses what is missing.
template <class Real>
class BentTiltedCellsInSpace {
 public:
  BentTiltedCellsInSpace() = default;
  BentTiltedCellsInSpace(const Domain<3>& domain, const Metric<3, Real>& metric, int reach);

  bool empty() const { return cells_.empty(); }
  /// Outgoing waves of the cells of these columns of a line; all pointers begin with the first of them.
  void reconstruct_across(std::int64_t line, const IndexRange& columns, const Kernels<Real>& kernels,
                          const BentFields<const Real>& fields, const BentAcross<Real>& metric, const Real* b,
                          Real scale, OutgoingWaves<Real> outgoing) const;
  /// States of the faces between two lines, -1 beyond the grid; `fluid`: the cells above them see velocities
  /// of their own.
  void solve_across(std::int64_t lo, std::int64_t hi, const IndexRange& columns, const BentSolve<Real>& at,
                    Real sign, bool fluid) const;
  /// Adds to the stresses of these columns; `size` is that of the fraction of the step.
  void add_stress_across(std::int64_t line, const IndexRange& columns, Real size,
                         const BentUpdate<Real>& of) const;

  std::int64_t memory_bytes() const;

 private:
  static constexpr std::int64_t at_once = 64;
  /// Rows of values of the cells of a line: of the faces before and behind them the impedances of the waves
  /// and their motions, then courant_z (BentWavesInSpace).
  static constexpr std::size_t of_face = 12, values = 2 * of_face + 3;
  static constexpr std::size_t stiffnesses = 21;
  struct Cell {
    std::int32_t x, medium;
  };
  struct Medium {
    std::array<Real, stiffnesses> more;  // times the density, less those of the loops
  };
  IndexRange cells_of(std::int64_t line, const IndexRange& columns) const;
  std::int64_t end_of_run(std::int64_t first, std::int64_t last) const;
  /// The values of a line from one of its cells on, a pitch apart.
  struct Rows {
    const Real* first;
    std::int64_t pitch;
    const Real* operator[](std::size_t n) const { return first + std::int64_t(n) * pitch; }
  };
  Rows rows_of(std::int64_t line, std::int64_t cell) const;
  /// Of a wave's pair [v, s], by component of velocity, then of traction.
  static constexpr std::size_t components = 6;
  struct Weights {
    Real of[2][components][at_once];
  };
  static void find_weights(const Rows& rows, std::int64_t n, Real sign, Weights (&weights)[3]);
  void fill(const Domain<3>& domain, const Metric<3, Real>& metric, std::int64_t line);
  /// Impedances beside a run of faces, of their lower (0) or upper side, as symmetric matrices.
  using Impedances = std::array<std::array<Real, at_once>, 6>;
  void impedances_beside(std::int64_t line, std::size_t side, const IndexRange& columns,
                         const MaterialRows<Real>& material, const BentAcross<Real>& metric,
                         std::int64_t from, const Impedances& other, Impedances& to) const;

  int reach_ = 0;
  std::vector<Cell> cells_;          // by line, then x
  std::vector<std::int64_t> first_;  // of each line, and the end
  Buffer<Real> values_;              // line after line
  std::vector<Medium> media_;
};

}  // namespace slipwave::solver
