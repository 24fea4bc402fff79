// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "cli/tool.hpp"
#include "parallel/ranks.hpp"

namespace slipwave::cli {

/// Runs what several processes do together and says their errors once: one that all know of the first rank
/// says, any other the rank that has it. The context that `body` gets is quiet on all but the first.
/// `end_all` ends all ranks where one alone goes wrong: the others do not know, and would wait. Throws
/// EndSilently after an error.
void run_on_ranks(const Context& context, Ranks& ranks, const std::function<void(int status)>& end_all,
                  const std::function<void(const Context&)>& body);

}  // namespace slipwave::cli
