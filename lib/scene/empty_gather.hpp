// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parallel/ranks.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// The traces of a shot (1-based number) without samples: component by component in the order of
/// scene.recording, receivers in their order, each with its header and room for its samples. Collective where
/// there are ranks (may be null) that hold parts of the model.
template <int D>
Gather empty_gather(const Scene<D>& scene, std::size_t shot, Ranks* ranks = nullptr);

/// The samples of the record itself, from its own time 0 on (Recording::before_s).
Gather in_record(Gather gather, const Recording& recording);

}  // namespace slipwave
