// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "accuracy/table.hpp"
#include "planning/scene_runs.hpp"

namespace slipwave {

/// Runs a scene by a setting and measures it against `exact`. Empty `exact`: the errors are NaN.
template <int D>
AccuracyRow measured(SceneRuns<D>& runs, const AccuracySetting& setting, const std::vector<Gather>& exact);

}  // namespace slipwave
