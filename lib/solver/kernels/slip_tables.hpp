// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/linear_slip_kernels.hpp"

namespace slipwave::solver {

/// What one instruction set offers for slip.
template <class Real>
struct SlipTables {
  SlipKernels<Real> (*of)(const SlipCase& of);
  GapKernel<Real> open_2d, open_3d;
  LinearSlipKernels<Real> (*linear)(const LinearSlipCase& of);
};

}  // namespace slipwave::solver
