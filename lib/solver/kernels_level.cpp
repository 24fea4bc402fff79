// The inner loops, compiled once for each instruction set: CMake sets SLIPWAVE_LEVEL to its name. Nothing
// from the standard library may be instantiated here: the linker could keep this copy for everybody.
#include "solver/kernel_tables.hpp"
#include "solver/reconstruction.hpp"

namespace slipwave::solver {

// Of the same level, in slip_level.cpp.
const SlipTables<float>& SLIPWAVE_SLIP_LEVEL(float);
const SlipTables<double>& SLIPWAVE_SLIP_LEVEL(double);

namespace {

/// Of a stretch of one material only the first cell is read.
template <bool Uniform>
constexpr std::int64_t of_material(std::int64_t i) {
  return Uniform ? 0 : i;
}

template <int Order, bool Uniform, int Sign, class Real>
void leave_in(std::int64_t n, std::int64_t stride, const Real* __restrict v, const Real* __restrict s,
              const Real* __restrict impedance, const Real* __restrict b, Real size, Real* __restrict up,
              Real* __restrict down) {
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real z = impedance[of_material<Uniform>(i)];
    leave_cell<Order>(v + i, s + i, stride, Sign * z, size * (z * b[of_material<Uniform>(i)]), up[i],
                      down[i]);
  }
}

template <int Order, bool Uniform, class Real>
void leave(std::int64_t n, std::int64_t stride, const Real* v, const Real* s, const Real* impedance,
           const Real* b, Real scale, Real* up, Real* down) {
  if (scale < 0)
    leave_in<Order, Uniform, -1>(n, stride, v, s, impedance, b, -scale, up, down);
  else
    leave_in<Order, Uniform, 1>(n, stride, v, s, impedance, b, scale, up, down);
}

/// Where neither side carries a wave up = down = 0: this makes that 0/none instead of 0/0. Its square is
/// still a number.
constexpr double none = 1e-15;

template <bool Uniform, class Real>
void meet(std::int64_t n, const Real* __restrict up_p, const Real* __restrict down_p,
          const Real* __restrict up_s, const Real* __restrict down_s, const MaterialRows<Real>& lo,
          const MaterialRows<Real>& hi, const Faces<Real>& faces) {
  const Real *p_lo = lo.zp, *p_hi = hi.zp, *s_lo = lo.zs, *s_hi = hi.zs;
  Real* __restrict v_p = faces.v_p, * __restrict s_p = faces.s_p;
  Real* __restrict v_s = faces.v_s, * __restrict s_s = faces.s_s;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real sum_p = p_lo[m] + p_hi[m] + Real(none), sum_s = s_lo[m] + s_hi[m] + Real(none);
    const Real both = 1 / (sum_p * sum_s), share_p = both * sum_s, share_s = both * sum_p;
    v_p[i] = (up_p[i] + down_p[i]) * share_p;
    s_p[i] = (p_lo[m] * down_p[i] - p_hi[m] * up_p[i]) * share_p;
    v_s[i] = (up_s[i] + down_s[i]) * share_s;
    s_s[i] = (s_lo[m] * down_s[i] - s_hi[m] * up_s[i]) * share_s;
  }
}

template <bool Uniform, class Real>
void meet_p(std::int64_t n, const Real* __restrict up, const Real* __restrict down,
            const MaterialRows<Real>& lo, const MaterialRows<Real>& hi, const Faces<Real>& faces) {
  const Real *z_lo = lo.zp, *z_hi = hi.zp;
  Real* __restrict v = faces.v_p, * __restrict s = faces.s_p;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real share = 1 / (z_lo[m] + z_hi[m] + Real(none));
    v[i] = (up[i] + down[i]) * share;
    s[i] = (z_lo[m] * down[i] - z_hi[m] * up[i]) * share;
  }
}

