// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rock/averaging.hpp"
#include "rock/elasticity.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// Whether a cell is not alike in all horizontal directions.
template <int D>
bool is_orthorhombic(const Medium<D>& medium, std::size_t cell) {
  return medium.has(Property::epsilon1) && material_of(medium, cell).orthorhombic.has_value();
}
/// Whether a cell is anisotropic: in 2-D where epsilon or delta is not zero or rock has elastic constants, in
/// 3-D gamma and what tells orthorhombic rock from other rock count, too.
template <int D>
bool is_anisotropic(const Medium<D>& medium, std::size_t cell) {
  if (medium.value(Property::epsilon, cell) != 0 || medium.value(Property::delta, cell) != 0) return true;
  if (has_constants(medium, cell)) return true;
  return D == 3 && (medium.value(Property::gamma, cell) != 0 || is_orthorhombic(medium, cell));
}
/// Whether any cell is orthorhombic; in 2-D nothing tells.
template <int D>
bool any_orthorhombic(const Medium<D>& medium);
/// Whether its axes of symmetry are turned from those of the grid, as those of rock with elastic constants
/// may be.
template <int D>
bool has_tilted_axis(const Medium<D>& medium, std::size_t cell) {
  if (medium.value(Property::tilt, cell) != 0 || has_constants(medium, cell)) return true;
  return D == 3 && is_orthorhombic(medium, cell) &&
         medium.value(Property::azimuth, cell) + medium.value(Property::rotation, cell) != 0;
}
/// Whether any cell has such axes.
template <int D>
bool any_tilted_axes(const Medium<D>& medium);
/// How many cells are anisotropic.
template <int D>
std::int64_t anisotropic_cells(const Medium<D>& medium);

/// Gives a medium with one of epsilon and delta the other, zero everywhere: means of cells have both. In 3-D
/// gamma, too; and one with one of the parameters of orthorhombic rock all of them, as they are of rock that
/// is alike in all horizontal directions; one with an elastic constant those of the plane of x and z, and all
/// of them in 3-D and where one has to do with y.
template <int D>
void complete_anisotropy(Medium<D>& medium);

/// Speeds of plane waves, m/s: of quasi-P and quasi-S waves, in 2-D with motion in the plane of x and z.
struct PlaneSpeeds {
  double p = 0, s = 0;
};
/// The smallest speeds of any direction, in D dimensions.
template <int D>
PlaneSpeeds slowest_speeds(const Material& material);
template <>
PlaneSpeeds slowest_speeds<2>(const Material& material);
template <>
PlaneSpeeds slowest_speeds<3>(const Material& material);
/// The largest speed of quasi-P waves in any direction, m/s.
template <int D>
double fastest_p_speed(const Material& material);
template <>
double fastest_p_speed<2>(const Material& material);
template <>
double fastest_p_speed<3>(const Material& material);
/// What that is at most in the plane of x and z, m/s, without a search: vp sqrt(1 + 2 max(epsilon, delta)),
/// where one of both is positive. Rocks with that epsilon and delta are elliptical, and stiffer. Of elastic
/// constants it is the largest speed itself.
double fastest_p_speed_at_most(const Material& material);
/// The largest speed of waves along an axis of the grid in 3-D, m/s: what bounds the time step.
double fastest_along_grid(const Material& material);
/// What the largest speed of waves in any direction in 3-D is, m/s; where all horizontal directions are alike
/// at most.
double fastest_in_3d(const Material& material);
/// The medium with the speeds of the slowest directions as those of an isotropic one: wavelengths are nowhere
/// shorter.
template <int D>
Medium<D> in_slowest_directions(const Medium<D>& medium);

/// A property that no rock has, and what follows its place in an error: "is 0.1, expected ...".
struct AnisotropyFault {
  Property of;
  std::string text;
};
/// "3.5 GPa": a stiffness.
std::string gpa(double pascal);
/// "more than 3 GPa beside ...": what a constant that is too small should be.
std::string above_soft_constant(const SoftConstant& soft);
/// What keeps the stiffness from being positive, a fluid with epsilon or delta, a tilt of what has no axis;
/// nothing where all is well. In space stiffness must be positive for all strains, else for those in the
/// plane of x and z.
std::optional<AnisotropyFault> fault_of_anisotropy(const Material& material, bool in_3d = false);

}  // namespace slipwave
