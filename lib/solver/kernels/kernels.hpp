// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scene/orders.hpp"

namespace slipwave::solver {

/// Cells first <= x < last of a row.
struct IndexRange {
  std::int64_t first = 0, last = 0;
  std::int64_t count() const { return last - first; }
  bool empty() const { return last <= first; }
};

/// Rows and columns: along the last axis and the one before it.
struct Box {
  IndexRange rows, columns;
  /// Whether it overlaps these.
  bool meets(const IndexRange& of_rows, const IndexRange& of_columns) const {
    return of_rows.first < rows.last && of_rows.last > rows.first && of_columns.first < columns.last &&
           of_columns.last > columns.first;
  }
};

/// Values at faces by pair: 0 P (v_n, s_nn), 1 and in 3-D 2 the S pairs (v_t, s_nt). Rows a pitch apart: a
/// struct of two words is passed in registers, while one that was just written to memory word by word is slow
/// to read back.
template <class Real>
struct InterfaceStates {
  Real* first;
  std::int64_t pitch;
  Real* v(int pair) const { return first + pitch * 2 * pair; }
  Real* s(int pair) const { return first + pitch * (2 * pair + 1); }
  InterfaceStates at(std::int64_t i) const { return {first + i, pitch}; }
};

/// Outgoing waves of cells up and down along the axis, by pair, in rows as InterfaceStates.
template <class Real>
struct OutgoingWaves {
  Real* first;
  std::int64_t pitch;
  Real* up(int pair) const { return first + pitch * 2 * pair; }
  Real* down(int pair) const { return first + pitch * (2 * pair + 1); }
  OutgoingWaves at(std::int64_t i) const { return {first + i, pitch}; }
};

/// Material of a range of cells (state.hpp): b = dt/(rho h) and impedances. Courant numbers are Z b.
template <class Real>
struct MaterialRows {
  const Real *b, *zp, *zs;
  const Real* coupling = nullptr;  // of anisotropic media: the density times c13
  // Of anisotropic media in 3-D, of the second S pair and the second passive stress.
  const Real *zs2 = zs, *coupling2 = coupling;
};

/// Fields of a range of cells that a sweep changes; those of the third axis in 2-D are not used, and where
/// all is fluid none but the first two.
template <class Real>
struct SweptRows {
  Real *v, *s, *passive, *vt, *st;
  Real *passive2 = passive, *vt2 = vt, *st2 = st;
};

/// Coefficients of the PML (Pml), one value for all cells or one per cell.
template <class Real>
struct PmlFactors {
  const Real *before, *after, *of_increments, *left, *of_recent, *of_newest, *recent_left,
      *lost_in_thick_plates, *lost_growing;
};

/// What all fields lose in the PML, by cell or of all cells: in terms of lost_in_thick_plates and of
/// lost_growing.
template <class Real>
struct PmlDamping {
  const Real *in_thick_plates, *growing;
};

/// Inner loops of a sweep at and between the faces of n neighbouring cells of one row, see Kernels. `lo` and
/// `hi` are the faces before and behind each cell.
template <class Real>
struct InterfaceKernels {
  /// The exact Riemann solutions at the faces between the outgoing waves `up` of the cells below (lo) and
  /// `down` of the cells above (hi) (E8), of all pairs, with one division.
  void (*solve_riemann)(std::int64_t n, OutgoingWaves<Real> up, OutgoingWaves<Real> down,
                        const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                        InterfaceStates<Real> faces);
  /// (E9): v += b [s*], s_nn += (lambda + 2 mu) dt/h [v*], passive normal stresses += lambda dt/h [v*];
  /// v_t += b [s_nt*], s_nt += mu dt/h [v_t*].
  void (*update)(std::int64_t n, Real scale, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                 const MaterialRows<Real>& material, const SweptRows<Real>& rows);
  /// Both in one in uniform runs, from the outgoing waves of the cells and of their neighbours below and
  /// above: there (E8) and (E9) reduce to (E9a).
  void (*update_uniform)(std::int64_t n, Real scale, OutgoingWaves<Real> below, OutgoingWaves<Real> here,
                         OutgoingWaves<Real> above, const MaterialRows<Real>& material,
                         const SweptRows<Real>& rows);
};

/// A row of a sweep across the rows whose loops are fused into one. The row that is reconstructed: its
/// `fields` and its material `here`, with `below` that of the row before; the outgoing waves upwards of that
/// one (up_from) and of this one (up_to), P and, up_pitch further, S; the faces between both. The row `done`,
/// which is updated, lies max(reach, 1) rows behind; lo and hi are the faces before and behind it. Pointers
/// to material and faces point at the first rows, the others follow a pitch apart.
template <class Real>
struct FusedRow {
  SweptRows<Real> fields;
  std::int64_t stride, material_pitch, up_pitch, face_pitch;
  const Real *below, *here, *done;
  const Real* up_from;
  Real *up_to, *faces;
  const Real *lo, *hi;
  const Real* coupling = nullptr;  // of the row `done` of an anisotropic medium
  // In 3-D also of the second passive stress, and of all three material rows from b to the impedances of P
  // and of both S pairs.
  const Real* coupling2 = nullptr;
  std::int64_t zp = 0, zs = 0, zs2 = 0;
};

/// The metric of a curvilinear row of a fitted grid for a sweep along a horizontal axis (theory.md (F2)):
/// half of J of the faces before and behind each cell, and of the faces before the cells along x, neighbours
/// along the axis a stride apart; 1/J of the cells. J of a cell is that of its faces along x added: what is
/// not stored need not be fetched.
template <class Real>
struct CurvilinearAlong {
  const Real *half_x, *half_lo, *half_hi;
  std::int64_t stride;
  const Real* over_j;
};
/// For the sweep along z (F3): half of the horizontal components of N, a pitch apart, of the faces before the
/// cells; a stride leads to the next row. N of a cell is the mean of its faces'. What the loops would need
/// roots and divisions for: |N|/J and 1/J of the cells, 1/|N| of the faces.
template <class Real>
struct CurvilinearAcross {
  const Real* half_n;
  std::int64_t pitch, stride;
  const Real *stretch = nullptr, *over_j = nullptr, *over_face = nullptr;
};
/// The fields of the pairs of a sweep along a horizontal axis, in 2-D two.
template <class Real>
struct CurvilinearPairs {
  const Real *v[3], *s[3];
};
/// All fields of a range of cells: field rows a pitch apart, rows of cells a stride.
template <class Real>
struct CurvilinearFields {
  Real* first;
  std::int64_t pitch, stride;
};

/// What the solution at a face across the rows reads and writes: outgoing waves, material and fields of the
/// cells before and behind it; its metric; the states, and the velocities that the cells above it see where
/// there is fluid.
template <class Real>
struct CurvilinearSolve {
  OutgoingWaves<Real> below, above;
  MaterialRows<Real> lo, hi;
  CurvilinearFields<const Real> fields_lo, fields_hi;
  CurvilinearAcross<Real> metric;
  InterfaceStates<Real> faces;
  Real* seen_above;
  std::int64_t seen_pitch;
};
/// What the update of a row reads and writes: the states at the faces before and behind it, where v_lo are
/// the velocities that its cells see.
template <class Real>
struct CurvilinearUpdate {
  InterfaceStates<Real> lo, hi;
  const Real* v_lo;
  std::int64_t v_lo_pitch;
  MaterialRows<Real> material;
  CurvilinearAcross<Real> metric;
  CurvilinearFields<Real> fields;
};

/// Loops of sweeps through curvilinear rows (curvilinear_rows.hpp), with shear everywhere. Across the rows
/// interface states are vectors, components z, x, [y], and outgoing waves as outgoing_wave() resolves them:
/// both are those of the pairs where a face is level.
template <class Real>
struct CurvilinearKernels {
  void (*reconstruct_along)(std::int64_t n, std::int64_t stride, const CurvilinearPairs<Real>& pairs,
                            const MaterialRows<Real>& material, Real scale,
                            const CurvilinearAlong<Real>& metric, OutgoingWaves<Real> outgoing);
  void (*solve_along)(std::int64_t n, OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                      const MaterialRows<Real>& lo, const MaterialRows<Real>& hi, const Real* half_face,
                      InterfaceStates<Real> faces);
  void (*update_along)(std::int64_t n, Real scale, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                       const MaterialRows<Real>& material, const Real* over_j, const SweptRows<Real>& rows);
  void (*reconstruct_across)(std::int64_t n, Real scale, const CurvilinearFields<const Real>& fields,
                             const MaterialRows<Real>& material, const CurvilinearAcross<Real>& metric,
                             OutgoingWaves<Real> outgoing);
  /// By whether there is fluid: else the velocity is the same on both sides, and `seen_above` not written.
  void (*solve_across[2])(std::int64_t n, Real sign, const CurvilinearSolve<Real>& at);
  void (*update_across)(std::int64_t n, Real scale, const CurvilinearUpdate<Real>& of);
  /// Both in one loop; the face must be none of the row's.
  void (*advance_across[2])(std::int64_t n, Real scale, const CurvilinearSolve<Real>& at,
                            const CurvilinearUpdate<Real>& of);
};

/// Inner loops of a sweep over n neighbouring cells of one row, for one order and one instruction set.
/// The direction lives in the arguments: `stride` leads from a cell to the next one along the sweep (1 along
/// x). Cells beyond the medium carry b = Z = 0 and stay as they are. A sweep back in time, scale < 0, is one
/// forward in time of -v (E19): reconstruction and update change the sign of v, and faces hold -v*.
template <class Real>
struct Kernels {
  /// Outgoing waves of every cell upwards and downwards within the time step (theory.md (E6), (E7)):
  /// up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s]; scale = fraction of the step.
  void (*reconstruct)(std::int64_t n, std::int64_t stride, const Real* v, const Real* s,
                      const Real* impedance, const Real* b, Real scale, Real* up, Real* down);
  /// Limits these outgoing waves by the criterion of monotonicity (C1), for steps forward in time.
  /// Material is read of neighbours, too, z_stride apart.
  void (*limit)(std::int64_t n, std::int64_t stride, const Real* v, const Real* s, std::int64_t z_stride,
                const Real* impedance, const Real* b, Real scale, Real* up, Real* down);
  /// By dimension (2-D, 3-D).
  InterfaceKernels<Real> face[2];
  /// The kernels of faces where all is fluid, in 2-D and 3-D: they treat the P pair alone, whose stress is
  /// that of all axes.
  InterfaceKernels<Real> fluid_face;
  /// The kernels of faces of anisotropic media, by dimension.
  InterfaceKernels<Real> anisotropic_face[2];
  /// Reconstruction, Riemann solution and update of a row across (null for uniform runs), by dimension.
  void (*fused_row[2])(std::int64_t n, Real scale, const FusedRow<Real>& rows);
  /// The fused row of an anisotropic medium, by dimension.
  void (*fused_anisotropic_row[2])(std::int64_t n, Real scale, const FusedRow<Real>& rows);
  /// The fused row where all is fluid, in 2-D and 3-D.
  void (*fused_fluid_row)(std::int64_t n, Real scale, const FusedRow<Real>& rows);
  /// By dimension.
  CurvilinearKernels<Real> curvilinear[2];
};

/// Loops of the PML over the field u of a row, its memory phi and that of recent increments alone.
template <class Real>
struct PmlKernels {
  /// With the increments r = u - before: u -= after phi + of_increments r and the damping of all fields, then
  /// phi = left phi + r: factors by cell and one damping of all. [1] does so with recent increments, phi =
  /// left phi + of_recent recent + of_newest r, then recent = recent_left recent + r - 2 after phi with the
  /// phi from before.
  using Damp = void (*)(std::int64_t n, const PmlFactors<Real>& factors, const PmlDamping<Real>& damping,
                        const Real* before, Real* u, Real* phi, Real* recent);
  Damp damp_along[2];
  /// Does what damp_along does with the same factors for all cells and the damping by cell.
  Damp damp_across[2];
  /// u -= before phi: factors by cell, then the same for all.
  void (*prepare_along)(std::int64_t n, const PmlFactors<Real>& by_cell, Real* u, const Real* phi);
  void (*prepare_across)(std::int64_t n, const PmlFactors<Real>& of_all, Real* u, const Real* phi);
};

/// Interpolates samples at equal intervals by quintics, at the places place + (first + i) step, counted in
/// samples: zero where fewer than six samples lie round a place. `count` is at least 6.
template <class Real>
using InterpolationKernel = void (*)(std::int64_t n, const float* samples, std::int64_t count, double place,
                                     double step, std::int64_t first, Real* to);

/// Kernels of that order for the best instruction set of this processor. `uniform`: those for
/// uniform runs, of which only the material of the first cell is read; they give the same bits. Throws Error,
/// as all of these do, where this build has none that this processor can run.
template <class Real>
const Kernels<Real>& kernels(int order, bool uniform);
template <class Real>
const PmlKernels<Real>& pml_kernels();
template <class Real>
InterpolationKernel<Real> interpolation_kernel();

/// The instruction set `kernels` chose: "x86-64-v4", "x86-64-v3" or "generic".
const char* instruction_set();

}  // namespace slipwave::solver
