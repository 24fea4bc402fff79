// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace slipwave {

/// Called with the progress of a long loop (cli draws a bar).
/// Called as progress(done, total); empty = silent.
using Progress = std::function<void(std::int64_t done, std::int64_t total)>;

}  // namespace slipwave
