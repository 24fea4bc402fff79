#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/kernels/bent_formulas.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

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
  /// One side of the face: where velocities along it and its material stand, and its metric.
  struct Side {
    std::array<std::int64_t, std::size_t(lateral)> cells;  // row 0 of the fields
    std::int64_t b;                                        // of the material
    Real j;
    bool coupled;  // on a level face of an anisotropic medium, which its material describes
  };
  /// What the differences along x, in 3-D also y, of the velocities of both sides of a face make of its
  /// corrections beside anisotropic cells (theory.md (F14)).
  struct Matrices {
    static constexpr std::size_t differences = std::size_t(2) * (D - 1) * D;
    /// [component][side, axis, component]
    using Matrix = std::array<std::array<Real, differences>, std::size_t(D)>;
    Matrix velocity{}, traction{};
  };
  struct Slot {
    std::int64_t row, column;
    std::int32_t matrices = none;                 // its place in matrices_
    std::array<Real, std::size_t(D - 1)> normal;  // horizontal components of N of the face
    std::array<Side, 2> sides;
  };
  std::size_t first_at(std::size_t row, std::int64_t column) const;
  void update_slot(const State<D, Real>& state, std::size_t slot);
  std::int32_t add_matrices(const State<D, Real>& state, const Domain<D>& domain,
                            const Metric<D, Real>& metric, const Index<D>& below,
                            const RowVector<D, double>& normal);
  void update_by_matrices(const State<D, Real>& state, std::size_t slot);

  std::int64_t padded_nx_ = 0, material_pitch_ = 0;
  int zs_y_row_ = row_zs, coupling_y_row_ = row_coupling;  // of the plane of y and z
  std::vector<Slot> slots_;                                // by row, then column
  std::vector<Matrices> matrices_;
  std::vector<std::size_t> first_;  // of each row in slots_, and the end
  std::array<std::vector<Real>, std::size_t(D)> velocities_, tractions_;
};

}  // namespace slipwave::solver
