// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Reconstruction of the outgoing waves of a cell at its two faces (theory.md (E4), (E5)): weights of the
/// sums and differences of its neighbours, polynomials in the Courant number a. Plain named scalars: both
/// compilers vectorise it. No standard header here: this is compiled once for each instruction set.
namespace slipwave::solver {

/// Weights of the even part, even[0] u_0 + even[1] (u_-1 + u_1) + ..., and of the odd part, odd[1] (u_1 -
/// u_-1)
/// + ..., of the time average over the step. Only constant indices: they become scalars.
template <int Order, class Real>
struct Weights {
  static constexpr int reach = (Order - 1) / 2;
  Real even[reach + 1], odd[reach + 1];
};

/// The weights of orders 9 and 11, of what weights() has computed.
template <int Order, class Real>
[[gnu::always_inline]] inline void high_weights(Real left, Real bent, Real q, Real more, Real most,
                                                Weights<Order, Real>& w) {
  Real *const even = w.even, *const odd = w.odd;
  const Real odd_2 = left * more, even_2 = bent * more, odd_3 = odd_2 * most, even_3 = even_2 * most;
  const Real most_4 = Real(3. / 14) + Real(1. / 14) * q;
  if constexpr (Order == 9) {
    even[1] = bent * (Real(3) + more * (Real(36. / 5) + most * (Real(135. / 7) + 56 * most_4)));
    even[2] = even_2 * (Real(-9. / 5) - most * (Real(54. / 7) + 28 * most_4));
    even[3] = even_3 * (Real(9. / 7) + 8 * most_4);
    even[4] = -even_3 * most_4;
    odd[4] = -odd_3 * most_4;
    odd[3] = odd_3 - 6 * odd[4];
    odd[2] = -odd_2 - 4 * odd_3 + 14 * odd[4];
    odd[1] = left + 2 * odd_2 + 5 * odd_3 - 14 * odd[4];
    even[0] = 1 - 2 * (even[1] + even[2] + even[3] + even[4]);
  } else {
    static_assert(Order == 11);
    const Real most_5 = Real(2. / 9) + Real(2. / 45) * q;
    const Real odd_4 = odd_3 * most_4, even_4 = even_3 * most_4;
    even[1] =
        bent * (Real(11. / 3) +
                more * (Real(44. / 5) + most * (Real(165. / 7) + most_4 * (Real(616. / 9) + 210 * most_5))));
    even[2] = even_2 * (Real(-11. / 5) - most * (Real(66. / 7) + most_4 * (Real(308. / 9) + 120 * most_5)));
    even[3] = even_3 * (Real(11. / 7) + most_4 * (Real(88. / 9) + 45 * most_5));
    even[4] = even_4 * (Real(-11. / 9) - 10 * most_5);
    even[5] = even_4 * most_5;
    odd[5] = odd_4 * most_5;
    odd[4] = -odd_4 - 8 * odd[5];
    odd[3] = odd_3 + 6 * odd_4 + 27 * odd[5];
    odd[2] = -odd_2 - 4 * odd_3 - 14 * odd_4 - 48 * odd[5];
    odd[1] = left + 2 * odd_2 + 5 * odd_3 + 14 * odd_4 + 42 * odd[5];
    even[0] = 1 - 2 * (even[1] + even[2] + even[3] + even[4] + even[5]);
  }
}

/// The weights at the Courant number a.
template <int Order, class Real>
[[gnu::always_inline]] inline void weights(Real a, Weights<Order, Real>& w) {
  // All but even[0] have the factor 1 - a, so they are exactly 0 where a = 1. A neighbour further out adds
  // multiples (alternating binomial coefficients) of its own two weights to those of the order below:
  // hardly anything is computed twice.
  const Real left = Real(1. / 4) - Real(1. / 4) * a;
  Real *const even = w.even, *const odd = w.odd;
  if constexpr (Order == 1) {
    even[0] = 1;
  } else if constexpr (Order == 3) {
    even[1] = left * (Real(1. / 3) - Real(2. / 3) * a);
    odd[1] = left;
    even[0] = 1 - 2 * even[1];
  } else {
    // The factors q + 2 and, from order 7 on, q + 6, q + 12, q + 20.
    const Real q = a * left, more = Real(1. / 6) + Real(1. / 3) * q, odd_2 = left * more;
    const Real bent = left * (Real(1. / Order) - Real(2. / Order) * a), even_2 = bent * more;
    if constexpr (Order == 5) {
      even[1] = bent * (Real(5. / 3) + 4 * more);
      even[2] = -even_2;
      odd[1] = left + 2 * odd_2;
      odd[2] = -odd_2;
      even[0] = 1 - 2 * (even[1] - even_2);
    } else {
      const Real most = Real(1. / 5) + Real(2. / 15) * q;
      if constexpr (Order == 7) {
        even[1] = bent * (Real(7. / 3) + more * (Real(28. / 5) + 15 * most));
        even[2] = even_2 * (Real(-7. / 5) - 6 * most);
        even[3] = even_2 * most;
        odd[3] = odd_2 * most;
        odd[2] = -odd_2 - 4 * odd[3];
        odd[1] = left + 2 * odd_2 + 5 * odd[3];
        even[0] = 1 - 2 * (even[1] + even[2] + even[3]);
      } else {
        high_weights(left, bent, q, more, most, w);
      }
    }
  }
}

/// Adds the neighbours K, K - 1, ... 1 cells away to both parts, the outermost first.
template <int K, int Order, class Real, class Value, class At>
[[gnu::always_inline]] inline void add_neighbours(const At& at, const Weights<Order, Real>& w, Value& even,
                                                  Value& odd) {
  const Value low = at(-K), high = at(K);
  if constexpr (K == (Order - 1) / 2) {
    odd = w.odd[K] * (high - low);
    even = w.even[K] * (low + high);
  } else {
    odd = w.odd[K] * (high - low) + odd;
    even = w.even[K] * (low + high) + even;
  }
  if constexpr (K > 1) add_neighbours<K - 1>(at, w, even, odd);
}

/// Even and odd part of a field around a cell: F_up = even + odd, F_down = even - odd. at(k) is the value, a
/// number or a vector, k cells further along the sweep.
template <int Order, class Real, class Value, class At>
[[gnu::always_inline]] inline void even_odd_of(const At& at, const Weights<Order, Real>& w, Value& even,
                                               Value& odd) {
  // even[0] is computed last of the weights: only one sum waits for it.
  const Value own = at(0);
  if constexpr (Order == 1) {
    even = w.even[0] * own;
    odd = Real(0) * own;
  } else if constexpr (Order == 3) {
    const Value low = at(-1), high = at(1);
    even = w.even[1] * (low + high) + w.even[0] * own;
    odd = w.odd[1] * (high - low);
  } else {
    add_neighbours<(Order - 1) / 2>(at, w, even, odd);
    even = w.even[0] * own + even;
  }
}

/// Even and odd part of a field of numbers, whose neighbours lie `stride` apart.
template <int Order, class Real>
[[gnu::always_inline]] inline void even_odd(const Real* u, long stride, const Weights<Order, Real>& w,
                                            Real& even, Real& odd) {
  if constexpr (Order == 1) {
    even = w.even[0] * u[0];
    odd = 0;
  } else {
    even_odd_of(
        [=](long k) __attribute__((always_inline)) { return u[k * stride]; }, w, even, odd);
  }
}

/// Outgoing waves of a pair (v, s) of one cell: up = Z F_up[v] - F_up[s], down = Z F_down[v] + F_down[s].
/// courant: c dt/h of the wave times the fraction of the step, 0 to 1. `turned` is the impedance, or minus it
/// for a sweep back in time.
template <int Order, class Real>
[[gnu::always_inline]] inline void reconstruct_cell(const Real* v, const Real* s, long stride, Real turned,
                                                    Real courant, Real& up, Real& down) {
  Weights<Order, Real> w;
  Real v_even, v_odd, s_even, s_odd;
  weights(courant, w);
  even_odd(v, stride, w, v_even, v_odd);
  even_odd(s, stride, w, s_even, s_odd);
  const Real along = turned * v_even - s_odd;
  const Real against = turned * v_odd - s_even;
  up = along + against;
  down = along - against;
}

}  // namespace slipwave::solver
