#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace slipwave {

/// Told how far a long loop is; what it does with that is the caller's business (cli draws a bar).
/// Called as progress(done, total); empty = silent.
using Progress = std::function<void(std::int64_t done, std::int64_t total)>;

}  // namespace slipwave
