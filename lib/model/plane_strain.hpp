// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "model/anisotropy.hpp"

namespace slipwave {

// Hooke's law in the plane of x and z. Stress is sxx, szz, sxz, strain exx, ezz, 2 exz.

inline std::array<double, 3> stress_of_strain(const PlaneStiffness& c, const std::array<double, 3>& strain) {
  const auto [xx, zz, xz] = strain;
  return {c.c11 * xx + c.c13 * zz + c.c15 * xz, c.c13 * xx + c.c33 * zz + c.c35 * xz,
          c.c15 * xx + c.c35 * zz + c.c55 * xz};
}

inline std::array<double, 3> strain_of_stress(const PlaneStiffness& c, const std::array<double, 3>& stress) {
  // The adjugate of the stiffness.
  const double xx = c.c33 * c.c55 - c.c35 * c.c35, zz = c.c11 * c.c55 - c.c15 * c.c15,
               xz = c.c11 * c.c33 - c.c13 * c.c13, xx_zz = c.c15 * c.c35 - c.c13 * c.c55,
               xx_xz = c.c13 * c.c35 - c.c15 * c.c33, zz_xz = c.c13 * c.c15 - c.c11 * c.c35;
  const double determinant = c.c11 * xx + c.c13 * xx_zz + c.c15 * xx_xz;
  return {(xx * stress[0] + xx_zz * stress[1] + xx_xz * stress[2]) / determinant,
          (xx_zz * stress[0] + zz * stress[1] + zz_xz * stress[2]) / determinant,
          (xx_xz * stress[0] + zz_xz * stress[1] + xz * stress[2]) / determinant};
}

}  // namespace slipwave
