// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Offsets and weights of the central difference along a surface or an interface.
inline constexpr std::array<int, 2> offsets_along = {-1, 1};
inline constexpr std::array<double, 2> weights_along = {-0.5, 0.5};
/// Cells without a strong interface or an edge needed across it: no stencil that reads beyond it, by
/// most_reach_at_mirrors at most, may reach another extension.
inline constexpr auto fewest_across = std::int64_t(2) * most_reach_at_mirrors;

/// Whether a slice is too thin for differences along this axis, which read up to free_surface_reach cells on
/// both sides. It has no slope, unless its own edges are free.
template <int D>
bool thin(const Domain<D>& domain, int along) {
  return domain.grid.shape[std::size_t(along)] <= 2 * free_surface_reach;
}
template <int D>
bool ends_free(const Domain<D>& domain, int along) {
  return domain.edges[along][0] == EdgeLaw::free || domain.edges[along][1] == EdgeLaw::free;
}

/// Cells by axis: those of z are as high as their row.
template <int D>
double cell_along(const Domain<D>& domain, const Index<D>& at, int axis) {
  return axis == D - 1 ? domain.height(at[D - 1]) : 1;
}

/// Whether two cells carry the same waves without a strong interface between them.
template <int D>
bool alike(const Domain<D>& domain, const Index<D>& one, const Index<D>& other) {
  const auto differ = [&](const Field<D>& impedance) {
    return strong_interface_between(impedance(one), impedance(other));
  };
  for (const Wave wave : {wave_p, wave_s})
    for (const int axis : {D - 1, 0})
      if (differ(domain.impedance(wave, axis))) return false;
  for (int axis = 0; domain.splits_shear() && axis < D; ++axis)
    for (int pair = 0; pair < D; ++pair)
      if (differ(domain.impedance_of_pair(axis, pair))) return false;
  return true;
}

/// Whether a cell of rock or fluid ends at a free surface on a side (0 low, 1 high) of an axis: at a free
/// edge of the grid, or at void.
template <int D>
bool ends_at_free_surface(const Domain<D>& domain, const Index<D>& at, int axis, int side) {
  const auto& p_waves = domain.impedance(wave_p);
  Index<D> beyond = at;
  auto& place = beyond[std::size_t(axis)];
  place += side ? 1 : -1;
  if (p_waves(at) == 0) return false;
  if (place < 0 || place >= domain.grid.shape[std::size_t(axis)])
    return domain.edges[axis][side] == EdgeLaw::free;
  return p_waves(beyond) == 0;
}

/// The part of a vector along N times one factor and the rest times another.
template <int D, class Real>
RowVector<D, Real> scaled(const RowVector<D, Real>& normal, Real along, Real across,
                          const RowVector<D, Real>& vector) {
  return across * vector + ((along - across) * dot(normal, vector) / dot(normal, normal)) * normal;
}

}  // namespace slipwave::solver
