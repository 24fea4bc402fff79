// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "segy/bytes.hpp"

namespace slipwave {

/// a minus b of IEEE floats as they lie in files, into `difference` in a's byte order: the bits that
/// subtracting doubles and rounding to float would give (after one operation the second rounding does no
/// harm). What is not finite is kept. All spans have the same length, a multiple of 4.
void subtract_floats(std::span<const std::uint8_t> a, segy::Endian order_of_a,
                     std::span<const std::uint8_t> b, segy::Endian order_of_b,
                     std::span<std::uint8_t> difference);

}  // namespace slipwave
