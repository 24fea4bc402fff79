// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/row_method.hpp"
#include "solver/sweep/row_waves.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Cells whose values are expanded at once.
inline constexpr std::int64_t cells_at_once = 64;
/// A cell and its medium.
struct CellOfMedium {
  std::int32_t x, medium;
};
/// Cells and their media.
struct CellList : ByLine<CellOfMedium> {
  /// The first number behind cells that follow each other from `begin` on, at most `end`.
  std::int64_t end_of_run(std::int64_t begin, std::int64_t end) const;
  /// Calls what(run) for numbers of cells of a line in these columns that follow each other, a few at once,
  /// if so wanted of one medium.
  template <class What>
  void each_run(std::int64_t line, const IndexRange& columns, const What& what,
                bool of_one_medium = false) const {
    const auto all = in(line, columns);
    for (auto first = all.first; first < all.last;) {
      auto last = std::min(end_of_run(first, all.last), first + cells_at_once);
      const auto of_first = [&](const CellOfMedium& one) { return one.medium == (*this)[first].medium; };
      if (of_one_medium)
        last = std::find_if_not(cells.begin() + first, cells.begin() + last, of_first) - cells.begin();
      what(IndexRange{first, last});
      first = last;
    }
  }
};
/// Calls what(columns) for runs of at most `most` faces beside cells of the list: `lo` and `hi` are the lines
/// before and behind the faces, the cell before a face stands `shift` columns before that behind it.
template <class What>
void each_run_of_faces(const CellList& list, std::int64_t lo, std::int64_t hi, std::int64_t shift,
                       const IndexRange& columns, std::int64_t most, const What& what) {
  auto before = list.in(lo, {columns.first - shift, columns.last - shift}), behind = list.in(hi, columns);
  const auto face = [&](const IndexRange& cells, std::int64_t by) {
    return cells.empty() ? columns.last : list[cells.first].x + by;
  };
  const auto next = [&] { return std::min(face(before, shift), face(behind, 0)); };
  for (auto x = next(); x < columns.last; x = next()) {
    IndexRange run{x, x};
    while (run.count() < most && next() == run.last && run.last < columns.last) {
      if (face(before, shift) == run.last) ++before.first;
      if (face(behind, 0) == run.last) ++behind.first;
      ++run.last;
    }
    what(run);
  }
}

/// Cells that the widest stencil reads.
inline constexpr int most_places = 2 * max_reach + 1;
/// Values of a symmetric matrix, row by row from the diagonal on.
template <int D>
inline constexpr std::size_t symmetric = std::size_t(D*(D + 1) / 2);
/// Values of a run of cells or faces, one row each.
template <std::size_t Count, class Real>
struct RunOfValues {
  Real values[Count][cells_at_once];
  std::int64_t filled = 0;
  std::int32_t of = -1;  // the medium that fills it
};
template <int D, class Real>
using RunOfImpedances = RunOfValues<symmetric<D>, Real>;

/// One pair of a sweep: v and s of the first of the columns, and its corrections.
template <class Real>
struct SweptPair {
  const Real *v, *s;
  PairCorrections<Real> corrections;
};

/// Cells whose rock is more than the loops of their rows know (Domain::anisotropic_cells(), theory.md 1.11 to
/// 1.14), in sweeps along level rows and, in all rows, along the horizontal axes. The loops of a sweep take
/// them for something simpler (AnisotropicMedium::of_loops); then this overwrites their outgoing waves and
/// the states of their faces, and adds to their stresses what is missing. A level row is one whose faces are
/// all alike; along curvilinear rows the motions of waves are those of level ones, and J of the faces a
/// factor of their impedances (theory.md 1.15, 1.16). Cells of a medium share what is known of it.
template <int D, class Real>
class AnisotropicCells {
 public:
  AnisotropicCells() = default;
  /// `stencils` by axis and pair, at the order that reaches `reach` cells.
  AnisotropicCells(const Domain<D>& domain, int reach,
                   const std::array<std::array<InterfaceStencils, std::size_t(D)>, std::size_t(D)>& stencils);

  bool empty() const { return list_.empty(); }
  /// Whether a line holds any in these columns.
  bool any(std::int64_t line, const IndexRange& columns) const {
    return !empty() && !list_.in(line, columns).empty();
  }

  using Pairs = std::array<SweptPair<Real>, std::size_t(D)>;
  /// What the reconstruction of a row reads and writes, from the first of some columns on; `b` is dt/(rho h).
  struct Row {
    int axis;
    const Kernels<Real>& kernels;
    std::int64_t stride;
    Pairs pairs;
    const Real* b;
    Real scale;
    OutgoingWaves<Real> outgoing;
    const CurvilinearAlong<Real>* metric = nullptr;  // of a curvilinear row
  };
  /// Outgoing waves of the cells of these columns of a line, from the fields of all pairs.
  void reconstruct(std::int64_t line, const IndexRange& columns, const Row& row) const;
  /// States of faces, between cells of the material `lo` and `hi`; of a curvilinear row with half of J of the
  /// faces.
  void solve(const RowFaces<D, Real>& faces, const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
             const Real* half_face = nullptr) const;
  /// Adds to the stresses of cells, advanced as those of what loops take the cells for; `size` is that of the
  /// fraction of the step, `shear` in 3-D the shear stress that no pair of the sweep has.
  void add_stress(const RowPart<D, Real>& part, Real size, const Real* b, const RowFlux<Real>& flux,
                  const SweptRows<Real>& rows, Real* shear) const;

  std::int64_t memory_bytes() const { return list_.memory_bytes() + bytes_of(media_) + bytes_of(endings_); }

