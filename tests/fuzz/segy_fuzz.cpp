// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "segy_target.hpp"

// The libFuzzer side: arbitrary bytes in, half of the time with words of the headers changed.

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using slipwave::segy::As;
  const bool odd = size > 0 && data[size - 1] % 2 != 0;
  slipwave::segy::examine({data, size}, odd ? As::pipe : As::file);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  std::mt19937 random(seed);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  slipwave::segy::change_headers({data, size}, random);
  return random() % 4 == 0 ? LLVMFuzzerMutate(data, size, most) : size;
}
