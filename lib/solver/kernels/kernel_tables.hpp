#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/slip_tables.hpp"

namespace slipwave::solver {

/// What one instruction set offers: kernels by order, for any material and for stretches of one.
template <class Real>
struct KernelTables {
  const Kernels<Real>* (*of_order)(int order);
  const Kernels<Real>* (*of_order_uniform)(int order);
  PmlKernels<Real> stretch;
  SpongeKernels<Real> damp;
  const SlipTables<Real>& (*slip)(Real);
};

}  // namespace slipwave::solver
