// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/units.hpp"

namespace slipwave {

class NetcdfFile;

/// How values of a variable become numbers in the unit `into`, by its attribute "units"; as they are where it
/// has none. Throws Error naming file, variable and unit where it does not convert.
UnitConversion conversion_of(const NetcdfFile& file, const std::string& variable, const std::string& into);

/// Values of a variable in the unit `into`, in double precision: scale_factor, add_offset and units applied.
/// Throws Error naming file and variable at a missing one.
std::vector<double> values_in(const NetcdfFile& file, const std::string& variable, const std::string& into);
/// A block of them, as NetcdfFile::get().
std::vector<double> values_in(const NetcdfFile& file, const std::string& variable, const std::string& into,
                              const std::vector<std::size_t>& start, const std::vector<std::size_t>& count);

/// Whether heights are counted downwards or upwards.
enum class VerticalSense { down, up };

/// Which way a vertical coordinate or a depth counts, as CF has it: by its attribute `positive` (in letters
/// of any case), which must not contradict its standard_name (CF 4.3), else by its standard_name, its
/// long_name or its own name: altitudes, heights and elevations count upwards, depths downwards. Nothing
/// where none of them says it. Throws Error naming file and variable where they contradict each other.
std::optional<VerticalSense> vertical_sense(const NetcdfFile& file, const std::string& variable);

/// Whether a name is that of something that counts upwards: an altitude, height or elevation.
bool names_height(const std::string& name);

/// Whether a dimension is the vertical one: its coordinate has axis "Z", `positive` or a name that counts up
/// or down; or it is called z or nz.
bool is_vertical(const NetcdfFile& file, const std::string& dimension);
/// Whether it is a horizontal one, along `axis` 'x' or 'y': by its name or the attribute axis.
bool is_horizontal(const NetcdfFile& file, const std::string& dimension, char axis);

/// Values of a vertical coordinate as depths in m, downwards. One without an attribute that says which way
/// they count is refused, unless it is called z or depth and has none below zero: that counts downwards.
std::vector<double> depths_of(const NetcdfFile& file, const std::string& variable);

}  // namespace slipwave
