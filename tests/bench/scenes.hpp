// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave::bench {

/// How the material varies: one, four layers, or another one in each cell.
enum class Variety { uniform, layered, random };
const char* name_of(Variety variety);

/// What a run is made of; the defaults call for no effect at all.
struct Case {
  std::int64_t nx = 600, nz = 500;
  Variety variety = Variety::random;
  int order = 5;
  int time_order = 2;
  int threads = 1;
  bool double_precision = false;
  Tiling tiling;
  bool only_where_seen =
      false;  // leave out cells that no wave has reached or that affect no receiver any more
  EdgeLaw top = EdgeLaw::mirror, others = EdgeLaw::mirror;
  bool fluid = false;
  bool curvilinear =
      false;  // rows of a fitted grid that all are curvilinear, but for the first and the last face
  bool plane_wave = false;
  bool at_the_surface = false;  // source and receivers, else in the middle and above it
  double attenuating = 0;       // a quality factor of S waves in all cells, twice that of P waves; 0: elastic
  double slipping = 0;          // share of the cells, a box in the middle
  SlipCorrection correction = SlipCorrection::second;
  bool blocks = false, parting = false, under_stress = false;  // what else slip may be of
  int receivers = 1;                                           // spread over a line
  std::vector<Component> recorded = {Component::vx, Component::vz};
  double snapshot_every_s = 0;
  double duration_s = 100;  // of the traces, which the run need not reach
};

/// A scene of 5 m cells in memory, with an explosion (or a plane wave from above) that rings for two periods
/// of 20 Hz, at a Courant number of 0.4.
Scene<2> make_scene(const Case& what);

}  // namespace slipwave::bench
