// SPDX-License-Identifier: BSD-3-Clause
#include "traces/float_difference.hpp"

#include <bit>
#include <cassert>
#include <cstring>

namespace slipwave {
namespace {

// Four at a time, spelt out: compilers do not find the vectors behind a byte swap by themselves.
using Words = std::uint32_t __attribute__((vector_size(16)));
using Halves = std::uint16_t __attribute__((vector_size(16)));
using Floats = float __attribute__((vector_size(16)));

std::uint32_t swapped(std::uint32_t word) { return __builtin_bswap32(word); }

Words swapped(Words words) {
  const auto halves = std::bit_cast<Halves>(words << 16 | words >> 16);
  return std::bit_cast<Words>(halves << 8 | halves >> 8);
}

template <class Word, class Float, bool SwapA, bool SwapB>
void subtract_at(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* difference) {
  Word of_a, of_b;
  std::memcpy(&of_a, a, sizeof of_a);
  std::memcpy(&of_b, b, sizeof of_b);
  if (SwapA) of_a = swapped(of_a);
  if (SwapB) of_b = swapped(of_b);
  auto word = std::bit_cast<Word>(std::bit_cast<Float>(of_a) - std::bit_cast<Float>(of_b));
  if (SwapA) word = swapped(word);
  std::memcpy(difference, &word, sizeof word);
}

template <bool SwapA, bool SwapB>
void subtract_in(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* difference, std::size_t bytes) {
  std::size_t n = 0;
  for (; n + sizeof(Words) <= bytes; n += sizeof(Words))
    subtract_at<Words, Floats, SwapA, SwapB>(a + n, b + n, difference + n);
  for (; n < bytes; n += 4) subtract_at<std::uint32_t, float, SwapA, SwapB>(a + n, b + n, difference + n);
}

}  // namespace

void subtract_floats(std::span<const std::uint8_t> a, segy::Endian order_of_a,
                     std::span<const std::uint8_t> b, segy::Endian order_of_b,
                     std::span<std::uint8_t> difference) {
  assert(a.size() == b.size() && a.size() == difference.size() && a.size() % 4 == 0);
  const bool swap_a = order_of_a != segy::native_endian;
  const bool swap_b = order_of_b != segy::native_endian;
  const auto subtract = swap_a   ? swap_b ? subtract_in<true, true> : subtract_in<true, false>
                          : swap_b ? subtract_in<false, true>
                                 : subtract_in<false, false>;
  subtract(a.data(), b.data(), difference.data(), a.size());
}

}  // namespace slipwave
