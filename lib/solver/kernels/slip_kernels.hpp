// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "fracture/friction_policy.hpp"

namespace slipwave::solver {

/// Systems of slip planes that one kernel works on: one, or in 2-D two at right angles, which share their
/// shear stress.
template <class Real>
struct SlipPlanes {
  static constexpr int most_systems = 3, most_components = 6;
  /// Stress components in the order of SymmetricTensor. s_n = sum of `normal` s; tau_k = sum of `shear` s,
  /// diagonal ones halved; a change of tau_k changes s by `shear` times it (S4). One tangent in 2-D, two in
  /// 3-D.
  Real normal[most_systems][most_components];
  Real shear[2][most_components];
  FrictionConstants<Real> law[most_systems];
};

/// Neighbouring cells of a row, from the first one on.
template <class Real>
struct SlipRows {
  Real* stress;  // first component, the others `pitch` apart
  std::int64_t pitch;
  const Real* relaxation[2];  // mu dt/eta of each system, 0 in cells that do not slip
  Real* retained;             // SlipKernels::retained_rows, `retained_pitch` apart
  std::int64_t retained_pitch;
  // Read only with SlipCase::prestress_or_gap.
  const Real* prestress;  // s_n of each system, then tau
  std::int64_t prestress_pitch;
  const Real* gap[2];  // of each system (open), 0 where it cannot open
  // Only where the law has a state.
  Real* slip_m[2];          // slip of each system so far
  const Real* slip_per_pa;  // h/mu: slip that lowers the traction by 1 Pa
};

/// Cells of a plane that may open.
template <class Real>
struct GapRows {
  Real* stress;
  std::int64_t pitch;
  Real* gap;                     // strain by which planes are open, n.e.n
  const Real *lambda, *modulus;  // Lame's and lambda + 2 mu, Pa
  const Real* prestress;         // s_n
};

/// Inner loops of slip over n neighbouring cells of a row.
template <class Real>
struct SlipKernels {
  /// The slip correction of the stress at the end of an elastic step (S5), (S6), (S10).
  void (*slip)(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows);
  /// The explicit half, with which the next step begins.
  void (*begin)(std::int64_t n, const SlipPlanes<Real>& planes, const SlipRows<Real>& rows);
  /// Rows retained from step to step; before the first as `begin` leaves them at rest.
  int retained_rows;
};

/// Opens and closes the planes of system number `system` (S13).
template <class Real>
using GapKernel = void (*)(std::int64_t n, const SlipPlanes<Real>& planes, int system,
                           const GapRows<Real>& rows);

/// The case that a kernel is compiled for.
struct SlipCase {
  int dimensions = 2, systems = 1;  // two systems in 2-D only
  SlipCorrection correction = SlipCorrection::second;
  bool prestress_or_gap = false;  // whether rows have them
  FrictionLaw law = FrictionLaw::coulomb;
};

/// The kernels for the best instruction set of this processor.
template <class Real>
SlipKernels<Real> slip_kernels(const SlipCase& of);
template <class Real>
GapKernel<Real> gap_kernel(int dimensions);

}  // namespace slipwave::solver
