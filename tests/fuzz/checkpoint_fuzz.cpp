// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "checkpoint_target.hpp"

// The first letter of an input says whether the rest is a whole file or what one holds whose checksum is
// right.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> rest(data + 1, size - 1);
  switch (data[0]) {
    case 'c':
      slipwave::fuzz::go_on_from_content(rest);
      break;
    case 'f':
      slipwave::fuzz::go_on_from_file(rest);
      break;
    default:
      return -1;  // kept out of the corpus
  }
  return 0;
}
