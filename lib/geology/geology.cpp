// SPDX-License-Identifier: BSD-3-Clause
#include "geology/geology.hpp"

#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/well_log.hpp"

namespace slipwave {
namespace {

/// What could be followed in the cells it was asked for need not be in others.
FitChoice as_can_be(FitChoice choice) {
  choice.asked = false;
  return choice;
}

/// The layers in cells of that size, tops level beyond their ends.
std::vector<Layer> layers_in(double spacing_m, std::vector<Layer> layers) {
  for (auto& layer : layers) {
    if (layer.log) fill_from_log(layer, spacing_m);
    auto shape = layer.top.shape();
    shape.endless = true;
    layer.top = Horizon(std::move(shape));
  }
  return layers;
}

Fit<2> marmousi_fit(const Geology& geology, const Grid<2>& regular) {
  return fit_marmousi(regular, *geology.marmousi, as_can_be(geology.fit));
}
Medium<2> marmousi_in(const Geology& geology, const Grid<2>& grid) {
  return marmousi_medium(grid, *geology.marmousi, geology.average != Average::none);
}
Fit<3> marmousi_fit(const Geology&, const Grid<3>&) {
  throw Error("found a geology like Marmousi's in 3-D, expected it in 2-D");
}
Medium<3> marmousi_in(const Geology&, const Grid<3>& grid) { return Medium<3>(grid); }

}  // namespace

template <int D>
Fit<D> fit_of(const Geology& geology, const Grid<D>& regular) {
  if (geology.marmousi) return marmousi_fit(geology, regular);
  return fit_layers(regular, layers_in(regular.spacing_m, geology.layers), as_can_be(geology.fit));
}

template <int D>
Medium<D> medium_of(const Geology& geology, const Grid<D>& regular) {
  const auto fit = fit_of(geology, regular);
  if (geology.marmousi) return marmousi_in(geology, fit.grid);
  return layered_medium(fit.grid, layers_in(regular.spacing_m, geology.layers), geology.average, fit.rows);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, fit_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, medium_of);

}  // namespace slipwave
