// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/parse.hpp"
#include "model/model.hpp"

namespace slipwave {

/// The extent says where a model ends in cells of another size: where it did, or at the first face beyond,
/// cells that reach out being as at the edge.
enum class Extent { kept, covered };

/// Returns a model of the same geology in cells of another size; the extent stays and must be a whole number
/// of new steps (usage Error), or is covered. A new cell is fluid, solid or void, and fractured, as the old
/// cell its centre lies in (the one behind, where it lies on a face), and its material is the mean over the
/// parts of old cells of that kind in it (theory.md M1, M2; of other properties as their rows say), each part
/// weighted by its exact volume. So a cell split into whole ones gives copies of itself, and joining those
/// gives it back, bit for bit. A fitted grid follows the same horizons with other cells (fit_grid()), and
/// parts of old cells count by their heights between the same two horizons; Error where it cannot, or where
/// its bottom is not level. A cluster of slip planes whose edges cut larger cells slips in the share of each
/// that it fills.
template <int D>
Model<D> regridded(const Model<D>& model, double spacing_m, Extent extent = Extent::kept);

/// Returns the model made smoother by smaller cells, or averaged into larger ones (regridded()); its extent
/// stays and must be a whole number of new steps (usage Error). A smaller cell is fluid, solid or void, and
/// fractured, as the old cell its centre lies in; so no interface is smeared. Its properties are interpolated
/// (bi-, trilinearly) between the centres of the old cells round it that are of its kind, their weights
/// scaled up to 1: exact for linear fields where all of them are, never outside the range of the old values.
/// `average` = false interpolates for larger cells, too. No fitted grids.
template <int D>
Model<D> resampled(const Model<D>& model, double spacing_m, bool average = true,
                   Extent extent = Extent::kept);

/// The cells whose centres lie in `box`. x (and y) keep their coordinates; depth is counted from the new top,
/// which becomes the surface. The box must hold a cell and not reach out of the model (usage Error). No
/// fitted grids.
template <int D>
Model<D> cropped(const Model<D>& model, const Box<D>& box);

/// regridded() of a model on a fitted grid.
template <int D>
Model<D> refitted(const Model<D>& model, double spacing_m, Extent extent);

}  // namespace slipwave
