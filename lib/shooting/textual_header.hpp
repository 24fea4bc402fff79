// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "segy/writer.hpp"
#include "shooting/provenance.hpp"

namespace slipwave {

/// What the textual header of SEG-Y says of a run: the program, the source, the scheme, the boundaries, and
/// the commands of the history.
template <int D>
segy::Heading textual_header_of(const Scene<D>& scene, const std::string& history,
                                const Provenance& provenance);

}  // namespace slipwave
