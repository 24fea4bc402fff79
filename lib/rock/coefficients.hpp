// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/last_found.hpp"
#include "rock/anisotropy.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {

// What sweeps know of a medium (theory.md (E4)-(E9), (V1)): asked for by axis and wave. An isotropic medium
// gives the same answer for every axis.

/// Waves that travel along an axis: with motion along it, and across it.
enum Wave : int { wave_p, wave_s };

/// Whether a medium may have more than speeds and a density: else it is isotropic in all cells.
template <int D>
bool has_elastic_options(const Medium<D>& medium) {
  for (const Property property : medium.properties())
    if (std::size_t(property) >= required_properties && row_of(property).mean == Mean::elastic) return true;
  return false;
}

/// Their speed c, m/s; 0 in a cell that does not carry the wave. In an anisotropic cell the P wave along x is
/// faster by sqrt(1 + 2 epsilon) (theory.md (V1)). Where its axis is tilted, waves with motion along and
/// across an axis of the grid are not independent: then these are the speeds of the diagonal of (T3).
template <int D>
double wave_speed(const Medium<D>& medium, std::size_t cell, int axis, Wave wave) {
  if (medium.is_void(cell)) return 0;
  if (has_tilted_axis(medium, cell)) {
    const double rho = medium.rho[cell];
    const auto c = elasticity_of<D>(material_of(medium, cell));
    return std::sqrt((wave == wave_s ? c(5, 5) : c(axis, axis, axis, axis)) / rho);
  }
  if (D == 3 && wave == wave_p && axis == 1 && is_orthorhombic(medium, cell))
    return double(medium.vp[cell]) * std::sqrt(1 + 2 * medium.value(Property::epsilon1, cell));
  if (wave == wave_p && axis < D - 1 && medium.has(Property::epsilon))
    return double(medium.vp[cell]) * std::sqrt(1 + 2 * medium.value(Property::epsilon, cell));
  return double(wave == wave_p ? medium.vp[cell] : medium.vs[cell]);
}

/// The elasticity by which sweeps load stresses of a cell: what rock has of it along the grid.
template <int D>
Elasticity<D> elasticity_along_grid(const Medium<D>& medium, std::size_t cell) {
  const auto material = material_of(medium, cell);
  return has_tilted_axis(medium, cell) ? elasticity_of<D>(material).along_grid()
                                       : upright_elasticity<D>(material);
}

/// Returns the speed of S waves with motion along `motion` in sweeps along `axis`, in m/s: that of the shear
/// stiffness of the plane of both (theory.md (O1)).
template <int D>
double shear_speed(const Medium<D>& medium, std::size_t cell, int axis, int motion) {
  if constexpr (D == 3)
    if (is_anisotropic(medium, cell) && !medium.is_void(cell))
      return std::sqrt(elasticity_along_grid(medium, cell)(axis, motion, axis, motion) /
                       double(medium.rho[cell]));
  return wave_speed(medium, cell, axis, wave_s);
}

/// The density times the stiffness by which the strain along one axis loads the normal stress of another: by
/// default c13, of an isotropic medium lambda. kg2/(m4 s2).
template <int D>
double wave_coupling(const Medium<D>& medium, std::size_t cell, int one = 0, int other = D - 1) {
  if (medium.is_void(cell)) return 0;
  return double(medium.rho[cell]) * elasticity_along_grid(medium, cell)(one, one, other, other);
}

/// Their impedance rho c, kg/(m2 s); 0 in a cell that does not carry the wave.
template <int D>
double wave_impedance(const Medium<D>& medium, std::size_t cell, int axis, Wave wave) {
  return double(medium.rho[cell]) * wave_speed(medium, cell, axis, wave);
}

/// What the largest speed along the axes of the grid is at most where those of the rock are turned, m/s: in
/// 2-D of quasi-P waves in any direction, in 3-D that of these axes or, where rows dip, of any direction;
/// asked for once of cells that are alike.
template <int D>
class FastestOfTilted {
 public:
  double operator()(const Medium<D>& medium, std::size_t cell, bool dips = false) {
    const auto material = material_of(medium, cell);
    if (D == 2 && !material.constants) return fastest_p_speed_at_most(material);
    return last_({material, dips}, [](const auto& of) {
      return D == 2      ? fastest_p_speed_at_most(of.first)
             : of.second ? fastest_in_3d(of.first)
                         : fastest_along_grid(of.first);
    });
  }

