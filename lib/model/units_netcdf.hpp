// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace slipwave {

class NetcdfFile;

/// What one unit of a variable is in SI, by its attribute "units": 1 for `small` ones and where there is no
/// unit, 1000 for `large` ones. Throws Error naming file, variable and unit.
double unit_factor(const NetcdfFile& file, const std::string& variable, const std::vector<std::string>& small,
                   const std::vector<std::string>& large);
/// Of lengths, in m or km.
double length_factor(const NetcdfFile& file, const std::string& variable);

}  // namespace slipwave