template <bool Uniform, class Real>
void update(std::int64_t n, Real scale, const Faces<Real>& lo, const Faces<Real>& hi,
            const MaterialRows<Real>& material, const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v_p, * __restrict s_lo = lo.s_p, * __restrict w_lo = lo.v_s, * __restrict t_lo = lo.s_s;
  const Real* __restrict v_hi = hi.v_p, * __restrict s_hi = hi.s_p, * __restrict w_hi = hi.v_s, * __restrict t_hi = hi.s_s;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict vt = rows.vt, * __restrict st = rows.st;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real moved = scale * b[m], strained = size * b[m];
    // Times dt/h; multiplied first, so that the smallest velocities do not vanish on the way.
    const Real p_modulus = strained * zp[m] * zp[m], s_modulus = strained * zs[m] * zs[m];
    const Real dv = v_hi[i] - v_lo[i];
    v[i] += moved * (s_hi[i] - s_lo[i]);
    s[i] += p_modulus * dv;
    passive[i] += (p_modulus - 2 * s_modulus) * dv;
    vt[i] += moved * (t_hi[i] - t_lo[i]);
    st[i] += s_modulus * (w_hi[i] - w_lo[i]);
  }
}

template <bool Uniform, class Real>
void update_p(std::int64_t n, Real scale, const Faces<Real>& lo, const Faces<Real>& hi,
              const MaterialRows<Real>& material, const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v_p, * __restrict s_lo = lo.s_p, * __restrict v_hi = hi.v_p, * __restrict s_hi = hi.s_p;
  const Real* __restrict b = material.b, * __restrict zp = material.zp;
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real stress = size * b[m] * zp[m] * zp[m] * (v_hi[i] - v_lo[i]);
    v[i] += scale * b[m] * (s_hi[i] - s_lo[i]);
    s[i] += stress;
    passive[i] += stress;
  }
}

template <bool Uniform, class Real>
void meet_3d(std::int64_t n, const Leaving<Real>& below, const Leaving<Real>& above,
             const MaterialRows<Real>& lo, const MaterialRows<Real>& hi, const Faces<Real>& faces) {
  const Real *p_lo = lo.zp, *p_hi = hi.zp, *s_lo = lo.zs, *s_hi = hi.zs;
  const Real* __restrict up_p = below.up_p, * __restrict down_p = above.down_p;
  const Real* __restrict up_s = below.up_s, * __restrict down_s = above.down_s;
  const Real* __restrict up_s2 = below.up_s2, * __restrict down_s2 = above.down_s2;
  Real* __restrict v_p = faces.v_p, * __restrict s_p = faces.s_p;
  Real* __restrict v_s = faces.v_s, * __restrict s_s = faces.s_s;
  Real* __restrict v_s2 = faces.v_s2, * __restrict s_s2 = faces.s_s2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real sum_p = p_lo[m] + p_hi[m] + Real(none), sum_s = s_lo[m] + s_hi[m] + Real(none);
    const Real both = 1 / (sum_p * sum_s), share_p = both * sum_s, share_s = both * sum_p;
    v_p[i] = (up_p[i] + down_p[i]) * share_p;
    s_p[i] = (p_lo[m] * down_p[i] - p_hi[m] * up_p[i]) * share_p;
    v_s[i] = (up_s[i] + down_s[i]) * share_s;
    s_s[i] = (s_lo[m] * down_s[i] - s_hi[m] * up_s[i]) * share_s;
    v_s2[i] = (up_s2[i] + down_s2[i]) * share_s;
    s_s2[i] = (s_lo[m] * down_s2[i] - s_hi[m] * up_s2[i]) * share_s;
  }
}

template <bool Uniform, class Real>
void update_3d(std::int64_t n, Real scale, const Faces<Real>& lo, const Faces<Real>& hi,
               const MaterialRows<Real>& material, const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v_p, * __restrict s_lo = lo.s_p, * __restrict w_lo = lo.v_s, * __restrict t_lo = lo.s_s;
  const Real* __restrict v_hi = hi.v_p, * __restrict s_hi = hi.s_p, * __restrict w_hi = hi.v_s, * __restrict t_hi = hi.s_s;
  const Real* __restrict w2_lo = lo.v_s2, * __restrict t2_lo = lo.s_s2, * __restrict w2_hi = hi.v_s2, * __restrict t2_hi = hi.s_s2;
  const Real* __restrict b = material.b, * __restrict zp = material.zp, * __restrict zs = material.zs;
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict passive2 = rows.passive2;
  Real* __restrict vt = rows.vt, * __restrict st = rows.st, * __restrict vt2 = rows.vt2, * __restrict st2 = rows.st2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real moved = scale * b[m], strained = size * b[m];
    const Real p_modulus = strained * zp[m] * zp[m], s_modulus = strained * zs[m] * zs[m];
    const Real dv = v_hi[i] - v_lo[i], along = (p_modulus - 2 * s_modulus) * dv;
    v[i] += moved * (s_hi[i] - s_lo[i]);
    s[i] += p_modulus * dv;
    passive[i] += along;
    passive2[i] += along;
    vt[i] += moved * (t_hi[i] - t_lo[i]);
    st[i] += s_modulus * (w_hi[i] - w_lo[i]);
    vt2[i] += moved * (t2_hi[i] - t2_lo[i]);
    st2[i] += s_modulus * (w2_hi[i] - w2_lo[i]);
  }
}

