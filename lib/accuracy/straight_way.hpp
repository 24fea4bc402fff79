// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/wave_train.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Speeds of the cell at a point, clamped to the model.
struct Speeds {
  double vp, vs;
};
Speeds speeds_at(const Medium<2>& medium, const Point<2>& point);

/// The straight way between two points, for waves of one kind. Empty where it does not carry them.
WayOfWave straight_way(const Medium<2>& medium, const Point<2>& from, const Point<2>& to, WaveKind kind);

/// From a point back along a direction to the edge of the model.
double way_in_model_m(const Grid<2>& grid, const Point<2>& to, const Point<2>& direction);

/// The way of a plane wave to a point, from where it enters: its path backwards leaves the model, through the
/// absorbing zone.
WayOfWave way_in_of_plane_wave(const Scene<2>& scene, const Source<2>& source, const PlaneWave<2>& wave,
                               const Point<2>& to);

}  // namespace slipwave
