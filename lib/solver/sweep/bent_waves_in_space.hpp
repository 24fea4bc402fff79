// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "solver/kernels/bent_formulas.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Components are along z, x and y, the order of the pairs of a sweep along z.
using RowComponents = std::array<double, 3>;
using RowMatrix = std::array<RowComponents, 3>;
/// Their axes.
inline constexpr std::array<int, 3> axes_of_rows = {2, 0, 1};

/// What BentWaves is in 2-D: the three waves of an anisotropic cell in a sweep across bent rows (theory.md
/// (F15)).
template <class Real>
struct BentWavesInSpace {
  /// At a face: the motions of the waves, and their impedances, times the size of the face.
  struct Face {
    std::array<std::array<Real, 3>, 3> motions;  // [wave][component]
    std::array<Real, 3> z;
  };
  std::array<Face, 2> faces;      // before the cell and behind it
  std::array<Real, 3> courant_z;  // times dt/(rho h) the Courant numbers of the waves
};

/// A wave of such a cell as one pair (v, s), as WavePair in 2-D: the weights of the components of velocity
/// and traction in both.
template <class Real>
struct WavePairInSpace {
  std::array<Real, 6> v, s;
};
template <class Real>
[[gnu::always_inline]] inline WavePairInSpace<Real> wave_pair_in_space(const Real* before, Real z_before,
                                                                       const Real* behind, Real z_behind,
                                                                       Real courant_z, Real sign) {
  const Real half = Real(0.5), over = half / courant_z;
  WavePairInSpace<Real> pair;
  for (std::size_t c = 0; c < 3; ++c) {
    pair.v[c] = over * (z_behind * behind[c] + z_before * before[c]);
    pair.v[3 + c] = sign * over * (before[c] - behind[c]);
    pair.s[c] = sign * half * (z_before * before[c] - z_behind * behind[c]);
    pair.s[3 + c] = half * (before[c] + behind[c]);
  }
  return pair;
}

/// N of a face or cell, whose component along z is 1, along x, y and z.
template <class Real>
SpaceVector normal_in_space(const RowVector<3, Real>& normal) {
  return {double(normal.x), double(normal.y), 1};
}

/// Across the rows, of a stiffness times the density, with the volume J of the cell and N of it and of the
/// faces before and behind it.
BentWavesInSpace<double> waves_across_rows(const SpaceStiffness& stiffness, double j,
                                           const SpaceVector& normal,
                                           const std::array<SpaceVector, 2>& normals_of_faces);
/// Of the cell at which the metric begins.
template <class Real>
BentWavesInSpace<double> waves_across_rows(const SpaceStiffness& stiffness, const BentAcross<Real>& metric) {
  const auto face = [&](std::int64_t at) {
    return normal_in_space(face_normal<3>(metric.half_n + at, metric.pitch));
  };
  return waves_across_rows(stiffness, 1 / double(metric.over_j[0]),
                           normal_in_space(cell_normal<3>(metric.half_n, metric.pitch, metric.stride)),
                           {face(0), face(metric.stride)});
}

/// The impedance of a cell across a face with the vector N, of a stiffness times the density: the root of
/// N.C.N.
RowMatrix impedance_across_rows(const SpaceStiffness& stiffness, const SpaceVector& normal);
/// N.C.e of an axis: what a difference of velocity along it puts on such a face; N.C.N with N in place of e.
RowMatrix traction_of_rows(const SpaceStiffness& stiffness, const SpaceVector& normal,
                           const SpaceVector& along);
/// Of a symmetric positive matrix.
RowMatrix inverse_of(const RowMatrix& matrix);
template <std::size_t N>
std::array<std::array<double, N>, N> product_of(const std::array<std::array<double, N>, N>& one,
                                                const std::array<std::array<double, N>, N>& other) {
  std::array<std::array<double, N>, N> product{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t n = 0; n < N; ++n) product[i][k] += one[i][n] * other[n][k];
  return product;
}

}  // namespace slipwave::solver
