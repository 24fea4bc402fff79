// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "geology/fit.hpp"
#include "geology/layers.hpp"
#include "geology/marmousi.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// The tool that filled the cells of a model.
enum class Maker { unknown, sw_layers, sw_marmousi, sw_import };

/// How the cells that a model was imported from became its own.
enum class CellResampling { none, averaged, interpolated };

/// What the builder of a model knows of it besides its cells; model files hold it. A model in other cells is
/// made from it, as far as it still gives the model (ModelInCells).
struct Geology {
  Maker maker = Maker::unknown;
  FitChoice fit = {};                             // of sw-layers and sw-marmousi: what rows follow
  Average average = Average::tilted;              // of both: what cells with several materials are made of
  std::vector<Layer> layers = {};                 // of sw-layers
  std::optional<MarmousiSettings> marmousi = {};  // of sw-marmousi
  double sampled_m = 0;                           // of sw-import: size of the cells that were read
  CellResampling resampling = CellResampling::none;

  /// Whether it says what is where, not only how cells came about.
  bool knows_places() const { return !layers.empty() || marmousi.has_value(); }
};

/// How rows of a regular grid follow the horizons of a geology (Geology::fit), as far as they can. Throws as
/// fit_layers() and fit_marmousi().
template <int D>
Fit<D> fit_of(const Geology& geology, const Grid<D>& regular);

/// The medium of a geology in the cells of a regular grid, or of one whose rows follow its horizons as far as
/// they can (Geology::fit); tops of layers that end with the model it was built for are level beyond. Throws
/// as fit_layers(), layered_medium() and marmousi_medium().
template <int D>
Medium<D> medium_of(const Geology& geology, const Grid<D>& regular);

}  // namespace slipwave
