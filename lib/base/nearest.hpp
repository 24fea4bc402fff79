// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace slipwave {

/// The word of `words` that `word` most likely meant, or "".
std::string nearest_of(const std::vector<std::string>& words, const std::string& word);

}  // namespace slipwave
