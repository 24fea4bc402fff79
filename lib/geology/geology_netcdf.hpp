// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geology/geology.hpp"

namespace slipwave {

class NetcdfFile;

/// The variables of a geology in a model file (docs/formats.md, What its builder knows); none where the maker
/// is unknown.
void define_geology(NetcdfFile& file, const Geology& geology);
void put_geology(NetcdfFile& file, const Geology& geology);

/// Returns the geology of a model file; its maker is unknown where the file has none. Throws Error naming
/// file and variable.
Geology read_geology(const NetcdfFile& file);

}  // namespace slipwave
