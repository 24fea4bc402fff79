// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/reconstruction.hpp"

/// The formulas of a cell of a curvilinear row of a fitted grid (theory.md (F3), (F4)), each written once:
/// the loops of curvilinear_rows.hpp and the stencils at interfaces are made of these. No standard header
/// here, as in cell_formulas.hpp.
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

/// N of a face from the halves of its horizontal components, as in CurvilinearAcross.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> face_normal(const Real* half, long pitch) {
  if constexpr (D == 2)
    return {Real(1), half[0] + half[0]};
  else
    return {Real(1), half[0] + half[0], half[pitch] + half[pitch]};
}
/// N of the cell behind that face; `next` leads to the face behind the cell.
template <int D, class Real>
[[gnu::always_inline]] inline RowVector<D, Real> cell_normal(const Real* half, long pitch, long next) {
  if constexpr (D == 2)
    return {Real(1), half[0] + half[next]};
  else
    return {Real(1), half[0] + half[next], half[pitch] + half[pitch + next]};
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
                                                              RowVector<D, Real> normal) {
  const Real nx = normal.x;
  if constexpr (D == 2) {
    const Real sxx = field[2 * pitch], szz = field[3 * pitch], sxz = field[4 * pitch];
    return {szz + nx * sxz, sxz + nx * sxx};
  } else {
    const Real ny = normal.y;
    const Real sxx = field[3 * pitch], syy = field[4 * pitch], szz = field[5 * pitch];
    const Real sxy = field[6 * pitch], sxz = field[7 * pitch], syz = field[8 * pitch];
    return {szz + nx * sxz + ny * syz, sxz + nx * sxx + ny * sxy, syz + nx * sxy + ny * syy};
  }
}

/// A face between two rows: N and 1/|N|.
template <int D, class Real>
struct CurvilinearFace {
  RowVector<D, Real> normal;
  Real over;
};

[[gnu::always_inline]] inline float root_of(float square) { return __builtin_sqrtf(square); }
[[gnu::always_inline]] inline double root_of(double square) { return __builtin_sqrt(square); }

template <int D, class Real>
[[gnu::always_inline]] inline CurvilinearFace<D, Real> curvilinear_face(const RowVector<D, Real>& normal) {
  return {normal, 1 / root_of(dot(normal, normal))};
}

/// What leaves a cell through one of its faces (F4), resolved for that face: along its normal with the
/// reconstruction of P, across it with that of S; side is 1 up, -1 down. In 2-D the components along (N_z,
/// N_x)/|N| and (-N_x, N_z)/|N|, in 3-D, where there are two across, a vector.
template <class Real>
[[gnu::always_inline]] inline RowVector<2, Real> outgoing_wave(const RowVector<2, Real>& v_p,
                                                               const RowVector<2, Real>& t_p,
                                                               const RowVector<2, Real>& v_s,
                                                               const RowVector<2, Real>& t_s,
                                                               const CurvilinearFace<2, Real>& face,
                                                               Real side, Real zp, Real zs, bool carries_s) {
  const Real nx = face.normal.x, over_s = carries_s ? face.over : Real(0);
  return {zp * (v_p.z + nx * v_p.x) - side * face.over * (t_p.z + nx * t_p.x),
          zs * (v_s.x - nx * v_s.z) - side * over_s * (t_s.x - nx * t_s.z)};
}
template <class Real>
[[gnu::always_inline]] inline RowVector<3, Real> outgoing_wave(const RowVector<3, Real>& v_p,
                                                               const RowVector<3, Real>& t_p,
                                                               const RowVector<3, Real>& v_s,
                                                               const RowVector<3, Real>& t_s,
                                                               const CurvilinearFace<3, Real>& face,
                                                               Real side, Real zp, Real zs, bool carries_s) {
  const Real length = face.over * dot(face.normal, face.normal);
  const auto p = (zp * length) * v_p - side * t_p;
  const auto s = (zs * length) * v_s - (carries_s ? side : Real(0)) * t_s;
  return s + (face.over * face.over * dot(face.normal, p - s)) * face.normal;
}

/// What the reconstruction of a curvilinear cell reads besides fields: the normals of the faces before and
/// behind it, c dt/h |N|/J for c = 1/Z, and the impedances, turned in a sweep back in time.
template <int D, class Real>
struct CurvilinearCell {
  RowVector<D, Real> lower, upper;  // N of the faces towards lower and higher row coordinates
  Real courant_p, courant_s, zp, zs;
  bool carries_s;
};

/// The outgoing waves of a cell up and down (F4) through faces `upper` and `lower`, as outgoing_wave()
/// resolves them; v(k) and t(k) are velocity and traction k rows further.
template <int Order, int D, class Real, class V, class T>
[[gnu::always_inline]] inline void reconstruct_between(const V& v, const T& t,
                                                       const CurvilinearFace<D, Real>& lower,
                                                       const CurvilinearFace<D, Real>& upper, Real courant_p,
                                                       Real courant_s, Real zp, Real zs, bool carries_s,
                                                       RowVector<D, Real>& up, RowVector<D, Real>& down) {
  RowVector<D, Real> vp_even, vp_odd, tp_even, tp_odd, vs_even, vs_odd, ts_even, ts_odd;
  Weights<Order, Real> p, s;
  weights(courant_p, p);
  even_odd_of(v, p, vp_even, vp_odd);
  even_odd_of(t, p, tp_even, tp_odd);
  weights(courant_s, s);
  even_odd_of(v, s, vs_even, vs_odd);
  even_odd_of(t, s, ts_even, ts_odd);
  up = outgoing_wave(vp_even + vp_odd, tp_even + tp_odd, vs_even + vs_odd, ts_even + ts_odd, upper, Real(1),
                     zp, zs, carries_s);
  down = outgoing_wave(vp_even - vp_odd, tp_even - tp_odd, vs_even - vs_odd, ts_even - ts_odd, lower,
                       Real(-1), zp, zs, carries_s);
}
template <int Order, int D, class Real, class V, class T>
[[gnu::always_inline]] inline void reconstruct_curvilinear_cell(const V& v, const T& t,
                                                                const CurvilinearCell<D, Real>& cell,
                                                                RowVector<D, Real>& up,
                                                                RowVector<D, Real>& down) {
  reconstruct_between<Order, D>(v, t, curvilinear_face(cell.lower), curvilinear_face(cell.upper),
                                cell.courant_p, cell.courant_s, cell.zp, cell.zs, cell.carries_s, up, down);
}

}  // namespace slipwave::solver
