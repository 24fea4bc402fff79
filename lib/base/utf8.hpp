// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace slipwave {

/// Bytes of the UTF-8 character that begins at `at`, or 0 when none does (overlong forms, surrogates and code
/// points past the last are none).
std::size_t utf8_length(const std::string& text, std::size_t at);

}  // namespace slipwave
