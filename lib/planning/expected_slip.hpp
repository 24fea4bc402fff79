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

}  // namespace slipwave
