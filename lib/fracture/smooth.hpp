// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Exponential and logarithm that both compilers turn into vectors. No standard header here: this is compiled
/// once for each instruction set (lib/solver/kernels/slip_level.cpp), and the linker may keep one copy of a
/// function for everybody.
namespace slipwave::smooth {

/// Bits of a float or double.
template <class Real>
struct Bits;
template <>
struct Bits<float> {
  using Whole = unsigned;
  static constexpr int mantissa = 23, bias = 127;
  /// Terms of the series below that matter.
  static constexpr int exponential_terms = 7, logarithm_terms = 5;
};
template <>
struct Bits<double> {
  using Whole = unsigned long long;
  static constexpr int mantissa = 52, bias = 1023;
  static constexpr int exponential_terms = 13, logarithm_terms = 11;
};

/// 1 - x/n (1 - x/(n + 1) (1 - ... - x/last)): unrolled, whatever a compiler thinks of the size of a loop.
template <int N, int Last, class Real>
[[gnu::always_inline]] inline Real alternating(Real x) {
  if constexpr (N > Last)
    return 1;
  else
    return 1 - alternating<N + 1, Last>(x) * x * Real(1. / N);
}
/// 1/(2 n + 1) + x/(2 n + 3) + ... + x^(last - n)/(2 last + 1)
template <int N, int Last, class Real>
[[gnu::always_inline]] inline Real of_artanh(Real x) {
  if constexpr (N == Last)
    return Real(1. / (2 * N + 1));
  else
    return of_artanh<N + 1, Last>(x) * x + Real(1. / (2 * N + 1));
}

/// No whole power of two is in exp(-x) below this x.
template <class Real>
constexpr Real near_zero = Real(0.34);

/// What x >= 0 leaves of 1 and takes off it; no digit of `lost` goes into the 1.
template <class Real>
struct Decay {
  Real left;  // exp(-x), held above the smallest normal number
  Real lost;  // 1 - exp(-x)
  Real mean;  // (1 - exp(-x))/x, only where x < near_zero
};

/// Relative errors: some roundings, and of x.
template <class Real>
[[gnu::always_inline]] inline Decay<Real> decay(Real x) {
  using B = Bits<Real>;
  using Whole = typename B::Whole;
  const Real limit = Real((B::bias - 2) * 0.69314718055994531);
  const Real held = x < limit ? x : limit;
  const Real scaled = held * Real(1.4426950408889634);
  // In the last bits of a number this large stands the nearest whole one: conversions are slow, or no
  // vectors.
  constexpr Real large = Real(3) * Real(Whole(1) << (B::mantissa - 1));
  const Real shifted = scaled + large, power = shifted - large;
  // exp(-x) = 2^-power exp(-rest), |rest| <= ln(2)/2; ln 2 in two parts keeps the digits of the rest.
  const Real high = Real(0.693145751953125), low = Real(1.428606820309417e-06);
  const Real rest = (held - power * high) - power * low;
  const Whole bits = (Whole(B::bias) - __builtin_bit_cast(Whole, shifted)) << B::mantissa;
  const Real halvings = __builtin_bit_cast(Real, bits), mean = alternating<2, B::exponential_terms>(rest);
  const Real lost = rest * mean;
  return {halvings * (1 - lost), (1 - halvings) + halvings * lost, mean};
}

/// ln(1 + x) for x >= 0.
template <class Real>
[[gnu::always_inline]] inline Real logarithm_of_one_more(Real x) {
  using B = Bits<Real>;
  using Whole = typename B::Whole;
  // 1 + x = 2^power m with m from 1/sqrt(2) to sqrt(2).
  const Real all = 1 + x;
  const Whole bits = __builtin_bit_cast(Whole, all),
              root_half = __builtin_bit_cast(Whole, Real(0.70710678118654752));
  const bool no_power = all < 2 * Real(0.70710678118654752);
  const Whole power = (bits - root_half) >> B::mantissa;
  const Real m = __builtin_bit_cast(Real, bits - (power << B::mantissa));
  // ln m = 2 artanh((m - 1)/(m + 1)); of a small x no digit may go into the 1.
  const Real s = (no_power ? x : m - 1) / (no_power ? 2 + x : m + 1), square = s * s;
  constexpr Real large = Real(Whole(1) << B::mantissa);
  const Real whole = __builtin_bit_cast(Real, __builtin_bit_cast(Whole, large) + power) - large;
  return whole * Real(0.69314718055994531) + 2 * s * of_artanh<0, B::logarithm_terms>(square);
}

}  // namespace slipwave::smooth
