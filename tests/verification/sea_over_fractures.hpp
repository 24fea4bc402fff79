// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lab.hpp"

namespace slipwave::solver {

/// Water over two rocks; fractures that take patches of rows, and some near an end that take whole rows.
inline Scene<2> sea_over_fractures() {
  constexpr std::int64_t nx = 330, nz = 120;
  constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000};
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 20 + i / 40) put(scene.model.medium, {i, k}, water);
      if (k > 90) put(scene.model.medium, {i, k}, soft);
      const bool cluster = k >= 50 && k < 60 && i >= 120 && i < 150, at_end = k >= 70 && k < 73 && i < 20;
      if (cluster) scene.model.fracture({i, k}) = 1;
      if (at_end) scene.model.fracture({i, k}) = 2;
    }
  const SlipSystem<2> level{{0, 1}, 0.5, 1000, 0}, upright{{1, 0}, 0.2, 2000, 5};
  scene.model.fracture_sets = {{"cracks", {level}}, {"block", {level, upright}}};
  scene.survey.sources = {{{700, 160}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {{560, 130}, {662.5, 261.3}, {620, 333}, {40, 362}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.12, 0.001};
  return scene;
}

}  // namespace slipwave::solver
