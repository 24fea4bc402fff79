// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "rock/attenuation.hpp"

namespace slipwave::solver {

/// Cells whose memory lies together: the widest vector.
inline constexpr std::int64_t relaxation_block = 16;

/// Whole blocks of neighbouring cells of a row, from the first one on. Stresses are taken apart into their
/// mean, of which the bulk modulus relaxes shares, and what is left, of which the shear modulus does: in 2-D
/// half the difference of the normal stresses and sxz; in 3-D sxx and syy less the mean, sxy, sxz and syz.
template <class Real>
struct RelaxationRows {
  Real* stress;  // first component, the others `pitch` apart
  std::int64_t pitch;
  Real* memory;        // block after block: of mechanism l and part c in row l * parts + c of the block
  const Real* shares;  // the same: c_l times what of the bulk modulus mechanism l relaxes, then of the shear
                       // modulus
  const Real* axes;    // the same, of Relaxing::upright and turned: axis_values() numbers
  Real decays[most_mechanisms];  // c_l = 1 - exp(-rate_l time)
};

/// What relaxes: the pressure where it is all that is stored, the mean of the normal stresses, or all
/// stresses; or those about the axes of anisotropic rock, in 2-D (theory.md (Q9)), and in 3-D where they lie
/// along the grid or anywhere (Q11). In 3-D it may change from block to block.
enum class Relaxing { pressure, mean, all, upright, turned };
/// What is known of the axes of a cell: in 2-D the numbers of a RelaxingAxis, in 3-D the components of both
/// tensors of BulkTensors, the diagonal ones alone where axes lie along the grid.
constexpr int axis_values(int dimensions, Relaxing what) {
  if (dimensions == 2) return what == Relaxing::turned ? 4 : 0;
  return what == Relaxing::turned ? 12 : what == Relaxing::upright ? 6 : 0;
}
/// Parts of the stress that relax.
constexpr int relaxing_parts(int dimensions, Relaxing what) {
  return what == Relaxing::pressure || what == Relaxing::mean ? 1 : dimensions == 2 ? 3 : 6;
}

/// Relaxes n neighbouring cells of a row, a multiple of relaxation_block, at constant strain (theory.md
/// (Q7)).
template <class Real>
using RelaxationKernel = void (*)(std::int64_t n, const RelaxationRows<Real>& rows);

/// The kernel for the best instruction set of this processor.
template <class Real>
RelaxationKernel<Real> relaxation_kernel(int dimensions, Relaxing what, int mechanisms);

}  // namespace slipwave::solver
