// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/bent_waves.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/state.hpp"
#include "solver/sweep/tilted_cells.hpp"

namespace slipwave::solver {

/// Anisotropic cells of bent rows in 2-D (theory/anisotropy.md), upright rock and tilted. As TiltedCells in
/// level rows: the loops of bent rows take them for isotropic ones; then this overwrites their outgoing
/// waves, the states of their faces, and adds to their stresses what is missing.
template <class Real>
class BentTiltedCells {
 public:
  BentTiltedCells() = default;
  /// `along_x`: stencils of sweeps along x by wave, at the order that reaches `reach` cells.
  BentTiltedCells(const State<2, Real>& state, const Domain<2>& domain, const Metric<2, Real>& metric,
                  int reach, const std::array<InterfaceStencils, 2>& along_x);

  bool empty() const { return cells_.x.empty(); }
  /// The pairs of a sweep along x, their metric, and dt/(rho h), from a column of a row on.
  struct Along {
    std::array<TiltedPairFields<Real>, 2> pairs;
    BentAlong<Real> metric;
    const Real* b;
  };
  /// Outgoing waves of the cells of these columns of a row; all pointers begin with the first of them.
  void reconstruct_along(std::int64_t row, const IndexRange& columns, const Kernels<Real>& kernels,
                         const Along& from, Real scale, OutgoingWaves<Real> outgoing) const;
  void reconstruct_across(std::int64_t row, const IndexRange& columns, const Kernels<Real>& kernels,
                          const BentFields<const Real>& fields, const BentAcross<Real>& metric, const Real* b,
                          Real scale, OutgoingWaves<Real> outgoing) const;
  /// States of the faces before the cells of these columns.
  void solve_along(std::int64_t row, const IndexRange& columns, OutgoingWaves<Real> below,
                   OutgoingWaves<Real> above, const Real* half_face, InterfaceStates<Real> faces) const;
  /// Of the faces before this row; `fluid`: the cells above them see velocities of their own.
  void solve_across(std::int64_t row, const IndexRange& columns, const BentSolve<Real>& at, Real sign,
                    bool fluid) const;
  /// Adds to the stresses of these columns; `size` is that of the fraction of the step.
  void add_stress_along(std::int64_t row, const IndexRange& columns, Real size, InterfaceStates<Real> lo,
                        InterfaceStates<Real> hi, const SweptRows<Real>& rows) const;
  void add_stress_across(std::int64_t row, const IndexRange& columns, Real size,
                         const BentUpdate<Real>& of) const;

  std::int64_t memory_bytes() const;

 private:
  static constexpr std::int32_t none = -1;
  using Values = std::vector<Real>;
  /// Cells, or faces before them, by row and then x.
  struct Places {
    std::vector<std::int32_t> x;
    std::vector<std::int64_t> first;  // of each row, and the end
    IndexRange in(std::int64_t row, const IndexRange& columns) const;
    /// The first number behind places that follow each other from `begin` on, at most `end`.
    std::int64_t end_of_run(std::int64_t begin, std::int64_t end) const;
  };
  /// A cell whose stencils along x end at interfaces or edges.
  struct Ending {
    int reach;
    std::array<InterfaceStencil, 2> stencils;
  };
  /// Symmetric matrices of the impedances on both sides of faces, and whether tractions follow from the lower
  /// one: fluid and void bear none along a face.
  struct Faces : Places {
    std::array<std::array<Values, 3>, 2> z;  // [side][along, mixed, across]
    Values by_lower;
  };
  void add_cell(const State<2, Real>& state, const Domain<2>& domain, const Metric<2, Real>& metric,
                const TiltedMedium& tilted, const std::array<InterfaceStencils, 2>& along_x);
  void add_faces(const Domain<2>& domain, const Metric<2, Real>& metric, int axis);
  void solve(const Faces& faces, std::int64_t first, std::int64_t count, const Real* up_p, const Real* up_s,
             const Real* down_p, const Real* down_s, const Real* over, std::array<Real*, 4> to) const;
  template <int Order>
  void reconstruct_ending(std::size_t n, const Along& from, std::int64_t at, Real scale,
                          OutgoingWaves<Real> outgoing) const;

  int reach_ = 0;
  Places cells_;
  std::array<Values, 2> motion_along_;  // of the faster wave along x: its components along x, and z
  std::array<Values, 2> z_along_;       // impedances of both waves
  std::array<std::array<Values, 4>, 2> of_faces_;  // across the rows: BentWaves::Face, before and behind
  std::array<Values, 2> courant_z_;
  std::array<Values, 6> more_;        // C11, C13, C15, C33, C35, C55 times dt/h, less those of the loops
  std::vector<std::int32_t> ending_;  // its place among endings_, or `none`
  std::vector<Ending> endings_;
  Faces along_, across_;
};

}  // namespace slipwave::solver
