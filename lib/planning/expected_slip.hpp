// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// A sentence for each fracture set whose planes hardly slip under the waves of the survey, or slip as if
/// they were dry: the amplitude of the waves is that of the first source in a full space of the cluster's
/// rock, good for a factor of a few. None where slip and waves compete, or where nothing slides.
template <int D>
std::vector<std::string> expected_slip(const Scene<D>& scene);

/// A sentence for each fracture set in which the answer may depend on the size of the cells: planes slide
/// under the pressure of the waves, waves of eight cells along them grow by a factor e or more within half a
/// period (theory.md (S29)), and viscosity does not bound that before.
template <int D>
std::vector<std::string> cell_dependence(const Scene<D>& scene);

}  // namespace slipwave
