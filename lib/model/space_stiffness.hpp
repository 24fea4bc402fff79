// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "model/anisotropy.hpp"

namespace slipwave {

/// Components along x, y and z.
using SpaceVector = std::array<double, 3>;
/// The axes 1, 2 and 3 of a rock, unit vectors.
using RockAxes = std::array<SpaceVector, 3>;
/// Of a rock from its tilt, azimuth and rotation (theory.md (O6)).
RockAxes axes_of(const Material& material);

/// All stiffnesses of a rock in space, Pa.
struct SpaceStiffness {
  /// By Voigt's pairs xx, yy, zz, yz, xz, xy.
  std::array<std::array<double, 6>, 6> voigt{};

  bool operator==(const SpaceStiffness&) const = default;
  static constexpr std::size_t pair(int one, int other) {
    return std::size_t(one == other ? one : 6 - one - other);
  }
  /// C_ijkl, axes 0 to 2.
  double operator()(int i, int j, int k, int l) const { return voigt[pair(i, j)][pair(k, l)]; }
  /// What loops take a rock for: its nine stiffnesses of an orthorhombic one along the grid.
  OrthorhombicStiffness along_grid() const;
};

/// Of a rock whose own axes, along which its stiffness is orthorhombic, are these.
SpaceStiffness turned(const OrthorhombicStiffness& upright, const RockAxes& axes);
/// Of a rock with its angles.
SpaceStiffness space_stiffness_of(const Material& material);

/// The three plane waves of a direction: moduli rho c^2, falling, and motions, unit vectors.
struct SpaceWaves {
  SpaceVector moduli{};
  std::array<SpaceVector, 3> motions{};
};
/// Whose fronts move along a unit vector (theory.md (O3)); along an axis those of its acoustic tensor.
SpaceWaves waves_along(const SpaceStiffness& stiffness, const SpaceVector& direction);
/// Their speeds, m/s, from the fastest to the slowest.
SpaceVector phase_speeds(const SpaceStiffness& stiffness, double rho, const SpaceVector& direction);

/// The largest speed of waves along an axis of the grid, m/s: what bounds the time step.
double fastest_along_grid(const Material& material);
/// What the largest speed of waves in any direction is, m/s; where all horizontal directions are alike at
/// most.
double fastest_in_space(const Material& material);
/// How far waves turn along an axis, 0 to 2 (theory.md (V6)).
double largest_turning(const SpaceStiffness& stiffness, int axis);

/// Hooke's law. Stress and strain are as SymmetricTensor<3> has them, shear strains doubled.
std::array<double, 6> stress_of_strain(const SpaceStiffness& stiffness, const std::array<double, 6>& strain);
std::array<double, 6> strain_of_stress(const SpaceStiffness& stiffness, const std::array<double, 6>& stress);

/// s:C^-1:s of a stress by Voigt's pairs: twice the elastic energy of a volume, Pa.
double complementary(const SpaceStiffness& stiffness, const std::array<double, 6>& stress);

}  // namespace slipwave
