#pragma once

#include <array>
#include <vector>

#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// Derivatives of velocity at a point as weighted sums of velocities round it (theory.md (A8), (A9)),
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
  using Terms = std::vector<SurfaceTerm<D>>;
  using Cells = std::array<AxisCells, std::size_t(D)>;
  using Place = std::array<double, std::size_t(D)>;  // in cells of the computed grid
  /// Of the velocity `row`: products of the weights along the axes, derivatives along one of them.
  Terms product(const Cells& usable, const Place& at, int row, int along, double factor) const;
  /// The derivative per cell at the point.
  Terms slope(int row, int along) const;
  /// The derivative per cell away from a free surface, on it.
  Terms slope_on_surface(int row, int axis, int side) const;
  /// grad of each row coordinate, 1/m: in regular grids the unit vectors over h.
  std::array<Point<D>, std::size_t(D)> row_gradients(const Place& at) const;
  bool is_free(int axis, int side) const;

  const Domain<D>& domain_;
  Index<D> centre_;
  bool fluid_;
  Place at_{};
  Cells inner_;  // without images
};

extern template class VelocityGradient<2>;
extern template class VelocityGradient<3>;

}  // namespace slipwave::solver
