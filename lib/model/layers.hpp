#pragma once

#include <string_view>
#include <vector>

#include "model/averaging.hpp"
#include "model/model.hpp"

namespace slipwave {

/// Everything below a plane top surface, down to the next layer.
struct Layer {
  double depth_m = 0;  // of the top at x = 0
  double vp = 0, vs = 0, rho = 0;
  double dip_deg = 0;  // of the top: z = depth + x tan(dip), positive deepening towards +x

  Material material() const { return {vp, vs, rho}; }
};

/// "DEPTH:VP:VS:RHO" or "DEPTH:VP:VS:RHO:DIP". Throws a usage Error.
Layer parse_layer(std::string_view text);

/// The grid of `size_m` in cells of `spacing_m`, its low corner at the origin. Throws a usage Error when a
/// side is no whole number of steps (to 1e-6 of a step) or the model would not fit this machine's memory.
template <int D>
Grid<D> grid_of_size(const Point<D>& size_m, double spacing_m);

/// A layered medium. Everything below a top is its layer's, so a later layer lies under the earlier ones and
/// cuts them off where its top rises above theirs; what is above the first layer is void. A cell is solid,
/// fluid or void as the layer at its centre, that is the last one whose top is there or above; its material
/// is the mean over its parts of that kind, exact areas being cut off by the tops (theory.md M1, M2), or with
/// `average` = false that of the centre. Depths must not descend from layer to layer, |dip| < 90 degrees, at
/// least one layer. Values: check().
template <int D>
Medium<D> layered_medium(const Grid<D>& grid, const std::vector<Layer>& layers, bool average = true);

}  // namespace slipwave
