// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "accuracy/ladder.hpp"
#include "accuracy/table.hpp"
#include "base/progress.hpp"

namespace slipwave {

/// All shots of a checked scene. `seconds` receives the processor time they took.
std::vector<Gather> shoot_all(const Scene<2>& scene, double& seconds, const Progress& progress = {});

/// Runs the scene by a setting and measures it against `exact`. Empty `exact`: the errors are NaN.
/// `result` receives the gathers if given.
AccuracyRow measured(const Scene<2>& scene, const AccuracySetting& setting, const std::vector<Gather>& exact,
                     const Progress& progress = {}, std::vector<Gather>* result = nullptr);

}  // namespace slipwave
