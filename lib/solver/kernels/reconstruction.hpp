#pragma once

/// Reconstruction of the outgoing waves of a cell at its two faces (theory.md (E4), (E5)): weights of the
/// sums and differences of its neighbours, polynomials in the Courant number a. Plain named scalars: both
/// compilers vectorise it. No standard header here: this is compiled once for each instruction set.
namespace slipwave::solver {

/// Weights of the even part, e0 u_0 + e1 (u_-1 + u_1) + ..., and of the odd part, o1 (u_1 - u_-1) + ..., of
/// the time average over the step. Those beyond the reach of the order are 0.
template <int Order, class Real>
[[gnu::always_inline]] inline void weights(Real a, Real& e0, Real& e1, Real& e2, Real& e3, Real& o1, Real& o2,
                                           Real& o3) {
  e0 = 1;
  e1 = e2 = e3 = o1 = o2 = o3 = 0;
  if constexpr (Order > 1) {
    // All but e0 have the factor 1 - a, so they are exactly 0 where a = 1. A neighbour further out adds
    // multiples (alternating binomial coefficients) of its own two weights to those of the order below:
    // hardly anything is computed twice.
    const Real left = Real(1. / 4) - Real(1. / 4) * a;
    if constexpr (Order == 3) {
      e1 = left * (Real(1. / 3) - Real(2. / 3) * a);
      o1 = left;
      e0 = 1 - 2 * e1;
    } else {
      // The factors q + 2 and, of order 7, q + 6.
      const Real q = a * left, more = Real(1. / 6) + Real(1. / 3) * q, odd = left * more;
      if constexpr (Order == 5) {
        const Real bent = left * (Real(1. / 5) - Real(2. / 5) * a), even = bent * more;
        e1 = bent * (Real(5. / 3) + 4 * more);
        e2 = -even;
        o1 = left + 2 * odd;
        o2 = -odd;
        e0 = 1 - 2 * (e1 - even);
      } else {
        static_assert(Order == 7);
        const Real bent = left * (Real(1. / 7) - Real(2. / 7) * a), even = bent * more;
        const Real most = Real(1. / 5) + Real(2. / 15) * q;
        e1 = bent * (Real(7. / 3) + more * (Real(28. / 5) + 15 * most));
        e2 = even * (Real(-7. / 5) - 6 * most);
        e3 = even * most;
        o3 = odd * most;
        o2 = -odd - 4 * o3;
        o1 = left + 2 * odd + 5 * o3;
        e0 = 1 - 2 * (e1 + e2 + e3);
      }
    }
  }
}

/// Even and odd part of a field around a cell: F_up = even + odd, F_down = even - odd. at(k) is the value, a
/// number or a vector, k cells further along the sweep.
template <int Order, class Real, class Value, class At>
[[gnu::always_inline]] inline void even_odd_of(const At& at, Real e0, Real e1, Real e2, Real e3, Real o1,
                                               Real o2, Real o3, Value& even, Value& odd) {
  // e0 is computed last of the weights: only one sum waits for it.
  const Value own = at(0);
  if constexpr (Order == 1) {
    even = e0 * own;
    odd = Real(0) * own;
  } else {
    const Value low = at(-1), high = at(1), sum = low + high, difference = high - low;
    if constexpr (Order == 3) {
      even = e1 * sum + e0 * own;
      odd = o1 * difference;
    } else {
      const Value low2 = at(-2), high2 = at(2), sum2 = low2 + high2, difference2 = high2 - low2;
      if constexpr (Order == 5) {
        odd = o2 * difference2;
        even = e2 * sum2;
      } else {
        const Value low3 = at(-3), high3 = at(3);
        odd = o3 * (high3 - low3);
        even = e3 * (low3 + high3);
        odd = o2 * difference2 + odd;
        even = e2 * sum2 + even;
      }
      odd = o1 * difference + odd;
      even = e1 * sum + even;
      even = e0 * own + even;
    }
  }
}

/// The same written out for a field of numbers, which all kernels but those of bent rows use: through calls
/// of at(k) the loop takes a tenth longer.
///
/// Even and odd part of the field u around a cell: F_up = even + odd, F_down = even - odd. u points at the
/// cell, neighbours lie `stride` apart.
template <int Order, class Real>
[[gnu::always_inline]] inline void even_odd(const Real* u, long stride, Real e0, Real e1, Real e2, Real e3,
                                            Real o1, Real o2, Real o3, Real& even, Real& odd) {
  // e0 is computed last of the weights: only one sum waits for it.
  const Real own = u[0];
  if constexpr (Order == 1) {
    even = e0 * own;
    odd = 0;
  } else {
    const Real low = u[-stride], high = u[stride], sum = low + high, difference = high - low;
    if constexpr (Order == 3) {
      even = e1 * sum + e0 * own;
      odd = o1 * difference;
    } else {
      const Real low2 = u[-2 * stride], high2 = u[2 * stride], sum2 = low2 + high2,
                 difference2 = high2 - low2;
      if constexpr (Order == 5) {
        odd = o2 * difference2;
        even = e2 * sum2;
      } else {
        const Real low3 = u[-3 * stride], high3 = u[3 * stride];
        odd = o3 * (high3 - low3);
        even = e3 * (low3 + high3);
        odd = o2 * difference2 + odd;
        even = e2 * sum2 + even;
      }
      odd = o1 * difference + odd;
      even = e1 * sum + even;
      even = e0 * own + even;
    }
  }
}

/// Outgoing waves of a pair (v, s) of one cell: up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s].
/// courant: c dt/h of the wave times the fraction of the step, 0 to 1. `turned` is the impedance, or minus it
/// for a sweep back in time.
template <int Order, class Real>
[[gnu::always_inline]] inline void reconstruct_cell(const Real* v, const Real* s, long stride, Real turned,
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
