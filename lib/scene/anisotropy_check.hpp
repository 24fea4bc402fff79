// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/scene.hpp"

namespace slipwave {

/// Throws an Error where fractures cannot be computed in anisotropic rock (fault_in_anisotropic_rock()), and
/// names the effects of sw-shoot to switch off.
template <int D>
void check_anisotropy(const Scene<D>& scene);

}  // namespace slipwave
