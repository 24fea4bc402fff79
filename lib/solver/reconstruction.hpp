#pragma once

/// Reconstruction of what a cell sends through its two faces (theory.md (E4), (E5)), as sums of weights that
/// do not depend on the Courant number times powers of q = a (1 - a). Plain named scalars: both compilers
/// vectorise it. No standard header here: this is compiled once for each instruction set.
namespace slipwave::solver {

/// Even and odd part of the time average over the step, of the field u around a cell:
/// F_up = even + odd, F_down = even - odd. u points at the cell, neighbours lie `stride` apart.
template <int Order, class Real>
[[gnu::always_inline]] inline void even_odd(const Real* u, long stride, Real a, Real& even, Real& odd) {
  const Real u0 = u[0];
  if constexpr (Order == 1) {
    even = u0;
    odd = Real(0);
  } else {
    const Real low_1 = u[-stride], high_1 = u[stride];
    const Real sum_1 = low_1 + high_1 - 2 * u0, difference_1 = high_1 - low_1;
    const Real left = 1 - a;
    const Real q = a * left;
    Real g, h;
    if constexpr (Order == 3) {
      g = Real(1. / 12) * sum_1;
      h = Real(1. / 4) * difference_1;
    } else {
      const Real low_2 = u[-2 * stride], high_2 = u[2 * stride];
      const Real sum_2 = low_2 + high_2 - 2 * u0, difference_2 = high_2 - low_2;
      if constexpr (Order == 5) {
        g = (Real(7. / 60) * sum_1 - Real(1. / 120) * sum_2) +
            q * (Real(1. / 60) * sum_1 - Real(1. / 240) * sum_2);
        h = (Real(1. / 3) * difference_1 - Real(1. / 24) * difference_2) +
            q * (Real(1. / 24) * difference_1 - Real(1. / 48) * difference_2);
      } else {
        static_assert(Order == 7);
        const Real low_3 = u[-3 * stride], high_3 = u[3 * stride];
        const Real sum_3 = low_3 + high_3 - 2 * u0, difference_3 = high_3 - low_3;
        g = (Real(113. / 840) * sum_1 - Real(13. / 840) * sum_2 + Real(1. / 840) * sum_3) +
            q * ((Real(1. / 35) * sum_1 - Real(1. / 112) * sum_2 + Real(1. / 1260) * sum_3) +
                 q * (Real(1. / 672) * sum_1 - Real(1. / 1680) * sum_2 + Real(1. / 10080) * sum_3));
        h = (Real(3. / 8) * difference_1 - Real(3. / 40) * difference_2 + Real(1. / 120) * difference_3) +
            q * ((Real(5. / 72) * difference_1 - Real(31. / 720) * difference_2 +
                  Real(1. / 180) * difference_3) +
                 q * (Real(1. / 288) * difference_1 - Real(1. / 360) * difference_2 +
                      Real(1. / 1440) * difference_3));
      }
    }
    even = u0 + left * (1 - 2 * a) * g;
    odd = left * h;
  }
}

/// One cell's outgoing states of a pair (v, s): up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s].
/// courant >= 1/scale marks a cell that does not carry the wave (fluid for S, void): order 1 there, nothing
/// reached.
template <int Order, class Real>
[[gnu::always_inline]] inline void leave_cell(const Real* v, const Real* s, long stride, Real impedance,
                                              Real courant, Real scale, Real& up, Real& down) {
  Real a = scale * courant;
  a = a < Real(1) ? a : Real(1);
  Real v_even, v_odd, s_even, s_odd;
  even_odd<Order>(v, stride, a, v_even, v_odd);
  even_odd<Order>(s, stride, a, s_even, s_odd);
  const Real along = impedance * v_even - s_odd;
  const Real against = impedance * v_odd - s_even;
  up = along + against;
  down = along - against;
}

}  // namespace slipwave::solver
