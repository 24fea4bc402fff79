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
           bytes_of(velocities_of_step_) + bytes_of(tractions_of_step_) + bytes_of(curvatures_) +
           held_.memory_bytes() + bytes_of(retained_);
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
  /// By slot, of a component: what these two gain in a sweep over a whole step from what half a sweep along
  /// the interface has left in the solid (theory.md (E11d)).
  const Real* velocity_of_step(int component) const {
    return velocities_of_step_[std::size_t(component)].data();
  }
  const Real* traction_of_step(int component) const {
    return tractions_of_step_[std::size_t(component)].data();
  }
  /// And the second derivative across of the jump of the traction, by cell.
  const Real* curvature(int component) const { return curvatures_[std::size_t(component)].data(); }

 private:
  /// Cells of one side round the one at the face: four along each axis of the face (offsets_beside), that one
  /// itself, and in 3-D those at the corners.
  static constexpr std::array<int, 4> offsets_beside = {-2, -1, 1, 2};
  static constexpr std::array<double, 4> weights_beside = {1. / 12, -2. / 3, 2. / 3, -1. / 12};
  static constexpr std::size_t itself = offsets_beside.size() * (D - 1), around = itself + (D == 2 ? 1 : 5);
  using Around = std::array<Index<D>, around>;
  /// One side of the face: where these cells, in the fields or the copy, and its b stand.
  struct Side {
    std::array<std::int64_t, around> cells;  // row 0
    std::int64_t b;                          // of the material
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
  /// What (E11d) needs of a face: the side of the solid; what the differences along the face of the tractions
  /// on it make of the mean traction that half a sweep along leaves there; and by components the factors of
  /// the slope of the velocity and of the curvature of the traction that those along the normal make.
  struct Swept {
    std::size_t solid = 0;
    typename OfSide::Matrix traction{};
    std::array<Real, std::size_t(D)> velocity{}, curvature{};
    std::array<Real, std::size_t(D - 1)> per_cell{};                 // 1 over what cells measure by axis
    std::array<std::array<Real, std::size_t(D)>, itself> normals{};  // N of the faces beside
    bool operator==(const Swept&) const = default;
  };
  struct Matrices {
    std::array<OfSide, 2> sides{};
    Swept swept{};
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
  /// By axis of the face: what slopes along it put on it.
  using Loads = std::array<SmallMatrix<std::size_t(D)>, std::size_t(D - 1)>;
  bool copies() const { return axis_ < D - 1; }
  Around around_face(const Domain<D>& domain, const Index<D>& behind) const;
  void hold(const Domain<D>& domain, const std::vector<Index<D>>& corrected);
  Side side_of(const State<D, Real>& state, const Domain<D>& domain, Index<D> behind, int side) const;
  void update_slot(const State<D, Real>& state, std::int64_t slot);
  Point<D> normal_before(const Metric<D, Real>& metric, const Index<D>& behind) const;
  Matrices matrices_of(const Domain<D>& domain, const Metric<D, Real>& metric, const Index<D>& behind) const;
  Swept swept_of(const Domain<D>& domain, const Metric<D, Real>& metric, const Index<D>& behind,
                 std::size_t solid, const SmallMatrix<std::size_t(D)>& share,
                 const SmallMatrix<std::size_t(D)>& impedance, const Loads& load) const;
  /// By axis along the face and component.
  using Differences = std::array<Real, differences>;
  Differences differences_of_tractions(const Slot& slot, const Swept& swept, const Real* fields) const;
  Differences swept_velocities(const Slot& slot, const Swept& swept, const Real* fields) const;
  void update_swept(const Real* fields, const Real* material, std::int64_t slot);
  std::int64_t field_pitch() const { return copies() ? 1 : layout_.row_pitch(); }

  int axis_ = D - 1;
  Layout<D> layout_;
  ByLine<Slot> slots_;
  std::vector<Matrices> matrices_;
  ByLine<Held> held_;
  std::vector<Real> retained_;  // [held][before, behind the face][field row]
  std::array<std::vector<Real>, std::size_t(D)> velocities_, tractions_, velocities_of_step_,
      tractions_of_step_, curvatures_;
};

}  // namespace slipwave::solver
