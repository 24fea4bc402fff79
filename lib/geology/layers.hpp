// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geology/fit.hpp"
#include "geology/horizon.hpp"
#include "rock/averaging.hpp"
#include "rock/input_units.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// What cells that tops cut are made of: the material at their centre; the isotropic mean of their parts
/// (theory.md M1, M2); or, where all of them are isotropic solids in 2-D, that with the anisotropy of the
/// mean about the normal of the tops (theory.md (T1)), else the same.
enum class Average { none, isotropic, tilted };
/// By its name; throws a usage Error on others.
Average parse_average(std::string_view text);
std::string name_of(Average average);

/// What a layer is made of down to a depth below its top.
struct LayerBlock {
  double to_m = 0;
  Material material;
};

/// Samples of a log from which blocks of a layer are made, whatever the cells (fill_from_log()).
struct LayerLog {
  std::vector<double> depths_m;     // ascending
  std::vector<Material> materials;  // at them: all fluid or all solid
  std::optional<double> block_m;    // thickness of blocks; none: of cells
  bool layered = false;             // means of flat layers (Backus 1962), with their anisotropy
};

/// Everything below a top, down to the next layer. Properties may change linearly with depth below the top.
struct Layer {
  Horizon top;
  Material material;  // at the top
  Material gradient;  // what vp and vs (1/s) and rho (kg/m4) gain a metre below it; 0 by default
  std::vector<std::pair<Property, double>> others;  // of its other properties, all over the layer
  std::vector<LayerBlock> profile;  // in place of material and gradient, as of a log; the last continues
  std::optional<LayerLog> log;      // what the profile is made of

  Layer() = default;
  Layer(const Horizon& top, const Material& material, const Material& gradient = {})
      : top(top), material(material), gradient(gradient) {}
  /// A plane top (Horizon) and one material.
  Layer(double depth_m, double vp, double vs, double rho, double dip_deg = 0)
      : top(depth_m, dip_deg), material{vp, vs, rho} {}

  /// Takes the elastic ones of `others` into the material.
  void complete();
  /// Returns the value of an optional property: what its row says where the layer does not.
  double value(Property property) const;
  /// At a depth below the top; at the top where that is negative.
  Material at_depth(double below_top_m) const;
};

/// "DEPTH:VP:VS:RHO" or "DEPTH:VP:VS:RHO:DIP". DEPTH and DIP as Horizon::parse(); VP, VS and RHO are numbers,
/// or "A+K" and "A-K" for A at the top and K more or less with every metre below it. Behind them, after ':'
/// or blanks, other properties as NAME=VALUE ("qp=80 qs=40"), each once; VALUE may be inf. With "-" for VP
/// and VS stiffnesses are among them ("c11=26e9 c13=9e9 c33=20e9 c55=6e9"), Pa. Throws a usage Error, or one
/// that names a horizon's file. A is in `units`, K in SI whatever they are.
Layer parse_layer(std::string_view text, const InputUnits& units = {});

/// The grid of `size_m` in cells of `spacing_m`, its low corner at the origin. Throws a usage Error when a
/// side is no whole number of steps (to 1e-6 of a step) or the model would not fit this machine's memory.
template <int D>
Grid<D> grid_of_size(const Point<D>& size_m, double spacing_m);

/// The smallest grid in cells of `spacing_m` that holds `size_m`: the last cells along an axis reach beyond
/// it where that is no whole number of steps. Throws a usage Error when it would not fit this machine's
/// memory.
template <int D>
Grid<D> grid_over(const Point<D>& size_m, double spacing_m);

/// Throws a usage Error unless a curve or grid reaches the centres of all columns of a grid.
template <int D>
void check_reach(const Grid<D>& grid, const Horizon& top);

/// Lets rows of a regular grid follow tops of layers (fit_grid()); `rows` then has one entry a layer. A top
/// above or below all of the model, or at which nothing changes, is no horizon. Throws as layered_medium().
template <int D>
Fit<D> fit_layers(const Grid<D>& regular, const std::vector<Layer>& layers, const FitChoice& choice);

/// A layered medium. Everything below a top is its layer's, so a later layer lies under the earlier ones and
/// cuts them off where its top rises above theirs; what is above the first layer is void. A cell is solid,
/// fluid or void as the layer at its centre, that is the last one whose top is there or above; its material
/// is the mean over its parts of that kind, areas being cut off by the tops (theory.md M1, M2; exact for
/// planes, for curves with their chords across the cell, for grids with the plane nearest to their depths at
/// its edges), or as `average` says. Where
/// properties change with depth, each part has those at the centre of the cell, or at its top if that lies
/// below the centre. At least one layer, from the top down: planes by their depth at x = 0, and no top may
/// lie above the one before it all along the model (usage Error). A curve must reach from the first to the
/// last centre of a cell along x, a grid along y, too, and wants a model in 3-D (usage Error). Values:
/// check(). On a fitted grid `rows` says which tops its rows follow (Fit::rows): those part cells by rows,
/// the others cut them at their true depths.
template <int D>
Medium<D> layered_medium(const Grid<D>& grid, const std::vector<Layer>& layers,
                         Average average = Average::isotropic, const std::vector<std::int64_t>& rows = {});

/// Returns a sentence for each of these layers: those that a sine or a curve cuts off in a part of the model,
/// those that begin below it, and a first one that begins above it.
template <int D>
std::vector<std::string> cut_off_layers(const Grid<D>& grid, const std::vector<Layer>& layers);

}  // namespace slipwave
