// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace slipwave::fuzz {

/// What a checkpoint of the small run of these tests holds after `passes` time tiles, without the
/// marks and the checksum around it; `shots` are finished.
std::vector<std::uint8_t> checkpoint_content(int passes, int shots);

/// Lets the small run continue from a checkpoint that holds this, its checksum right: it comes to its end, is
/// refused by an Error that names the file, or turns out unstable.
void go_on_from_content(std::span<const std::uint8_t> content);

/// The same from a file of these bytes.
void go_on_from_file(std::span<const std::uint8_t> file);

}  // namespace slipwave::fuzz
