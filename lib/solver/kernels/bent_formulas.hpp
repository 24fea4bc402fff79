#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/reconstruction.hpp"

/// The formulas of a cell of a bent row of a fitted grid (theory.md (F3), (F4)), each written once: the loops
/// of bent_rows.hpp and the stencils at interfaces are made of these. No standard header here, as in
/// cell_formulas.hpp.
namespace slipwave::solver {

/// A vector in the order of the pairs of a sweep along z: z, x, in 3-D y. The normal of a row is (1, N_x,
/// N_y)/|N|, so that at a level face the components are those of the pairs. Named members: both compilers
/// keep those in vector registers, arrays they do not.
template <int D, class Real>
struct RowVector;
template <class Real>
struct RowVector<2, Real> {
  Real z, x;
};
template <class Real>
struct RowVector<3, Real> {
  Real z, x, y;
};

template <class Real>
[[gnu::always_inline]] inline RowVector<2, Real> operator+(RowVector<2, Real> a, RowVector<2, Real> b) {
  return {a.z + b.z, a.x + b.x};
}
template <class Real>
[[gnu::always_inline]] inline RowVector<2, Real> operator-(RowVector<2, Real> a, RowVector<2, Real> b) {
  return {a.z - b.z, a.x - b.x};
}
template <class Real>
[[gnu::always_inline]] inline RowVector<2, Real> operator*(Real factor, RowVector<2, Real> a) {
  return {factor * a.z, factor * a.x};
}
template <class Real>
[[gnu::always_inline]] inline Real dot(RowVector<2, Real> a, RowVector<2, Real> b) {
  return a.z * b.z + a.x * b.x;
}
template <class Real>
[[gnu::always_inline]] inline RowVector<3, Real> operator+(RowVector<3, Real> a, RowVector<3, Real> b) {
  return {a.z + b.z, a.x + b.x, a.y + b.y};
}
template <class Real>
[[gnu::always_inline]] inline RowVector<3, Real> operator-(RowVector<3, Real> a, RowVector<3, Real> b) {
  return {a.z - b.z, a.x - b.x, a.y - b.y};
}
template <class Real>
[[gnu::always_inline]] inline RowVector<3, Real> operator*(Real factor, RowVector<3, Real> a) {
  return {factor * a.z, factor * a.x, factor * a.y};
}
template <class Real>
[[gnu::always_inline]] inline Real dot(RowVector<3, Real> a, RowVector<3, Real> b) {
  return a.z * b.z + a.x * b.x + a.y * b.y;
}

/// The vector N of a face or cell from its horizontal components, `pitch` apart.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> row_normal(const Real* horizontal, long pitch) {
  if constexpr (D == 2)
    return {Real(1), horizontal[0]};
  else
    return {Real(1), horizontal[0], horizontal[pitch]};
}

/// The velocity at a cell from field row 0 of it, rows `pitch` apart.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> row_velocity(const Real* field, long pitch) {
  if constexpr (D == 2)
    return {field[pitch], field[0]};
  else
    return {field[2 * pitch], field[0], field[pitch]};
}

/// The traction on the row at a cell times |N| (F3), T = s N.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> row_traction(const Real* field, long pitch,
                                                              const Real* horizontal, long normal_pitch) {
  const Real nx = horizontal[0];
  if constexpr (D == 2) {
    const Real sxx = field[2 * pitch], szz = field[3 * pitch], sxz = field[4 * pitch];
    return {szz + nx * sxz, sxz + nx * sxx};
  } else {
    const Real ny = horizontal[normal_pitch];
    const Real sxx = field[3 * pitch], syy = field[4 * pitch], szz = field[5 * pitch];
    const Real sxy = field[6 * pitch], sxz = field[7 * pitch], syz = field[8 * pitch];
    return {szz + nx * sxz + ny * syz, sxz + nx * sxx + ny * sxy, syz + nx * sxy + ny * syy};
  }
}

/// What leaves a cell through one of its faces, as a vector (F4): along the normal of the face with the
/// reconstruction of P, across it with that of S. z v_p - side t_p and so on; zp and zs times |N| of the
/// face.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> outgoing_wave(const RowVector<D, Real>& v_p,
                                                               const RowVector<D, Real>& t_p,
                                                               const RowVector<D, Real>& v_s,
                                                               const RowVector<D, Real>& t_s,
                                                               const RowVector<D, Real>& normal, Real inverse,
                                                               Real side, Real zp, Real zs, Real carries_s) {
  const auto p = zp * v_p - side * t_p, s = carries_s * (zs * v_s - side * t_s);
  return s + (inverse * dot(normal, p - s)) * normal;
}

/// What the reconstruction of a bent cell reads besides fields: the normals of the faces before and behind
/// it, c dt/h |N|/J for c = 1/Z, and the impedances, turned in a sweep back in time.
template <int D, class Real>
struct BentCell {
  RowVector<D, Real> lower, upper;  // N of the faces towards lower and higher row coordinates
  Real courant_p, courant_s, zp, zs, carries_s;
};

/// The outgoing waves of a cell up and down (F4); v(k) and t(k) are velocity and traction k rows further.
template <int Order, int D, class Real, class V, class T>
[[gnu::always_inline]] inline void reconstruct_bent_cell(const V& v, const T& t,
                                                         const BentCell<D, Real>& cell,
                                                         RowVector<D, Real>& up, RowVector<D, Real>& down) {
  RowVector<D, Real> vp_even, vp_odd, tp_even, tp_odd, vs_even, vs_odd, ts_even, ts_odd;
  Real e0, e1, e2, e3, o1, o2, o3;
  weights<Order>(cell.courant_p, e0, e1, e2, e3, o1, o2, o3);
  even_odd_of<Order>(v, e0, e1, e2, e3, o1, o2, o3, vp_even, vp_odd);
  even_odd_of<Order>(t, e0, e1, e2, e3, o1, o2, o3, tp_even, tp_odd);
  weights<Order>(cell.courant_s, e0, e1, e2, e3, o1, o2, o3);
  even_odd_of<Order>(v, e0, e1, e2, e3, o1, o2, o3, vs_even, vs_odd);
  even_odd_of<Order>(t, e0, e1, e2, e3, o1, o2, o3, ts_even, ts_odd);
  const Real upper = dot(cell.upper, cell.upper), lower = dot(cell.lower, cell.lower);
  const Real long_upper = __builtin_sqrt(upper), long_lower = __builtin_sqrt(lower);
  // One division for both.
  const Real both = 1 / (upper * lower);
  up = outgoing_wave<D>(vp_even + vp_odd, tp_even + tp_odd, vs_even + vs_odd, ts_even + ts_odd, cell.upper,
                        both * lower, Real(1), cell.zp * long_upper, cell.zs * long_upper, cell.carries_s);
  down = outgoing_wave<D>(vp_even - vp_odd, tp_even - tp_odd, vs_even - vs_odd, ts_even - ts_odd, cell.lower,
                          both * upper, Real(-1), cell.zp * long_lower, cell.zs * long_lower, cell.carries_s);
}

}  // namespace slipwave::solver
