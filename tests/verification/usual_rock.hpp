// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/full_space.hpp"

namespace slipwave::solver {

inline constexpr UniformMedium rock{4500, 2250, 2500};

}  // namespace slipwave::solver
