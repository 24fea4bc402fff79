// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "model/averaging.hpp"
#include "model/medium.hpp"

namespace slipwave {

/// Stiffnesses of a rock that is transversely isotropic about the vertical (VTI) in the plane of x and z, Pa:
/// sxx = c11 exx + c13 ezz, szz = c13 exx + c33 ezz, sxz = 2 c55 exz.
struct Stiffness {
  double c11 = 0, c13 = 0, c33 = 0, c55 = 0;
  bool operator==(const Stiffness&) const = default;
};

/// Before its axis is tilted: from the speeds along it and Thomsen's (1986) epsilon and delta (theory.md
/// (V2)); those of an isotropic rock where both are zero. NaN where delta leaves none.
Stiffness stiffness_of(const Material& material);
template <int D>
Stiffness stiffness_of(const Medium<D>& medium, std::size_t cell) {
  return stiffness_of(material_of(medium, cell));
}

/// Stiffnesses in the plane of x and z, Pa: sxx = c11 exx + c13 ezz + 2 c15 exz, szz = c13 exx + c33 ezz
/// + 2 c35 exz, sxz = c15 exx + c35 ezz + 2 c55 exz.
struct PlaneStiffness {
  double c11 = 0, c13 = 0, c15 = 0, c33 = 0, c35 = 0, c55 = 0;
  bool operator==(const PlaneStiffness&) const = default;
};

/// Of a rock whose axis of symmetry, the vertical of `upright`, is tilted: its beds dip at this angle,
/// deepening towards +x (theory.md (T2)).
PlaneStiffness tilted(const Stiffness& upright, double dip_rad);
/// Of a rock with its tilt.
PlaneStiffness plane_stiffness_of(const Material& material);
template <int D>
PlaneStiffness plane_stiffness_of(const Medium<D>& medium, std::size_t cell) {
  return plane_stiffness_of(material_of(medium, cell));
}

/// The rock of these stiffnesses, in terms of speeds, epsilon and delta.
Material material_of_stiffness(const Stiffness& stiffness, double rho);

/// Stiffnesses of a rock in space whose axes of symmetry lie along x, y and z, Pa.
struct OrthorhombicStiffness {
  double c11 = 0, c22 = 0, c33 = 0, c44 = 0, c55 = 0, c66 = 0, c12 = 0, c13 = 0, c23 = 0;
  bool operator==(const OrthorhombicStiffness&) const = default;
  /// By axes, 0 to 2: of strain and stress along them, and of shear in their plane.
  double normal(int one, int other) const {
    const double moduli[] = {c11, c22, c33}, mixed[] = {c12, c13, c23};
    return one == other ? moduli[one] : mixed[one + other - 1];
  }
  double shear(int one, int other) const {
    const double moduli[] = {c66, c55, c44};
    return moduli[one + other - 1];
  }
};
/// Of an upright rock, from its speeds and the parameters of Thomsen and Tsvankin (theory.md (O2)). NaN where
/// these leave none.
OrthorhombicStiffness stiffness_in_space(const Material& material);
/// The rock of these stiffnesses; c12 + c66, c13 + c55 and c23 + c44 must not be negative.
Material material_of_stiffness_in_space(const OrthorhombicStiffness& stiffness, double rho);

/// Whether a cell is not alike in all horizontal directions.
template <int D>
bool is_orthorhombic(const Medium<D>& medium, std::size_t cell) {
  return medium.has(Property::epsilon1) && material_of(medium, cell).orthorhombic.has_value();
}
/// Whether a cell is anisotropic: in 2-D where epsilon or delta is not zero, in 3-D gamma and what tells
/// orthorhombic rock from other rock count, too.
template <int D>
bool is_anisotropic(const Medium<D>& medium, std::size_t cell) {
  if (medium.value(Property::epsilon, cell) != 0 || medium.value(Property::delta, cell) != 0) return true;
  return D == 3 && (medium.value(Property::gamma, cell) != 0 || is_orthorhombic(medium, cell));
}
/// Whether any cell is orthorhombic; in 2-D nothing tells.
template <int D>
bool any_orthorhombic(const Medium<D>& medium);
/// Whether its axes of symmetry are turned from those of the grid.
template <int D>
bool has_tilted_axis(const Medium<D>& medium, std::size_t cell) {
  if (medium.value(Property::tilt, cell) != 0) return true;
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
/// is alike in all horizontal directions.
template <int D>
void complete_anisotropy(Medium<D>& medium);

/// Speeds of plane waves, m/s: of quasi-P and quasi-S waves with motion in the plane of x and z.
struct PlaneSpeeds {
  double p = 0, s = 0;
};
/// Of waves whose fronts move at this angle from the vertical (theory.md (V3)).
PlaneSpeeds phase_speeds(const Stiffness& stiffness, double rho, double angle_rad);
/// The smallest of any direction.
PlaneSpeeds slowest_speeds(const Material& material);
/// The largest speed of quasi-P waves in any direction, m/s.
double fastest_p_speed(const Material& material);
/// What that is at most, m/s, told without a search: vp sqrt(1 + 2 max(epsilon, delta)), where one of both is
/// positive. Rocks with that epsilon and delta are elliptical, and stiffer.
double fastest_p_speed_at_most(const Material& material);
/// Speeds of the three waves whose fronts move along a unit vector, m/s, from the fastest to the slowest: the
/// roots of the Christoffel equation (theory.md (O3)).
std::array<double, 3> phase_speeds(const OrthorhombicStiffness& stiffness, double rho,
                                   const std::array<double, 3>& direction);
/// The smallest and largest of any direction in space; of VTI rock found in a plane.
PlaneSpeeds slowest_speeds_in_space(const Material& material);
double fastest_p_speed_in_space(const Material& material);
/// The medium with the speeds of the slowest directions as those of an isotropic one: wavelengths are nowhere
/// shorter.
template <int D>
Medium<D> in_slowest_directions(const Medium<D>& medium);

/// How far waves turn: the largest share of its phase speed at which energy moves back along an axis (the
/// vertical, or x) while the front of the wave moves on along it, -k_a g_a/omega (theory.md (V6)); 0 where
/// none does, as in any isotropic rock.
double largest_turning(const PlaneStiffness& stiffness, bool vertical);
/// The same in space along an axis, 0 to 2.
double largest_turning(const OrthorhombicStiffness& stiffness, int axis);

/// A property that no rock has, and what follows its place in an error: "is 0.1, expected ...".
struct AnisotropyFault {
  Property of;
  std::string text;
};
/// What keeps the stiffness from being positive, a fluid with epsilon or delta, a tilt of what has no axis;
/// nothing where all is well. In space stiffness must be positive for all strains, else for those in the
/// plane of x and z.
std::optional<AnisotropyFault> fault_of_anisotropy(const Material& material, bool in_space = false);

}  // namespace slipwave
