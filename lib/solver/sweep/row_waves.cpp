// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/row_waves.hpp"

#include <cmath>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

constexpr double rounding = 1e-12;

/// Times the size of the face: N is of any length.
template <int D>
typename RowWaves<D>::Face face_of(const Elasticity<D>& elasticity, const Point<D>& normal) {
  const auto waves = slipwave::waves_along<D>(elasticity, normal);
  typename RowWaves<D>::Face face;
  for (std::size_t wave = 0; wave < D; ++wave) {
    // The root of what rounding leaves of a fluid's shear would be much.
    const bool carries = waves.values[wave] > rounding * waves.values[0];
    face.z[wave] = carries ? std::sqrt(waves.values[wave]) : 0;
    face.motions[wave] = in_pairs<D>(waves.vectors[wave]);
  }
  return face;
}

}  // namespace

template <int D>
RowWaves<D> waves_across_rows(const Elasticity<D>& elasticity, double j, const Point<D>& normal,
                              const std::array<Point<D>, 2>& normals_of_faces) {
  RowWaves<D> waves;
  const auto own = face_of<D>(elasticity, normal);
  for (const std::size_t side : {0, 1}) {
    auto& face = waves.faces[side] = face_of<D>(elasticity, normals_of_faces[side]);
    const auto alike = [&](std::size_t of_face, std::size_t of_cell) {
      return dot_product(face.motions[of_face], own.motions[of_cell]);
    };
    // On the way to the face the slower two may have changed places, and motions have two signs.
    if (D == 3 && std::abs(alike(1, D - 1)) + std::abs(alike(D - 1, 1)) >
                      std::abs(alike(1, 1)) + std::abs(alike(D - 1, D - 1)))
      std::swap(face.motions[1], face.motions[D - 1]), std::swap(face.z[1], face.z[D - 1]);
    for (std::size_t wave = 0; wave < D; ++wave)
      if (alike(wave, wave) < 0)
        for (double& part : face.motions[wave]) part = -part;
  }
  for (std::size_t wave = 0; wave < D; ++wave) waves.courant_z[wave] = own.z[wave] / j;
  return waves;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, waves_across_rows);

}  // namespace slipwave::solver
