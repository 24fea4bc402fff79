// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/relaxation_kernels.hpp"

namespace slipwave::solver {

/// What one instruction set offers for attenuation.
template <class Real>
struct RelaxationTables {
  RelaxationKernel<Real> (*of)(int dimensions, Relaxing what, int mechanisms);
};

}  // namespace slipwave::solver
