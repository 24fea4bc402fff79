// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// Derivatives of velocity at a point as weighted sums of velocities round it (theory.md (A10), (A11)),
/// whatever the rock does with its strain: slip and opening count. Read are cells of the kind of the point's
/// own, up to the nearest strong interface along each axis. On a free surface of a solid its traction
/// vanishes exactly; in fitted grids derivatives are along true x, y and z.
template <int D>
class VelocityGradient {
 public:
  VelocityGradient(const Domain<D>& domain, const Point<D>& point_m);
  /// Weights of dv_axis/dx_along, 1/m, each value once.
  std::vector<ValueWeight> weights(const Layout<D>& layout, int axis, int along) const;

 private:
  using Cells = std::array<AxisCells, std::size_t(D)>;
  using Place = std::array<double, std::size_t(D)>;  // in cells of the computed grid
  /// Weights of the velocities of the cells that may be read.
  class Sum {
   public:
    explicit Sum(const Cells& cells);
    void add(const Index<D>& cell, int row, double weight) { weights_[place(cell, row)] += weight; }
    std::vector<ValueWeight> values(const Layout<D>& layout) const;

   private:
    std::size_t place(const Index<D>& cell, int row) const {
      std::int64_t n = row;
      for (std::size_t axis = 0; axis < D; ++axis)
        n = n * (cells_[axis].high - cells_[axis].low + 1) + cell[axis] - cells_[axis].low;
      return std::size_t(n);
    }
    Cells cells_;
    std::vector<double> weights_;
  };
  /// One side of an axis, and the cells that end there.
  struct Face {
    int axis, side;
    std::int64_t last;
  };
  Cells usable(int row) const {
    return extended_cells(domain_, centre_, row, fluid_, Reach::to_strong_interfaces).cells;
  }
  /// Adds the derivative per cell along an axis of the velocity `row` at a place, as products of weights.
  void add_product(const Cells& usable, const Place& at, int row, int along, double factor, Sum& sum) const;
  /// Adds the derivative per cell along an axis of the velocity `row` at a place, along a free surface or
  /// where there is none.
  void add_slope_along(const Place& at, int row, int along, double factor, Sum& sum) const;
  /// Adds the derivative per cell along an axis of the velocity `row` at the point, across a free surface
  /// too.
  void add_slope(int row, int along, double factor, Sum& sum) const;
  /// The derivative per cell away from a free surface at a place on it, which those along it enforce.
  enum class Values { one_sided, with_images };
  void add_enforced_slope(const Place& at, int row, const Face& face, Values values, double factor,
                          Sum& sum) const;
  /// Returns, for a field that is the distance from a face, what its mirror images lack of a sum with these
  /// weights that should be `exact`.
  double lacking(const std::vector<CellWeight>& weights, const Face& face, double exact) const;
  Place on_face(Place at, const Face& face) const;
  double distance(const Place& at, const Face& face) const;
  /// grad of each row coordinate, 1/m: in regular grids the unit vectors over h.
  std::array<Point<D>, std::size_t(D)> row_gradients(const Place& at) const;

  const Domain<D>& domain_;
  Index<D> centre_;
  bool fluid_;
  Place at_{};
  Cells inner_;                   // without images
  std::vector<Face> free_faces_;  // of a solid, that its cells reach
};

extern template class VelocityGradient<2>;
extern template class VelocityGradient<3>;

}  // namespace slipwave::solver
