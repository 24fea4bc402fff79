#pragma once

/// Reconstruction of what a cell sends through its two faces (theory.md (E4), (E5)): weights of the sums and
/// differences of its neighbours, polynomials in the Courant number a by way of q = a (1 - a). Plain named
/// scalars: both compilers vectorise it. No standard header here: this is compiled once for each instruction
/// set.
namespace slipwave::solver {

/// Weights of the even part, e0 u_0 + e1 (u_-1 + u_1) + ..., and of the odd part, o1 (u_1 - u_-1) + ..., of
/// the time average over the step. Those beyond the reach of the order are 0.
template <int Order, class Real>
[[gnu::always_inline]] inline void weights(Real a, Real& e0, Real& e1, Real& e2, Real& e3, Real& o1, Real& o2,
                                           Real& o3) {
  e0 = 1;
  e1 = e2 = e3 = o1 = o2 = o3 = 0;
  if constexpr (Order > 1) {
    const Real left = 1 - a, q = a * left, bent = left - 2 * q;
    if constexpr (Order == 3) {
      e1 = Real(1. / 12) * bent;
      o1 = Real(1. / 4) * left;
      e0 = 1 - 2 * e1;
    } else if constexpr (Order == 5) {
      e1 = bent * (Real(7. / 60) + q * Real(1. / 60));
      e2 = bent * (Real(-1. / 120) + q * Real(-1. / 240));
      o1 = left * (Real(1. / 3) + q * Real(1. / 24));
      o2 = left * (Real(-1. / 24) + q * Real(-1. / 48));
      e0 = 1 - 2 * (e1 + e2);
    } else {
      static_assert(Order == 7);
      e1 = bent * (Real(113. / 840) + q * (Real(1. / 35) + q * Real(1. / 672)));
      e2 = bent * (Real(-13. / 840) + q * (Real(-1. / 112) + q * Real(-1. / 1680)));
      e3 = bent * (Real(1. / 840) + q * (Real(1. / 1260) + q * Real(1. / 10080)));
      o1 = left * (Real(3. / 8) + q * (Real(5. / 72) + q * Real(1. / 288)));
      o2 = left * (Real(-3. / 40) + q * (Real(-31. / 720) + q * Real(-1. / 360)));
      o3 = left * (Real(1. / 120) + q * (Real(1. / 180) + q * Real(1. / 1440)));
      e0 = 1 - 2 * (e1 + e2 + e3);
    }
  }
}

/// Even and odd part of the field u around a cell: F_up = even + odd, F_down = even - odd. u points at the
/// cell, neighbours lie `stride` apart.
template <int Order, class Real>
[[gnu::always_inline]] inline void even_odd(const Real* u, long stride, Real e0, Real e1, Real e2, Real e3,
                                            Real o1, Real o2, Real o3, Real& even, Real& odd) {
  even = e0 * u[0];
  odd = 0;
  if constexpr (Order >= 3) {
    const Real low = u[-stride], high = u[stride];
    even += e1 * (low + high);
    odd = o1 * (high - low);
  }
  if constexpr (Order >= 5) {
    const Real low = u[-2 * stride], high = u[2 * stride];
    even += e2 * (low + high);
    odd += o2 * (high - low);
  }
  if constexpr (Order >= 7) {
    const Real low = u[-3 * stride], high = u[3 * stride];
    even += e3 * (low + high);
    odd += o3 * (high - low);
  }
}

/// One cell's outgoing states of a pair (v, s): up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s].
/// courant: c dt/h of the wave times the part of the step, 0 to 1. `turned` is the impedance, or minus it for
/// a sweep back in time.
template <int Order, class Real>
[[gnu::always_inline]] inline void leave_cell(const Real* v, const Real* s, long stride, Real turned,
                                              Real courant, Real& up, Real& down) {
  Real e0, e1, e2, e3, o1, o2, o3, v_even, v_odd, s_even, s_odd;
  weights<Order>(courant, e0, e1, e2, e3, o1, o2, o3);
  even_odd<Order>(v, stride, e0, e1, e2, e3, o1, o2, o3, v_even, v_odd);
  even_odd<Order>(s, stride, e0, e1, e2, e3, o1, o2, o3, s_even, s_odd);
  const Real along = turned * v_even - s_odd;
  const Real against = turned * v_odd - s_even;
  up = along + against;
  down = along - against;
}

}  // namespace slipwave::solver
