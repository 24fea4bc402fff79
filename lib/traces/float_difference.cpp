#include "traces/float_difference.hpp"

#include <bit>
#include <cassert>
#include <cstring>

namespace slipwave {
namespace {

template <bool Swap>
float float_at(const std::uint8_t* from) {
  std::uint32_t word;
  std::memcpy(&word, from, 4);
  return std::bit_cast<float>(Swap ? __builtin_bswap32(word) : word);
}

template <bool SwapA, bool SwapB>
void subtract_in(const std::uint8_t* __restrict a, const std::uint8_t* __restrict b,
                 std::uint8_t* __restrict difference, std::size_t bytes) {
  for (std::size_t n = 0; n < bytes; n += 4) {
    auto word = std::bit_cast<std::uint32_t>(float_at<SwapA>(a + n) - float_at<SwapB>(b + n));
    if (SwapA) word = __builtin_bswap32(word);
    std::memcpy(difference + n, &word, 4);
  }
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
