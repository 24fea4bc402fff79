// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/bent_waves_in_space.hpp"

#include <cmath>
#include <utility>

namespace slipwave::solver {
namespace {

constexpr double rounding = 1e-12;

/// Times the size of the face: N is of any length.
BentWavesInSpace<double>::Face face_of(const SpaceStiffness& stiffness, const SpaceVector& normal) {
  const auto waves = waves_along(stiffness, normal);
  BentWavesInSpace<double>::Face face{};
  for (std::size_t wave = 0; wave < 3; ++wave) {
    // The root of what rounding leaves of a fluid's shear would be much.
    const bool carries = waves.moduli[wave] > rounding * waves.moduli[0];
    face.z[wave] = carries ? std::sqrt(waves.moduli[wave]) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      face.motions[wave][c] = waves.motions[wave][std::size_t(axes_of_rows[c])];
  }
  return face;
}

}  // namespace

BentWavesInSpace<double> waves_across_rows(const SpaceStiffness& stiffness, double j,
                                           const SpaceVector& normal,
                                           const std::array<SpaceVector, 2>& normals_of_faces) {
  BentWavesInSpace<double> waves{};
  const auto own = face_of(stiffness, normal);
  for (const std::size_t side : {0, 1}) {
    auto& face = waves.faces[side] = face_of(stiffness, normals_of_faces[side]);
    // On the way to the face the slower two may have changed places.
    const auto alike = [&](std::size_t of_face, std::size_t of_cell) {
      const auto &one = face.motions[of_face], &other = own.motions[of_cell];
      return std::abs(one[0] * other[0] + one[1] * other[1] + one[2] * other[2]);
    };
    if (alike(1, 2) + alike(2, 1) <= alike(1, 1) + alike(2, 2)) continue;
    std::swap(face.motions[1], face.motions[2]), std::swap(face.z[1], face.z[2]);
  }
  for (std::size_t wave = 0; wave < 3; ++wave) waves.courant_z[wave] = own.z[wave] / j;
  return waves;
}

RowMatrix impedance_across_rows(const SpaceStiffness& stiffness, const SpaceVector& normal) {
  const auto face = face_of(stiffness, normal);
  RowMatrix z{};
  for (std::size_t wave = 0; wave < 3; ++wave)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        z[i][k] += face.z[wave] * face.motions[wave][i] * face.motions[wave][k];
  return z;
}

RowMatrix traction_of_rows(const SpaceStiffness& stiffness, const SpaceVector& normal,
                           const SpaceVector& along) {
  RowMatrix traction{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l)
          traction[i][k] += stiffness(axes_of_rows[i], j, axes_of_rows[k], l) * normal[std::size_t(j)] *
                            along[std::size_t(l)];
  return traction;
}

RowMatrix inverse_of(const RowMatrix& matrix) {
  RowMatrix inverse{};
  for (std::size_t k = 0; k < 3; ++k) {
    RowComponents one{};
    one[k] = 1;
    const auto column = solved<double>(matrix, one);
    for (std::size_t i = 0; i < 3; ++i) inverse[i][k] = column[i];
  }
  return inverse;
}

}  // namespace slipwave::solver