 private:
  static constexpr std::size_t motions = std::size_t(D * D), stresses = Elasticity<D>::components;
  /// What is known of a medium in sweeps along an axis; components are those of the pairs.
  struct OfAxis {
    std::array<Real, D + motions> waves;       // impedances, then the motion of each wave
    std::array<Real, symmetric<D>> impedance;  // the same as a matrix
    std::array<Real, stresses * D> missing;    // stiffnesses times the density, by stress and velocity
  };
  using Medium = std::array<OfAxis, std::size_t(D)>;
  using Waves = RunOfValues<D + motions, Real>;
  /// A cell whose stencils end at interfaces or edges, by its number.
  struct Ending {
    std::int64_t cell;
    int reach;  // of the reconstruction
    std::array<InterfaceStencil, std::size_t(D)> stencils;
  };
  static OfAxis of_axis(const AnisotropicMedium<D>& medium, int axis);
  void add_endings(const Domain<D>& domain, int axis,
                   const std::array<InterfaceStencils, std::size_t(D)>& stencils);
  template <std::size_t Count>
  void expand(std::int64_t first, std::int64_t count, int axis, const std::array<Real, Count> OfAxis::*values,
              RunOfValues<Count, Real>& to) const;
  /// All waves of a run of cells with whole stencils; `at` is the place of the first in the row.
  void reconstruct_run(const IndexRange& run, std::int64_t at, const Row& row) const;
  void reconstruct_curvilinear_run(const IndexRange& run, std::int64_t at, const Row& row) const;
  template <int Order>
  void reconstruct_ending(const Ending& ending, std::int64_t at, const Row& row) const;
  /// Impedances beside a run of faces, from column `from` on: those of cells where there are some, else of
  /// the material.
  void impedances_beside(int axis, std::int64_t line, const IndexRange& columns,
                         const MaterialRows<Real>& material, std::int64_t from,
                         RunOfImpedances<D, Real>& to) const;

  int reach_ = 0;
  CellList list_;
  std::vector<Medium> media_;
  std::array<std::vector<Ending>, std::size_t(D)> endings_;
};

/// These are AnisotropicCells in sweeps across curvilinear rows, and in 3-D beside these rows the cells of
/// upright rock, too: there each has waves of its own at the faces before and behind it (RowWaves).
template <int D, class Real>
class AnisotropicCellsAcross {
 public:
  AnisotropicCellsAcross() = default;
  AnisotropicCellsAcross(const Domain<D>& domain, const Metric<D, Real>& metric, int reach);

  bool empty() const { return list_.empty(); }
  /// Outgoing waves of the cells of these columns of a line; all pointers begin with the first of them.
  void reconstruct(std::int64_t line, const IndexRange& columns, const Kernels<Real>& kernels,
                   const CurvilinearFields<const Real>& fields, const CurvilinearAcross<Real>& metric,
                   const Real* b, Real scale, OutgoingWaves<Real> outgoing) const;
  /// The waves of a cell; none of one that is not anisotropic.
  std::optional<RowWaves<D, Real>> waves_of(std::int64_t line, std::int64_t x) const;
  /// States of the faces between two lines, -1 beyond the grid; `fluid`: the cells above them see velocities
  /// of their own.
  void solve(std::int64_t lo, std::int64_t hi, const IndexRange& columns, const CurvilinearSolve<Real>& at,
             Real sign, bool fluid) const;
  /// Adds to the stresses of these columns; `size` is that of the fraction of the step.
  void add_stress(std::int64_t line, const IndexRange& columns, Real size,
                  const CurvilinearUpdate<Real>& of) const;

  std::int64_t memory_bytes() const {
    return list_.memory_bytes() + bytes_of(media_) + values_.size() * std::int64_t(sizeof(Real));
  }

 private:
  static constexpr std::size_t motion_parts = std::size_t(2 * D), stresses = Elasticity<D>::components;
  /// Rows of values of the cells of a line: of the faces before and behind them the impedances of the waves
  /// and their motions, then courant_z (RowWaves).
  static constexpr std::size_t of_face = std::size_t(D + D * D), values = 2 * of_face + D;
  using Medium = SmallMatrix<stresses, Real>;  // stiffnesses times the density, less those of the loops
  /// The values of a line from one of its cells on, a pitch apart.
  struct Rows {
    const Real* first;
    std::int64_t pitch;
    const Real* operator[](std::size_t n) const { return first + std::int64_t(n) * pitch; }
  };
  Rows rows_of(std::int64_t line, std::int64_t cell) const;
  void fill(const Domain<D>& domain, const Metric<D, Real>& metric, std::int64_t line);
  /// Weights of the components in the pairs of waves [wave][v, s].
  using Weights = Real[D][2][motion_parts][cells_at_once];
  static void find_weights(const Rows& rows, std::int64_t n, Real sign, Weights& weights);
  /// Velocities and tractions of n cells.
  using Motion = Real[motion_parts][cells_at_once];
  static void load(std::int64_t n, const Real* field, std::int64_t pitch, const Real* half_n,
                   const CurvilinearAcross<Real>& metric, Motion& motion);
  /// Impedances beside a run of faces, of their lower (0) or upper side.
  void impedances_beside(std::int64_t line, std::size_t side, const IndexRange& columns,
                         const MaterialRows<Real>& material, const CurvilinearAcross<Real>& metric,
                         std::int64_t from, const RunOfImpedances<D, Real>& other,
                         RunOfImpedances<D, Real>& to) const;

  int reach_ = 0;
  CellList list_;
  Buffer<Real> values_;  // line after line
  std::vector<Medium> media_;
};

}  // namespace slipwave::solver
