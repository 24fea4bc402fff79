// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/relaxation_tables.hpp"
#include "solver/kernels/series_kernels.hpp"
#include "solver/kernels/slip_tables.hpp"

namespace slipwave::solver {

/// The kernels of one instruction set: by order, for any material and for uniform runs.
template <class Real>
struct KernelTables {
  const Kernels<Real>* (*of_order)(int order);
  const Kernels<Real>* (*of_order_uniform)(int order);
  PmlKernels<Real> pml;
  InterpolationKernel<Real> interpolate;
  const SlipTables<Real>& (*slip)(Real);
  const RelaxationTables<Real>& (*relaxation)(Real);
  const SeriesKernels<Real>& (*series)(Real);
};

}  // namespace slipwave::solver
