// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// The axes of motion of the pairs of sweeps along an axis.
template <int D>
constexpr std::array<int, std::size_t(D)> axes_of_pairs(int axis) {
  std::array<int, std::size_t(D)> axes{};
  for (int pair = 0; pair < D; ++pair)
    axes[std::size_t(pair)] = pair == 0 ? axis : axis_of_pair<D>(axis, pair);
  return axes;
}
/// A vector or matrix of components along the axes of the grid as one of those of the pairs; of curvilinear
/// rows, in sweeps along z, in the order of RowVector.
template <int D>
Point<D> in_pairs(const Point<D>& of, int axis = D - 1) {
  const auto axes = axes_of_pairs<D>(axis);
  Point<D> ordered;
  for (std::size_t i = 0; i < D; ++i) ordered[i] = of[std::size_t(axes[i])];
  return ordered;
}
template <int D>
SmallMatrix<std::size_t(D)> in_pairs(const SmallMatrix<std::size_t(D)>& of, int axis = D - 1) {
  const auto axes = axes_of_pairs<D>(axis);
  SmallMatrix<std::size_t(D)> ordered;
  for (std::size_t i = 0; i < D; ++i) ordered[i] = in_pairs<D>(of[std::size_t(axes[i])], axis);
  return ordered;
}

/// Components of a vector of a row, in their order.
template <int D, class Real>
[[gnu::always_inline]] inline std::array<Real, std::size_t(D)> components(const RowVector<D, Real>& of) {
  if constexpr (D == 2)
    return {of.z, of.x};
  else
    return {of.z, of.x, of.y};
}
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> row_vector(const std::array<Real, std::size_t(D)>& of) {
  if constexpr (D == 2)
    return {of[0], of[1]};
  else
    return {of[0], of[1], of[2]};
}
/// Returns a vector in numbers of another type.
template <class To, int D, class From>
RowVector<D, To> in_numbers(const RowVector<D, From>& of) {
  const auto from = components<D>(of);
  std::array<To, std::size_t(D)> to;
  for (std::size_t i = 0; i < D; ++i) to[i] = To(from[i]);
  return row_vector<D>(to);
}
/// N of a face or cell as a vector of the axes of the grid.
template <int D, class Real>
Point<D> normal_in_grid(const RowVector<D, Real>& normal) {
  if constexpr (D == 2)
    return {double(normal.x), double(normal.z)};
  else
    return {double(normal.x), double(normal.y), double(normal.z)};
}

/// The waves of an anisotropic cell in a sweep across curvilinear rows, where the face behind it has another
/// direction or another size than that before it (theory.md (F11), (F15)). Components are those of the pairs.
template <int D, class Number = double>
struct RowWaves {
  /// At a face: the motions of the waves, and their impedances, times the size of the face.
  struct Face {
    SmallMatrix<std::size_t(D), Number> motions;  // [wave][component]
    std::array<Number, std::size_t(D)> z;
  };
  std::array<Face, 2> faces;                     // before the cell and behind it
  std::array<Number, std::size_t(D)> courant_z;  // times dt/(rho h) the Courant numbers of the waves
};
/// For a stiffness times the density, with the volume J of the cell and N of it and of the faces before and
/// behind it.
template <int D>
RowWaves<D> waves_across_rows(const Elasticity<D>& elasticity, double j, const Point<D>& normal,
                              const std::array<Point<D>, 2>& normals_of_faces);
/// Returns the waves of the cell at which the metric begins.
template <int D, class Real>
RowWaves<D> waves_across_rows(const Elasticity<D>& elasticity, const CurvilinearAcross<Real>& metric) {
  const auto face = [&](std::int64_t at) {
    return normal_in_grid<D>(face_normal<D>(metric.half_n + at, metric.pitch));
  };
  return waves_across_rows<D>(elasticity, 1 / double(metric.over_j[0]),
                              normal_in_grid<D>(cell_normal<D>(metric.half_n, metric.pitch, metric.stride)),
                              {face(0), face(metric.stride)});
}
/// The impedances of a cell across a face with the vector N, for a stiffness times the density (theory.md
/// (F13)): the root of N.C.N, in the pairs of sweeps along an axis.
template <int D>
SmallMatrix<std::size_t(D)> impedance_across(const Elasticity<D>& elasticity, const Point<D>& normal,
                                             int axis = D - 1) {
  return in_pairs<D>(square_root_of(christoffel<D>(elasticity, normal)), axis);
}

/// A wave of such a cell as one pair (v, s) of numbers whose outgoing waves (E6), (E7), with the impedance
/// courant_z, are those of the wave: up through the face behind the cell, down through that before it. Both
/// are sums over the components of velocity, then of traction, by these weights (theory.md (F12)); `sign` is
/// -1 in a sweep back in time (E19).
template <int D, class Real>
struct WavePair {
  std::array<Real, std::size_t(2 * D)> v, s;
};
/// Motions are `step` values apart.
template <int D, class Real>
[[gnu::always_inline]] inline WavePair<D, Real> wave_pair(const Real* before, Real z_before,
                                                          const Real* behind, Real z_behind,
                                                          std::int64_t step, Real courant_z, Real sign) {
  const Real half = Real(0.5), over = half / courant_z;
  WavePair<D, Real> pair;
  for (std::size_t c = 0; c < D; ++c) {
    const Real lo = before[std::int64_t(c) * step], hi = behind[std::int64_t(c) * step];
    pair.v[c] = over * (z_behind * hi + z_before * lo);
    pair.v[D + c] = sign * over * (lo - hi);
    pair.s[c] = sign * half * (z_before * lo - z_behind * hi);
    pair.s[D + c] = half * (lo + hi);
  }
  return pair;
}

/// Outgoing waves through a face of curvilinear rows as outgoing_wave() resolves them, and back: in 2-D along
/// the normal of the face and across it, in 3-D they are vectors. `over`: 1/|N|.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> resolved_on_face(const RowVector<D, Real>& wave,
                                                                  const RowVector<D, Real>& normal,
                                                                  Real over) {
  if constexpr (D == 3)
    return wave;
  else
    return {over * (wave.z + normal.x * wave.x), over * (wave.x - normal.x * wave.z)};
}
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> from_face(const RowVector<D, Real>& resolved,
                                                           const RowVector<D, Real>& normal, Real over) {
  if constexpr (D == 3)
    return resolved;
  else
    return {over * (resolved.z - normal.x * resolved.x), over * (normal.x * resolved.z + resolved.x)};
}

}  // namespace slipwave::solver
