// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "lab.hpp"
#include "model/layers.hpp"
#include "scene/scene.hpp"

namespace slipwave::solver {

/// A scene unlike those that the promise was fitted to; scene(parts) gives the same in cells of a part of the
/// size.
struct UnpreparedScene {
  std::string name;
  Point<2> size_m;
  double spacing_m, peak_hz, time_s;
  std::vector<std::string> layers;
  FitChoice fit;
  /// What lies at a place instead of the layers.
  std::function<std::optional<Material>(double x_m, double z_m)> body;
  Point<2> source_m;
  std::string mechanism;
  std::vector<Point<2>> receivers_m;
  bool free_surface;

  Scene<2> scene(int parts = 1) const {
    const double h = spacing_m / parts;
    std::vector<Layer> tops;
    for (const auto& layer : layers) tops.push_back(parse_layer(layer));
    const auto fitted = fit_layers<2>(grid_of_size<2>(size_m, h), tops, fit);
    Scene<2> scene;
    auto& medium = scene.model.medium;
    medium = layered_medium<2>(fitted.grid, tops, Average::isotropic, fitted.rows);
    const auto& grid = medium.grid();
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const auto at = grid.index(n);
      const double z = grid.rows ? grid.rows->centre(at) : grid.centre(1, at[1]);
      const auto found = body ? body(grid.centre(0, at[0]), z) : std::nullopt;
      if (!found) continue;
      medium.vp[std::size_t(n)] = float(found->vp);
      medium.vs[std::size_t(n)] = float(found->vs);
      medium.rho[std::size_t(n)] = float(found->rho);
    }
    scene.survey.sources = {
        {source_m, parse_mechanism<2>(mechanism), parse_wavelet("ricker:" + std::to_string(peak_hz)), 1e6}};
    for (const auto& at : receivers_m)
      if (std::hypot(at[0] - source_m[0], at[1] - source_m[1]) > 60) scene.survey.receivers_m.push_back(at);
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (free_surface) scene.edges[1][0] = EdgeLaw::free;
    scene.recording = {{Component::vx, Component::vz}, time_s, 0.001};
    scene.numerics.order = parts > 1 ? 7 : 5;
    scene.numerics.zone_cells = 20 * parts;
    check(scene);
    return scene;
  }
};

inline std::vector<UnpreparedScene> unprepared_scenes() {
  const auto line = [](double from_m, double to_m, double depth_m) {
    std::vector<Point<2>> places;
    for (double x = from_m; x <= to_m; x += 60) places.push_back({x, depth_m});
    return places;
  };
  FitChoice all;
  all.surfaces = all.floors = all.layers = true;
  const auto channel = [](double x, double z) -> std::optional<Material> {
    if (std::hypot((x - 560) / 130, (z - 260) / 36) > 1) return std::nullopt;
    return Material{1650, 0, 1100};
  };
  // The salt has a flank of 70 degrees and a rounded top.
  const auto salt = [](double x, double z) -> std::optional<Material> {
    const double top = 230 + (x - 650) * (x - 650) / 800;
    if (z < top || x < 500 + (z - 230) * std::tan(20 * std::numbers::pi / 180)) return std::nullopt;
    return Material{4500, 2600, 2160};
  };
  return {{"a channel filled with fluid under a sea floor that rolls",
           {1000, 600},
           5,
           14,
           0.8,
           {"-10:1500:0:1010", "sine,130,9,340:1900:950:1950", "410:2700:1500:2250"},
           all,
           channel,
           {420, 40},
           "explosion",
           line(70, 940, 60),
           true},
          {"a hill with a soft layer",
           {900, 420},
           4,
           16,
           0.7,
           {"sine,60,28,520,90:1300:700:1800", "sine,85,28,520,90:2300:1300:2150", "260:3300:1900:2400"},
           all,
           {},
           {250, 150},
           "force:0,1",
           line(60, 840, 150),
           true},
          {"salt with a steep flank",
           {1100, 700},
           5,
           14,
           0.9,
           {"0:2100:1050:2100", "180:2400:1250:2180", "420:2800:1500:2300"},
           {},
           salt,
           {330, 60},
           "explosion",
           line(60, 1040, 90),
           false}};
}

}  // namespace slipwave::solver
