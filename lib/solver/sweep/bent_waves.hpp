// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Both waves of an anisotropic cell in a sweep in 2-D, where the face behind it has another direction or
/// another size than that before it (theory.md (F11), (F12)). Components are along the axis of the sweep and
/// across it.
template <class Real>
struct BentWaves {
  /// At a face: the motion of the faster wave, and the impedances of both, times the size of the face.
  struct Face {
    Real along, across;
    std::array<Real, 2> z;
    Real along_of(std::size_t wave) const { return wave == 0 ? along : -across; }
    Real across_of(std::size_t wave) const { return wave == 0 ? across : along; }
  };
  std::array<Face, 2> faces;      // before the cell and behind it
  std::array<Real, 2> courant_z;  // times dt/(rho h) the Courant numbers of both waves
};

/// The metric of bent rows in 2-D as these cells read it: N_x of the cell, or of the face before the cell,
/// `at` values further; J of the cell, or of the face before (0) and behind (1) it.
template <class Real>
Real normal_of_cell(const BentAcross<Real>& metric, std::int64_t at) {
  return metric.half_n[at] + metric.half_n[at + metric.stride];
}
template <class Real>
Real normal_of_face(const BentAcross<Real>& metric, std::int64_t at) {
  return 2 * metric.half_n[at];
}
template <class Real>
Real height_of_cell(const BentAlong<Real>& metric, std::int64_t at) {
  return metric.half_x[at] + metric.half_x[at + 1];
}
template <class Real>
Real height_of_face(const BentAlong<Real>& metric, std::int64_t at, int side) {
  return 2 * (side ? metric.half_hi : metric.half_lo)[at];
}

/// Across the rows, of a stiffness times the density, with the volume J of the cell and the horizontal
/// components of N: of the cell and of the faces before and behind it.
BentWaves<double> waves_across_rows(const PlaneStiffness& stiffness, double j, double nx,
                                    const std::array<double, 2>& nx_of_faces);
/// Of the cell at which the metric begins.
template <class Real>
BentWaves<double> waves_across_rows(const PlaneStiffness& stiffness, const BentAcross<Real>& metric) {
  return waves_across_rows(
      stiffness, 1 / double(metric.over_j[0]), double(normal_of_cell(metric, 0)),
      {double(normal_of_face(metric, 0)), double(normal_of_face(metric, metric.stride))});
}

/// A wave of such a cell as one pair (v, s) of numbers whose outgoing waves (E6), (E7), with the impedance
/// courant_z, are those of the wave: up through the face behind the cell, down through that before it. Both
/// are sums of the components of velocity and traction; `sign` is -1 in a sweep back in time (E19).
template <class Real>
struct WavePair {
  struct Sum {
    Real v_along, v_across, t_along, t_across;
  };
  Sum v, s;
};
template <class Real>
[[gnu::always_inline]] inline WavePair<Real> wave_pair(const typename BentWaves<Real>::Face& before,
                                                       const typename BentWaves<Real>::Face& behind,
                                                       Real courant_z, std::size_t wave, Real sign) {
  const Real along_lo = before.along_of(wave), across_lo = before.across_of(wave), z_lo = before.z[wave];
  const Real along_hi = behind.along_of(wave), across_hi = behind.across_of(wave), z_hi = behind.z[wave];
  const Real half = Real(0.5), over = half / courant_z, turned = sign * over;
  return {
      {over * (z_hi * along_hi + z_lo * along_lo), over * (z_hi * across_hi + z_lo * across_lo),
       turned * (along_lo - along_hi), turned * (across_lo - across_hi)},
      {sign * half * (z_lo * along_lo - z_hi * along_hi), sign * half * (z_lo * across_lo - z_hi * across_hi),
       half * (along_lo + along_hi), half * (across_lo + across_hi)}};
}

/// What two waves of these sizes carry through a face of a bent row, along its normal and across it as
/// outgoing_wave() resolves it; nx: N_x, over: 1/|N|.
template <class Real>
[[gnu::always_inline]] inline void resolve_on_face(const typename BentWaves<Real>::Face& face, Real faster,
                                                   Real slower, Real nx, Real over, Real& along,
                                                   Real& across) {
  const Real z = face.along * faster - face.across * slower, x = face.across * faster + face.along * slower;
  along = over * (z + nx * x), across = over * (x - nx * z);
}

/// The impedances of the waves of a cell across a face of a bent row, of a stiffness times the density, along
/// the normal of the face (zz) and across it (xx), times the size |N| of the face; nx: N_x.
PlaneTensor impedance_across_rows(const PlaneStiffness& stiffness, double nx);

}  // namespace slipwave::solver
