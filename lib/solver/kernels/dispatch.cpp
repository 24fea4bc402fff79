// SPDX-License-Identifier: BSD-3-Clause
#include "solver/kernels/kernels.hpp"

#include <cassert>
#include <iterator>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "solver/kernels/kernel_tables.hpp"

namespace slipwave::solver {

// CMake says for which instruction sets kernels_level.cpp was compiled.
#ifdef SLIPWAVE_HAS_KERNELS_x86_64_v4
const KernelTables<float>& kernels_x86_64_v4(float);
const KernelTables<double>& kernels_x86_64_v4(double);
#endif
#ifdef SLIPWAVE_HAS_KERNELS_x86_64_v3
const KernelTables<float>& kernels_x86_64_v3(float);
const KernelTables<double>& kernels_x86_64_v3(double);
#endif
#ifdef SLIPWAVE_HAS_KERNELS_generic
const KernelTables<float>& kernels_generic(float);
const KernelTables<double>& kernels_generic(double);
#endif

namespace {

/// An instruction set and the kernels that were compiled for it.
struct Level {
  const char* name;
  const KernelTables<float>& (*tables_float)(float);
  const KernelTables<double>& (*tables_double)(double);

  const KernelTables<float>& tables(float of) const { return tables_float(of); }
  const KernelTables<double>& tables(double of) const { return tables_double(of); }
};

/// The instruction sets that this build has kernels for, the best first.
constexpr Level levels[] = {
#ifdef SLIPWAVE_HAS_KERNELS_x86_64_v4
    {"x86-64-v4", kernels_x86_64_v4, kernels_x86_64_v4},
#endif
#ifdef SLIPWAVE_HAS_KERNELS_x86_64_v3
    {"x86-64-v3", kernels_x86_64_v3, kernels_x86_64_v3},
#endif
#ifdef SLIPWAVE_HAS_KERNELS_generic
    {"generic", kernels_generic, kernels_generic},
#endif
};

/// Whether this processor has an instruction set. Before AVX2 vectors are those of every such processor: the
/// generic kernels serve as well.
bool processor_has([[maybe_unused]] std::string_view level) {
#if defined(__x86_64__)
  const bool v3 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (level == "x86-64-v3") return v3;
  if (level == "x86-64-v4")
    return v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#endif
  return true;
}

/// The best level that this processor has. Throws Error where it has none of those of this build.
const Level& best_level() {
  for (const auto& level : levels)
    if (processor_has(level.name)) return level;
  throw Error(std::string("this build is for processors with the instruction set ") +
              std::end(levels)[-1].name +
              " (AVX-512 is v4, AVX2 v3), which this one lacks: configure it with -DSLIPWAVE_KERNELS=all");
}

template <class Real>
const KernelTables<Real>& best_tables() {
  return best_level().tables(Real());
}

}  // namespace

const char* instruction_set() { return best_level().name; }

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
