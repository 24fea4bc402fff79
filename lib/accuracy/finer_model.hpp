// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "scene/scene.hpp"

namespace slipwave {

/// The model of a scene that sw-layers made, in other cells, from the tops of its layers: finer cells have
/// finer geometry, not parts of the stairs and means of the old ones; where the scene attenuates it is the
/// unrelaxed one. Its history names the command; nothing where that is not all that made it, a file of a
/// horizon is gone, or the command does not give the model again, bit for bit. Throws a usage Error where a
/// side is no whole number of new cells.
std::optional<Model<2>> finer_model(const Scene<2>& scene, double spacing_m);
/// Whether there is one.
bool has_finer_geometry(const Scene<2>& scene);

}  // namespace slipwave
