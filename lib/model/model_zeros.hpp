// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/model.hpp"

namespace slipwave {

/// Gives the pages of zeros among a model's values, those of vs in a fluid say, back to the system; values
/// stay as they are. Reading them may take them again.
template <int D>
void release_zeros(const Model<D>& model);

}  // namespace slipwave
