#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/reconstruction.hpp"

// No standard header here: this is compiled once for each instruction set, and the linker could keep one copy
// for everybody.
namespace slipwave::solver {

/// Where neither side carries a wave up = down = 0: this makes that 0/none instead of 0/0. Its square is
/// still a number.
inline constexpr double none = 1e-15;

namespace {

/// A row of a sweep across in one loop. It must say what leave, meet and update say, in the same words: then
/// it gives the same bits (Kernels.OfARowAcrossAtOnceGiveTheSameBits). What leaves downwards and half of the
/// values that are brought forward stay in registers; what waits for the memory or the division in one part
/// leaves the other parts room.
template <int Order, int Sign, class Real>
[[gnu::always_inline]] inline void across_in(std::int64_t n, Real scale, const FusedRow<Real>& rows) {
  const Real size = Sign < 0 ? -scale : scale;
  const std::int64_t stride = rows.stride, m = rows.material_pitch, ups = rows.up_pitch, f = rows.face_pitch;
  // The row that is brought forward is one that `leave` reads: a field has one pointer for both.
  constexpr int behind = Order < 3 ? 1 : (Order - 1) / 2;
  Real* __restrict v = rows.fields.v, * __restrict s = rows.fields.s, * __restrict passive = rows.fields.passive;
  Real* __restrict vt = rows.fields.vt, * __restrict st = rows.fields.st;
  const Real *below = rows.below, *here = rows.here, *done = rows.done;
  const Real* __restrict up_from = rows.up_from;
  Real* __restrict up_to = rows.up_to, * __restrict faces = rows.faces;
  const Real *lo = rows.lo, *hi = rows.hi;
#pragma omp simd
  for (std::int64_t i = 0; i < n; ++i) {
    const Real b = here[i], p_hi = here[i + m], s_hi = here[i + 2 * m];
    const Real p_lo = below[i + m], s_lo = below[i + 2 * m];
    Real up_p, down_p, up_s, down_s;
    reconstruct_cell<Order>(v + i, s + i, stride, Sign * p_hi, size * (p_hi * b), up_p, down_p);
    reconstruct_cell<Order>(vt + i, st + i, stride, Sign * s_hi, size * (s_hi * b), up_s, down_s);

    const Real sum_p = p_lo + p_hi + Real(none), sum_s = s_lo + s_hi + Real(none);
    const Real both = 1 / (sum_p * sum_s), share_p = both * sum_s, share_s = both * sum_p;
    const Real from_p = up_from[i], from_s = up_from[i + ups];
    up_to[i] = up_p;
    up_to[i + ups] = up_s;
    const Real v_p = (from_p + down_p) * share_p, s_p = (p_lo * down_p - p_hi * from_p) * share_p;
    const Real v_s = (from_s + down_s) * share_s, s_s = (s_lo * down_s - s_hi * from_s) * share_s;
    faces[i] = v_p;
    faces[i + f] = s_p;
    faces[i + 2 * f] = v_s;
    faces[i + 3 * f] = s_s;

    // Just one row behind these are the faces behind the cell.
    const Real v_hi = behind == 1 ? v_p : hi[i], n_hi = behind == 1 ? s_p : hi[i + f];
    const Real w_hi = behind == 1 ? v_s : hi[i + 2 * f], t_hi = behind == 1 ? s_s : hi[i + 3 * f];
    const Real b_i = done[i], zp_i = done[i + m], zs_i = done[i + 2 * m];
    const Real moved = scale * b_i, strained = size * b_i;
    const Real p_modulus = strained * zp_i * zp_i, s_modulus = strained * zs_i * zs_i;
    const Real dv = v_hi - lo[i], along = (p_modulus - 2 * s_modulus) * dv;
    const std::int64_t at = i - behind * stride;
    v[at] += moved * (n_hi - lo[i + f]);
    s[at] += p_modulus * dv;
    passive[at] += along;
    vt[at] += moved * (t_hi - lo[i + 3 * f]);
    st[at] += s_modulus * (w_hi - lo[i + 2 * f]);
  }
}

template <int Order, class Real>
void across(std::int64_t n, Real scale, const FusedRow<Real>& rows) {
  if (scale < 0)
    across_in<Order, -1>(n, scale, rows);
  else
    across_in<Order, 1>(n, scale, rows);
}

}  // namespace
}  // namespace slipwave::solver
