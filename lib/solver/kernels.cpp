#include "solver/kernels.hpp"

#include <cassert>
#include <cstring>

namespace slipwave::solver {

#if defined(__x86_64__)
const Kernels<float>* kernels_x86_64_v2(int order, float);
const Kernels<double>* kernels_x86_64_v2(int order, double);
const Kernels<float>* kernels_x86_64_v3(int order, float);
const Kernels<double>* kernels_x86_64_v3(int order, double);
const Kernels<float>* kernels_x86_64_v4(int order, float);
const Kernels<double>* kernels_x86_64_v4(int order, double);
#endif
const Kernels<float>* kernels_generic(int order, float);
const Kernels<double>* kernels_generic(int order, double);

const char* instruction_set() {
#if defined(__x86_64__)
  const bool v2 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
  const bool v3 =
      v2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512vl");
  return v4 ? "x86-64-v4" : v3 ? "x86-64-v3" : v2 ? "x86-64-v2" : "generic";
#else
  return "generic";
#endif
}

template <class Real>
const Kernels<Real>& kernels(int order) {
  const Kernels<Real>* found = nullptr;
#if defined(__x86_64__)
  const char* level = instruction_set();
  if (!std::strcmp(level, "x86-64-v4")) found = kernels_x86_64_v4(order, Real());
  if (!std::strcmp(level, "x86-64-v3")) found = kernels_x86_64_v3(order, Real());
  if (!std::strcmp(level, "x86-64-v2")) found = kernels_x86_64_v2(order, Real());
#endif
  if (!found) found = kernels_generic(order, Real());
  assert(found);
  return *found;
}

template const Kernels<float>& kernels<float>(int);
template const Kernels<double>& kernels<double>(int);

}  // namespace slipwave::solver
