// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace slipwave {

/// Without the blanks, tabs and ends of lines at both ends.
std::string_view trimmed(std::string_view text);
/// In small letters, as far as they are ASCII.
std::string lower(std::string_view text);
/// Whether parse_number() takes it.
bool is_number(std::string_view text);

}  // namespace slipwave
