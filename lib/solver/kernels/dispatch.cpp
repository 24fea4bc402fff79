// SPDX-License-Identifier: BSD-3-Clause
#include "solver/kernels/kernels.hpp"

#include <cassert>
#include <cstring>

#include "base/instantiate.hpp"
#include "solver/kernels/kernel_tables.hpp"

namespace slipwave::solver {

#if defined(__x86_64__)
const KernelTables<float>& kernels_x86_64_v3(float);
const KernelTables<double>& kernels_x86_64_v3(double);
const KernelTables<float>& kernels_x86_64_v4(float);
const KernelTables<double>& kernels_x86_64_v4(double);
#endif
const KernelTables<float>& kernels_generic(float);
const KernelTables<double>& kernels_generic(double);

const char* instruction_set() {
#if defined(__x86_64__)
  // Before AVX2 vectors are those of every such processor: the generic kernels serve as well.
  const bool v3 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512vl");
  return v4 ? "x86-64-v4" : v3 ? "x86-64-v3" : "generic";
#else
  return "generic";
#endif
}

namespace {

template <class Real>
const KernelTables<Real>& best_tables() {
#if defined(__x86_64__)
  const char* level = instruction_set();
  if (!std::strcmp(level, "x86-64-v4")) return kernels_x86_64_v4(Real());
  if (!std::strcmp(level, "x86-64-v3")) return kernels_x86_64_v3(Real());
#endif
  return kernels_generic(Real());
}

}  // namespace

template <class Real>
const Kernels<Real>& kernels(int order, bool uniform) {
  const auto& tables = best_tables<Real>();
  const auto* found = uniform ? tables.of_order_uniform(order) : tables.of_order(order);
  assert(found);
  return *found;
}

template <class Real>
const PmlKernels<Real>& pml_kernels() {
  return best_tables<Real>().pml;
}

template <class Real>
InterpolationKernel<Real> interpolation_kernel() {
  return best_tables<Real>().interpolate;
}

template <class Real>
SlipKernels<Real> slip_kernels(const SlipCase& of) {
  return best_tables<Real>().slip(Real()).of(of);
}

template <class Real>
GapKernel<Real> gap_kernel(int dimensions) {
  const auto& tables = best_tables<Real>().slip(Real());
  return dimensions == 2 ? tables.open_2d : tables.open_3d;
}

template <class Real>
LinearSlipKernels<Real> linear_slip_kernels(const LinearSlipCase& of) {
  return best_tables<Real>().slip(Real()).linear(of);
}

template <class Real>
RelaxationKernel<Real> relaxation_kernel(int dimensions, Relaxing what, int mechanisms) {
  return best_tables<Real>().relaxation(Real()).of(dimensions, what, mechanisms);
}

template <class Real>
const SeriesKernels<Real>& series_kernels() {
  return best_tables<Real>().series(Real());
}

SLIPWAVE_INSTANTIATE_REAL(FUNCTION, series_kernels);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, relaxation_kernel);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, slip_kernels);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, linear_slip_kernels);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, gap_kernel);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, kernels);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, interpolation_kernel);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, pml_kernels);

}  // namespace slipwave::solver
