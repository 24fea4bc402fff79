// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The share that is taken out of what half a sweep along the interface of fluid and solid leaves on it: with
/// one half waves bound to it keep their speed best (theory.md (E11a)). At free surfaces it is all.
inline constexpr double traction_share = 0.5;

/// Whether extensions across the face before a cell along z are corrected (InterfaceCorrections).
template <int D>
bool corrects_interface(const Domain<D>& domain, const Index<D>& below);

/// Corrections of the extensions across interfaces inside the grid that follow a row of faces (theory.md
/// (E11a)): in solids and fluids that touch, velocities bend with what happens along the interface, and
/// sweeps along it leave tractions on both sides that differ when a sweep across begins. By place ("slot") of
/// the interface; components as those of a sweep along z: z, x, in 3-D y.
template <int D, class Real>
class InterfaceCorrections {
 public:
  InterfaceCorrections() = default;
  InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain, const Metric<D, Real>& metric);

  bool empty() const { return slots_.empty(); }
  std::int64_t memory_bytes() const {
    return bytes_of(slots_) + bytes_of(matrices_) + bytes_of(first_) + bytes_of(velocities_) +
           bytes_of(tractions_);
  }
  /// Slot of the face between a cell and the one before it along z, or `none` where nothing is corrected.
  std::int32_t slot(const Index<D>& below_face) const;
  static constexpr std::int32_t none = -1;

  /// Computes the corrections of the face before this row in these columns (in 3-D cells of a plane, padded)
  /// from velocities as they are before the sweep, up to free_surface_reach cells beside them.
  void update(const State<D, Real>& state, std::int64_t row, const IndexRange& columns);
  void update_all(const State<D, Real>& state);

  /// By slot, of a component: what the extension of v gains over 2 j + 1 in ghost j, on both sides; and the
  /// traction beyond the face less that before it, in a sweep over a whole step.
  const Real* velocity(int component) const { return velocities_[std::size_t(component)].data(); }
  const Real* traction(int component) const { return tractions_[std::size_t(component)].data(); }

 private:
  static constexpr int lateral = 4 * (D - 1);
  /// One side of the face: where velocities along it and its b stand.
  struct Side {
    std::array<std::int64_t, std::size_t(lateral)> cells;  // row 0 of the fields
    std::int64_t b;                                        // of the material
  };
  /// What the differences along x, in 3-D also y, of the velocities of one side of a face make of its
  /// corrections (theory.md (F14)); of the traction over b.
  static constexpr std::size_t differences = std::size_t(D - 1) * D;
  struct OfSide {
    /// [component][axis, component]
    using Matrix = std::array<std::array<Real, differences>, std::size_t(D)>;
    Matrix velocity{}, traction{};
    bool operator==(const OfSide&) const = default;
  };
  using Matrices = std::array<OfSide, 2>;
  struct Slot {
    std::int64_t row, column;
    std::int32_t matrices;  // their place in matrices_
    std::array<Side, 2> sides;
  };
  std::size_t first_at(std::size_t row, std::int64_t column) const;
  void update_slot(const State<D, Real>& state, std::size_t slot);
  Matrices matrices_of(const Domain<D>& domain, const Metric<D, Real>& metric, const Index<D>& below);

  std::int64_t padded_nx_ = 0;
  std::vector<Slot> slots_;  // by row, then column
  std::vector<Matrices> matrices_;
  std::vector<std::size_t> first_;  // of each row in slots_, and the end
  std::array<std::vector<Real>, std::size_t(D)> velocities_, tractions_;
};

}  // namespace slipwave::solver
