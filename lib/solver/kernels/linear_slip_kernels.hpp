// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "solver/kernels/slip_kernels.hpp"

namespace slipwave::solver {

/// Neighbouring cells of a row whose planes give way as springs, from the first one on. Rows of memory and of
/// coefficients are `pitch_of_rows` apart. Of one family of planes components are those of its traction,
/// normal and then tangential, D in all; of several those of the stress.
///   memory        r: what the planes have taken off each component, the explicit half of the next step
///                 included; d: of it, in the last step; of dashpots what they leave of r and of the start of
///                 the step; where planes also slide the tangential traction at the end of the step.
///   coefficients  one family: lambda/(lambda + 2 mu); of_end, normal and tangential (S20); of dashpots left
///                 and of_start of both; where planes slide what follows.
///                 several: r of the stress of welded planes, row after row of a matrix; where planes slide r
///                 of the stress.
template <class Real>
struct LinearSlipRows {
  Real* stress;  // first component, the others `pitch` apart
  std::int64_t pitch;
  Real* memory;
  const Real* coefficients;
  std::int64_t pitch_of_rows;
  Real ahead;  // the share of d that the planes take before a step: 1/2, or 0 in first order
};

/// The case that a kernel is compiled for. Dashpots belong to one family only.
struct LinearSlipCase {
  int dimensions = 2;
  bool one_family = true, damped = false, slides = false;

  int components() const { return one_family ? dimensions : dimensions * (dimensions + 1) / 2; }
  int memory_rows() const {
    return (damped ? 3 : 2) * components() + (slides && one_family ? dimensions - 1 : 0);
  }
  int coefficient_rows() const {
    if (one_family) return 3 + (damped ? 4 : 0) + (slides ? 1 : 0);
    return components() * components() * (slides ? 2 : 1);
  }
};

/// Inner loops over n neighbouring cells of a row: at the end of an elastic step, and the explicit half with
/// which the next step begins.
template <class Real>
struct LinearSlipKernels {
  using Kernel = void (*)(std::int64_t n, const SlipPlanes<Real>& planes, const LinearSlipRows<Real>& rows);
  Kernel end, begin;
};

/// The kernels for the best instruction set of this processor.
template <class Real>
LinearSlipKernels<Real> linear_slip_kernels(const LinearSlipCase& of);

}  // namespace slipwave::solver
