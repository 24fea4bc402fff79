// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace slipwave {

/// The name of a file from its pattern: {shot} and {component} replaced. `shot` as messages number it.
std::string name_for(std::string pattern, std::size_t shot, const std::string& component);
/// Throws a usage Error on a misspelt mark, which would make a file of that name.
void check_marks(const std::string& pattern);
/// Whether a pattern holds the mark, "{shot}" or "{component}".
bool holds(const std::string& pattern, const std::string& mark);
/// Returns the name under which what an unstable run recorded is kept: "dir/unstable-out.sgy" for
/// "dir/out.sgy".
std::string unstable_name(std::string pattern);

}  // namespace slipwave
