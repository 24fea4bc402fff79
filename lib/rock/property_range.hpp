// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "rock/property.hpp"

namespace slipwave {

/// Whether a property may have a value: within its row's range and finite, or what stands for it where it is
/// absent.
bool is_in_range(const PropertyRow& row, double value);

/// "a finite number from 0 to 90": what is_in_range() lets through.
std::string expected_values(const PropertyRow& row);

/// "NaN", or the shortest number that reads back as that float, which values of a model are.
std::string shown_float(double value);

}  // namespace slipwave
