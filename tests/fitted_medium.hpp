// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geology/fit.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// What lies under a horizon; a fluid has vs = 0, a void is all zeros.
struct Below {
  std::function<double(double x_m, double y_m)> depth_m;
  double vp = 0, vs = 0, rho = 0;
  double epsilon = 0, delta = 0, tilt = 0;
};

/// A medium on a grid whose rows follow the tops of its layers, all but the first, whose top is that of the
/// model unless what lies above it is void: then it is the surface, and the top of the grid. The grid is the
/// one that tools make (fit_grid()). Throws std::logic_error where a top is not followed.
template <int D>
Medium<D> fitted_medium(const Grid<D>& regular, const std::vector<Below>& layers, bool surface = false) {
  const auto columns = corner_columns(regular);
  const auto kind = [](const Below& layer) { return layer.vp == 0 ? 0 : layer.vs == 0 ? 1 : 2; };
  std::vector<FitHorizon> horizons;
  for (std::size_t n = surface ? 0 : 1; n < layers.size(); ++n) {
    FitHorizon horizon;
    horizon.name = "top_" + std::to_string(n);
    horizon.shown = "top of layer " + std::to_string(n);
    horizon.is_top = surface && n == 0;
    horizon.strong = n == 0 || kind(layers[n]) != kind(layers[n - 1]);
    horizon.role = horizon.is_top ? "surface" : horizon.strong ? "floor" : "layer";
    for (const auto& at : columns) horizon.depths_m.push_back(layers[n].depth_m(at[0], D == 3 ? at[1] : 0));
    horizons.push_back(std::move(horizon));
  }
  FitChoice all;
  all.always = true;
  const auto fit = fit_grid(regular, horizons, all);
  for (const auto& why : fit.left_out) throw std::logic_error(why);
  Medium<D> medium{Field<D>(fit.grid), Field<D>(fit.grid), Field<D>(fit.grid)};
  if (std::any_of(layers.begin(), layers.end(),
                  [](const Below& of) { return of.epsilon != 0 || of.delta != 0; }))
    for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
      medium[property] = Field<D>(fit.grid);
  for (std::int64_t n = 0; n < fit.grid.size(); ++n) {
    const auto row = fit.grid.index(n)[D - 1];
    std::size_t layer = 0;
    for (std::size_t top = 0; top < fit.rows.size(); ++top)
      if (row >= fit.rows[top]) layer = top + (surface ? 0 : 1);
    const auto cell = std::size_t(n);
    medium.vp[cell] = float(layers[layer].vp);
    medium.vs[cell] = float(layers[layer].vs);
    medium.rho[cell] = float(layers[layer].rho);
    if (!medium.has(Property::epsilon)) continue;
    medium[Property::epsilon][cell] = float(layers[layer].epsilon);
    medium[Property::delta][cell] = float(layers[layer].delta);
    medium[Property::tilt][cell] = float(layers[layer].tilt);
  }
  return medium;
}

/// z = depth + slope (x - x0).
inline std::function<double(double, double)> dipping(double depth_m, double slope, double x0_m = 0) {
  return [=](double x, double) { return depth_m + slope * (x - x0_m); };
}

}  // namespace slipwave