 private:
  LastFound<std::pair<Material, bool>, double> last_;
};

/// The largest speed of all cells, axes and waves, m/s; 0 where all is void.
template <int D>
double fastest_speed(const Medium<D>& medium) {
  double fastest = 0;
  if (!has_elastic_options(medium)) {
    float largest = 0;
    for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
      largest = std::max(largest, medium.is_void(cell) ? 0 : medium.vp[cell]);
    return double(largest);
  }
  // Whose stiffness may be anything that is positive.
  const bool shear_too = D == 3 && medium.has(Property::gamma);
  FastestOfTilted<D> of_tilted;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (has_tilted_axis(medium, cell))
      fastest = std::max(fastest, of_tilted(medium, cell));
    else
      for (int axis = 0; axis < D; ++axis) {
        fastest = std::max(fastest, wave_speed(medium, cell, axis, wave_p));
        if (shear_too) fastest = std::max(fastest, shear_speed(medium, cell, axis, (axis + 1) % D));
      }
  for (const auto cell : cells_of_tilted_means(medium))
    fastest = std::max(fastest, fastest_in_tilted_mean(medium, cell));
  return fastest;
}

/// The speed of the fastest wave that crosses a cell of a fitted grid, but of tilted means that of the mean.
template <int D>
class FastestAcrossCell {
 public:
  explicit FastestAcrossCell(const Medium<D>& medium) : medium_(medium) {}
  /// Not inlined: GCC 12 then takes an absent part of a material for one that is used before it is set.
  [[gnu::noinline]] double operator()(std::size_t cell) {
    // Across rows that are not level waves go in any direction.
    const bool dips = is_anisotropic(medium_, cell) && !row_is_level(cell);
    return dips || has_tilted_axis(medium_, cell) ? of_tilted_(medium_, cell, dips)
                                                  : double(medium_.vp[cell]);
  }

 private:
  bool row_is_level(std::size_t cell) {
    const auto& grid = medium_.grid();
    const auto row = grid.index(std::int64_t(cell))[D - 1] + grid.first[D - 1];
    if (row != row_) row_ = row, level_ = grid.rows->row_is_level(row) && grid.rows->row_is_level(row + 1);
    return level_;
  }
  std::int64_t row_ = -1;  // the last that was asked for
  bool level_ = false;
  const Medium<D>& medium_;
  FastestOfTilted<D> of_tilted_;
};

/// Largest speed in m/s at which a wave crosses cells, times their size: in a fitted grid waves cross low and
/// steep rows in less time.
template <int D>
double fastest_across_cells(const Medium<D>& medium) {
  const auto& grid = medium.grid();
  double fastest = fastest_speed(medium);
  if (!grid.rows) return fastest;
  const auto see = [&](std::size_t cell, double speed) {
    auto at = grid.index(std::int64_t(cell));
    at[D - 1] += grid.first[D - 1];
    fastest = std::max(fastest, speed * grid.rows->stretch(at, grid.spacing_m));
  };
  FastestAcrossCell<D> speed(medium);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) see(cell, speed(cell));
  for (const auto cell : cells_of_tilted_means(medium)) see(cell, fastest_in_tilted_mean(medium, cell));
  return fastest;
}

/// Ratio of impedances from which an interface between neighbouring cells is strong: stencils on both sides
/// end there. Below it stencils run across: random contrasts up to 1.5 stay stable at every order.
inline constexpr double strong_interface_ratio = 1.5;
/// Whether cells of these impedances are of one rock, over which a source may be spread.
constexpr bool are_one_rock(double z, double other) {
  constexpr double ratio = 1.05;
  return z <= ratio * other && other <= ratio * z;
}
/// Whether a face between cells of these impedances is a strong interface.
constexpr bool strong_interface_between(double z, double other) {
  return z > strong_interface_ratio * other || other > strong_interface_ratio * z;
}

}  // namespace slipwave
