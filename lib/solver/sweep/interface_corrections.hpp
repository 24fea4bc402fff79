// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/by_line.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The share that is taken out of what half a sweep along the interface of fluid and solid leaves on it: with
/// one half waves bound to it keep their speed best (theory.md (E11a)). At free surfaces it is all.
inline constexpr double traction_share = 0.5;

/// Whether extensions across the face before a cell along an axis are corrected (InterfaceCorrections).
template <int D>
bool corrects_interface(const Domain<D>& domain, const Index<D>& behind, int axis);

/// Corrections of the extensions across interfaces inside the grid, in sweeps along one axis (theory.md
/// (E11a)): in solids and fluids that touch, velocities bend with what happens along the interface, and
/// sweeps along it leave tractions on both sides that differ when a sweep across begins. By place ("slot") of
/// the interface; components as those of the pairs of the sweep.
template <int D, class Real>
class InterfaceCorrections {
 public:
  InterfaceCorrections() = default;
  InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain, const Metric<D, Real>& metric,
                       int axis);

  bool empty() const { return slots_.empty(); }
  std::int64_t memory_bytes() const {
    return slots_.memory_bytes() + bytes_of(matrices_) + bytes_of(velocities_) + bytes_of(tractions_) +
           bytes_of(bends_) + bytes_of(returned_) + held_.memory_bytes() + bytes_of(retained_);
  }
  /// Slot of the face between a cell and the one before it along the axis, or `none` where nothing is
  /// corrected.
  std::int32_t slot(const Index<D>& behind) const;
  static constexpr std::int32_t none = -1;

  /// Copies the fields beside the faces before cells of this line in these columns as they are now, across
  /// another axis than the last: update() reads the copy, since sweeps change line after line.
  void retain(const State<D, Real>& state, std::int64_t line, const IndexRange& columns);
  /// Computes the corrections of the faces before cells in these columns of lines that follow each other,
  /// from fields as they are before the sweep or from the copy, up to free_surface_reach cells beside.
  void update(const State<D, Real>& state, const IndexRange& lines, const IndexRange& columns);

  /// By slot, of a component: what the extension of v gains over 2 j + 1 in ghost j, on both sides; and the
  /// traction beyond the face less that before it, in a sweep over a whole step.
  const Real* velocity(int component) const { return velocities_[std::size_t(component)].data(); }
  const Real* traction(int component) const { return tractions_[std::size_t(component)].data(); }
  /// By slot, of a component in a sweep over a whole step: what the extension of v gains besides over 2 j +
  /// 1, on both sides, and what the wave that leaves a cell of this side (0 before the face, 1 behind it) has
  /// too much (theory.md (E11d)).
  const Real* bend(int component) const { return bends_[std::size_t(component)].data(); }
  const Real* returned(int component, int side) const {
    return returned_[2 * std::size_t(component) + std::size_t(side)].data();
  }

 private:
  static constexpr int lateral = 4 * (D - 1);
  /// One side of the face: where velocities along it, in the fields or the copy, and its b stand.
  struct Side {
    std::array<std::int64_t, std::size_t(lateral)> cells;  // row 0
    std::int64_t b;                                        // of the material
  };
  /// What the differences along the face of the velocities of one side of it make of its corrections
  /// (theory.md (F14)); of the traction over b.
  static constexpr std::size_t differences = std::size_t(D - 1) * D;
  struct OfSide {
    /// [component][axis, component]
    using Matrix = std::array<std::array<Real, differences>, std::size_t(D)>;
    Matrix velocity{}, traction{};
    bool operator==(const OfSide&) const = default;
  };
  static constexpr std::size_t beside = std::size_t(D - 1) * offsets_along.size();
  /// How sweeps along the interface bend the velocity across it in a solid beside fluid (theory.md (E11d)):
  /// its side, by components the factors of what tractions along the interface make, and those of the
  /// stresses beside that these are.
  struct Bend {
    int solid = 0;
    std::array<Real, std::size_t(D)> velocity{}, returned{};
    std::array<std::array<Real, std::size_t(D)>, beside> stresses{};
    bool operator==(const Bend&) const = default;
  };
  struct Matrices {
    std::array<OfSide, 2> sides{};
    Bend bend{};
    bool operator==(const Matrices&) const = default;
  };
  struct Slot {
    std::int64_t x;         // of the cell behind the face
    std::int32_t matrices;  // their place in matrices_
    std::array<Side, 2> sides;
  };
  /// A face that is retained: column and place in the fields of the cell behind it.
  struct Held {
    std::int64_t x, cell;
  };
  bool copies() const { return axis_ < D - 1; }
  void hold(const Domain<D>& domain, const std::vector<Index<D>>& corrected);
  Side side_of(const State<D, Real>& state, const Domain<D>& domain, Index<D> behind, int side) const;
  void update_slot(const State<D, Real>& state, std::int64_t slot);
  Point<D> normal_before(const Metric<D, Real>& metric, const Index<D>& behind) const;
  Matrices matrices_of(const Domain<D>& domain, const Metric<D, Real>& metric, const Index<D>& behind) const;
  Bend bend_of(const Domain<D>& domain, const Metric<D, Real>& metric, const Index<D>& behind, int solid,
               const std::array<SmallMatrix<std::size_t(D)>, 2>& impedances) const;
  void update_bend(const Real* fields, std::int64_t pitch, const Real* material, std::int64_t slot);

  int axis_ = D - 1;
  Layout<D> layout_;
  ByLine<Slot> slots_;
  std::vector<Matrices> matrices_;
  ByLine<Held> held_;
  std::vector<Real> retained_;  // [held][before, behind the face][field row]
  std::array<std::vector<Real>, std::size_t(D)> velocities_, tractions_, bends_;
  std::array<std::vector<Real>, std::size_t(2 * D)> returned_;  // [component][side]
};

}  // namespace slipwave::solver
