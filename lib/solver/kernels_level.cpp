// The inner loops, compiled once for each instruction set: CMake sets SLIPWAVE_LEVEL to its name. Nothing
// from the standard library may be instantiated here: the linker could keep this copy for everybody.
#include "solver/kernels.hpp"
#include "solver/reconstruction.hpp"

namespace slipwave::solver {
namespace {

template <int Order, int Sign, class Real>
void leave_in(std::int64_t n, std::int64_t stride, const Real* __restrict v, const Real* __restrict s,
              const Real* __restrict impedance, const Real* __restrict courant, Real scale,
              Real* __restrict up, Real* __restrict down) {
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i)
    leave_cell<Order>(v + i, s + i, stride, Sign * impedance[i], courant[i], Sign * scale, up[i], down[i]);
}

template <int Order, class Real>
void leave(std::int64_t n, std::int64_t stride, const Real* v, const Real* s, const Real* impedance,
           const Real* courant, Real scale, Real* up, Real* down) {
  const auto loop = scale < 0 ? leave_in<Order, -1, Real> : leave_in<Order, 1, Real>;
  loop(n, stride, v, s, impedance, courant, scale, up, down);
}

template <class Real>
void meet(std::int64_t n, const Real* __restrict up_lo, const Real* impedance_lo,
          const Real* __restrict down_hi, const Real* impedance_hi, Real* __restrict v_face,
          Real* __restrict s_face) {
  // Where neither side carries the wave up = down = 0: `none` makes that 0/none instead of 0/0.
  const Real none = Real(1e-30);
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real zl = impedance_lo[i], zr = impedance_hi[i];
    const Real share = 1 / (zl + zr + none);
    v_face[i] = (up_lo[i] + down_hi[i]) * share;
    s_face[i] = (zl * down_hi[i] - zr * up_lo[i]) * share;
  }
}

template <int Passive, class Real>
void update_passive(std::int64_t n, Real scale, const Real* __restrict v_lo, const Real* __restrict v_hi,
                    const Real* __restrict s_lo, const Real* __restrict s_hi, const Real* __restrict b,
                    const Real* __restrict zp, const Real* __restrict cp, const Real* __restrict zs,
                    const Real* __restrict cs, Real* __restrict v, Real* __restrict s,
                    Real* __restrict passive_1, Real* __restrict passive_2) {
  const Real size = scale < 0 ? -scale : scale;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real dv = size * (v_hi[i] - v_lo[i]);
    const Real modulus = zp[i] * cp[i];
    v[i] += scale * b[i] * (s_hi[i] - s_lo[i]);
    s[i] += modulus * dv;
    if constexpr (Passive > 0) {
      const Real lambda_dv = (modulus - 2 * zs[i] * cs[i]) * dv;
      passive_1[i] += lambda_dv;
      if constexpr (Passive > 1) passive_2[i] += lambda_dv;
    }
  }
}

template <class Real>
void update_normal(std::int64_t n, Real scale, const Real* v_lo, const Real* v_hi, const Real* s_lo,
                   const Real* s_hi, const Real* b, const Real* zp, const Real* cp, const Real* zs,
                   const Real* cs, Real* v, Real* s, Real* passive_1, Real* passive_2) {
  const auto loop = passive_2   ? update_passive<2, Real>
                    : passive_1 ? update_passive<1, Real>
                                : update_passive<0, Real>;
  loop(n, scale, v_lo, v_hi, s_lo, s_hi, b, zp, cp, zs, cs, v, s, passive_1, passive_2);
}

template <class Real>
void update_shear(std::int64_t n, Real scale, const Real* __restrict v_lo, const Real* __restrict v_hi,
                  const Real* __restrict s_lo, const Real* __restrict s_hi, const Real* __restrict b,
                  const Real* __restrict zs, const Real* __restrict cs, Real* __restrict v,
                  Real* __restrict s) {
  const Real size = scale < 0 ? -scale : scale;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    v[i] += scale * b[i] * (s_hi[i] - s_lo[i]);
    s[i] += size * zs[i] * cs[i] * (v_hi[i] - v_lo[i]);
  }
}

template <int Order, class Real>
constexpr Kernels<Real> table = {leave<Order, Real>, meet<Real>, update_normal<Real>, update_shear<Real>};

template <class Real>
const Kernels<Real>* of_order(int order) {
  switch (order) {
    case 1:
      return &table<1, Real>;
    case 3:
      return &table<3, Real>;
    case 5:
      return &table<5, Real>;
    case 7:
      return &table<7, Real>;
  }
  return nullptr;
}

}  // namespace

// SLIPWAVE_LEVEL is the name of this instruction set's pair of entry points: kernels_x86_64_v3 and so on.
const Kernels<float>* SLIPWAVE_LEVEL(int order, float) { return of_order<float>(order); }
const Kernels<double>* SLIPWAVE_LEVEL(int order, double) { return of_order<double>(order); }

}  // namespace slipwave::solver