template <bool Uniform, class Real>
void update_p_3d(std::int64_t n, Real scale, const Faces<Real>& lo, const Faces<Real>& hi,
                 const MaterialRows<Real>& material, const SweptRows<Real>& rows) {
  const Real size = scale < 0 ? -scale : scale;
  const Real* __restrict v_lo = lo.v_p, * __restrict s_lo = lo.s_p, * __restrict v_hi = hi.v_p, * __restrict s_hi = hi.s_p;
  const Real* __restrict b = material.b, * __restrict zp = material.zp;
  Real* __restrict v = rows.v, * __restrict s = rows.s, * __restrict passive = rows.passive, * __restrict passive2 = rows.passive2;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t m = of_material<Uniform>(i);
    const Real stress = size * b[m] * zp[m] * zp[m] * (v_hi[i] - v_lo[i]);
    v[i] += scale * b[m] * (s_hi[i] - s_lo[i]);
    s[i] += stress;
    passive[i] += stress;
    passive2[i] += stress;
  }
}

template <bool Along, bool Remember, class Real>
void stretch_in(std::int64_t n, const StretchFactors<Real>& factors, Real plate, const Real* plates,
                const Real* __restrict before, Real* __restrict now, Real* __restrict phi) {
  const Real *of_memory = factors.of_memory, *of_change = factors.of_change, *left = factors.left,
             *added = factors.added, *kept = factors.kept, *lost = factors.lost_in_plates;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t f = Along ? i : 0;
    const Real change = now[i] - before[i];
    const Real in_plate = Along ? plate : plates[i];
    now[i] = (now[i] - (of_memory[f] * phi[i] + of_change[f] * change)) * (kept[f] - in_plate * lost[f]);
    if constexpr (Remember) phi[i] = left[f] * phi[i] + added[f] * change;
  }
}

template <class Real>
void stretch_along(std::int64_t n, const StretchFactors<Real>& by_cell, Real plate, const Real* before,
                   Real* now, Real* phi, bool remember) {
  const auto loop = remember ? stretch_in<true, true, Real> : stretch_in<true, false, Real>;
  loop(n, by_cell, plate, nullptr, before, now, phi);
}

template <class Real>
void stretch_across(std::int64_t n, const StretchFactors<Real>& of_all, const Real* plates,
                    const Real* before, Real* now, Real* phi, bool remember) {
  const auto loop = remember ? stretch_in<false, true, Real> : stretch_in<false, false, Real>;
  loop(n, of_all, Real(0), plates, before, now, phi);
}

template <int Order, bool Uniform, class Real>
constexpr Kernels<Real> table = {leave<Order, Uniform, Real>, meet<Uniform, Real>,
                                 meet_p<Uniform, Real>,       update<Uniform, Real>,
                                 update_p<Uniform, Real>,     meet_3d<Uniform, Real>,
                                 update_3d<Uniform, Real>,    update_p_3d<Uniform, Real>};

template <bool Uniform, class Real>
const Kernels<Real>* of_order(int order) {
  switch (order) {
    case 1:
      return &table<1, Uniform, Real>;
    case 3:
      return &table<3, Uniform, Real>;
    case 5:
      return &table<5, Uniform, Real>;
    case 7:
      return &table<7, Uniform, Real>;
  }
  return nullptr;
}

template <class Real>
constexpr KernelTables<Real> tables = {of_order<false, Real>,
                                       of_order<true, Real>,
                                       {stretch_along<Real>, stretch_across<Real>},
                                       SLIPWAVE_SLIP_LEVEL};

}  // namespace

// SLIPWAVE_LEVEL is the name of this instruction set's entry points: kernels_x86_64_v3 and so on.
const KernelTables<float>& SLIPWAVE_LEVEL(float) { return tables<float>; }
const KernelTables<double>& SLIPWAVE_LEVEL(double) { return tables<double>; }

}  // namespace slipwave::solver
