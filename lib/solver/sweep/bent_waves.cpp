// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/bent_waves.hpp"

#include <cmath>

namespace slipwave::solver {
namespace {

/// Of an acoustic tensor times the density, times the square of the size of the face.
BentWaves<double>::Face face_of(const PlaneTensor& of) {
  const double angle = std::atan2(2 * of.zx, of.zz - of.xx) / 2;
  const double mean = (of.zz + of.xx) / 2, half = std::hypot(of.zz - of.xx, 2 * of.zx) / 2;
  return {std::cos(angle), std::sin(angle), {std::sqrt(mean + half), std::sqrt(mean - half)}};
}

}  // namespace

BentWaves<double> waves_across_rows(const PlaneStiffness& stiffness, double j, double nx,
                                    const std::array<double, 2>& nx_of_faces) {
  const auto own = face_of(acoustic_tensor(stiffness, nx, 1));
  BentWaves<double> waves{{}, {own.z[0] / j, own.z[1] / j}};
  for (const std::size_t side : {0, 1}) {
    auto& face = waves.faces[side] = face_of(acoustic_tensor(stiffness, nx_of_faces[side], 1));
    // Motions have two signs: here the same.
    if (face.along * own.along + face.across * own.across < 0)
      face.along = -face.along, face.across = -face.across;
  }
  return waves;
}

PlaneTensor impedance_across_rows(const PlaneStiffness& stiffness, double nx) {
  const auto z = root_of(acoustic_tensor(stiffness, nx, 1));
  const double over = 1 / (1 + nx * nx);
  return {over * (z.zz + nx * (2 * z.zx + nx * z.xx)), over * (nx * (z.xx - z.zz) + (1 - nx * nx) * z.zx),
          over * (z.xx + nx * (nx * z.zz - 2 * z.zx))};
}

}  // namespace slipwave::solver
