#pragma once

#include <optional>

#include "model/model.hpp"

namespace slipwave {

/// A model of sw-layers in other cells, made from the tops of its layers: finer cells have finer geometry,
/// not parts of the stairs and means of the old ones. Its history names the command; nothing where that is
/// not all that made it, a file of a horizon is gone, or the command does not give the model again, bit for
/// bit. Throws a usage Error where a side is no whole number of new cells.
std::optional<Model<2>> finer_model(const Model<2>& model, double spacing_m);

}  // namespace slipwave
