#pragma once

#include <cstdint>

namespace slipwave::solver {

/// Cells the widest reconstruction (order 7) reaches to each side.
constexpr int max_reach = 3;
/// Orders of the reconstruction; order 2m + 1 reads m cells to each side.
constexpr int orders[] = {1, 3, 5, 7};
constexpr int reach_of(int order) { return (order - 1) / 2; }

/// Inner loops of a sweep over n neighbouring cells of one line, for one order and one instruction set.
/// The direction lives in the arguments: `stride` leads from a cell to the next one along the sweep (1 along
/// x),
/// `_lo` and `_hi` are the faces before and behind each cell. n is a multiple of 16; cells beyond the
/// medium carry b = Z = 0 and stay as they are. One wave family is a pair (v, s): P (v_n, s_nn) or S (v_t,
/// s_nt).
/// A sweep back in time, scale < 0, is one forward in time of -v (E19): `leave` and the updates turn the sign
/// of v, and faces hold -v*.
template <class Real>
struct Kernels {
  /// What leaves every cell upwards and downwards within the time step (theory.md (E6), (E7)):
  /// up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s]; courant = c dt/h, scale = part of the step.
  void (*leave)(std::int64_t n, std::int64_t stride, const Real* v, const Real* s, const Real* impedance,
                const Real* courant, Real scale, Real* up, Real* down);
  /// The exact Riemann solution at the faces below (lo) and above (hi) which `up` and `down` meet (E8).
  void (*meet)(std::int64_t n, const Real* up_lo, const Real* impedance_lo, const Real* down_hi,
               const Real* impedance_hi, Real* v_face, Real* s_face);
  /// P update (E9): v += b [s*], s_nn += (lambda + 2 mu) dt/h [v*], and each passive normal stress += lambda
  /// dt/h [v*]. passive_1 may be null in a fluid-only or one-dimensional scene, passive_2 is null in 2-D.
  void (*update_normal)(std::int64_t n, Real scale, const Real* v_lo, const Real* v_hi, const Real* s_lo,
                        const Real* s_hi, const Real* b, const Real* zp, const Real* cp, const Real* zs,
                        const Real* cs, Real* v, Real* s, Real* passive_1, Real* passive_2);
  /// S update (E9): v_t += b [s_nt*], s_nt += mu dt/h [v_t*].
  void (*update_shear)(std::int64_t n, Real scale, const Real* v_lo, const Real* v_hi, const Real* s_lo,
                       const Real* s_hi, const Real* b, const Real* zs, const Real* cs, Real* v, Real* s);
};

/// Kernels of that order (1, 3, 5, 7) for the best instruction set of this processor.
template <class Real>
const Kernels<Real>& kernels(int order);

/// The instruction set `kernels` chose: "x86-64-v4", "x86-64-v3", "x86-64-v2" or "generic".
const char* instruction_set();

extern template const Kernels<float>& kernels<float>(int);
extern template const Kernels<double>& kernels<double>(int);

}  // namespace slipwave::solver
