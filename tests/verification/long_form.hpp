// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

namespace slipwave::solver {

/// Whether SLIPWAVE_LONG asks for the long form.
inline bool long_form() { return std::getenv("SLIPWAVE_LONG") != nullptr; }

}  // namespace slipwave::solver
