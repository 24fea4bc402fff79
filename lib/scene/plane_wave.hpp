// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "rock/averaging.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// How the incident wave of a plane wave is known in the zones outside the model.
enum class PlaneWaveKind {
  uniform,   // all of them lie in one medium
  vertical,  // along each side edge as the column of cells there lets it through (2-D, without bands)
  layered,   // the same layers lie along all absorbing sides
};

/// What a scene asks of a plane wave.
template <int D>
struct PlaneWaveWay {
  PlaneWaveKind kind = PlaneWaveKind::uniform;
  Index<D> entry{};            // a cell of the boundary that it enters by
  int entry_side = 0;          // of the last axis: 0 top, 1 bottom
  Index<D> column{};           // first cell of the column that holds the layers
  bool by_entry_only = false;  // of a vertical one: known in the zone it enters by, in no other
};

/// Throws an Error that says why the scene has no such wave: an edge it cannot enter by, layers that differ
/// between sides, fitted rows that are not level, attenuation; a wave that would already be somewhere else at
/// t = 0.
template <int D>
PlaneWaveWay<D> way_of_plane_wave(const Scene<D>& scene, const Source<D>& source);

/// Level layers, downwards.
struct LevelLayers {
  std::vector<Material> rocks;
  std::vector<double> depths_m;  // top of each layer and, behind the last, its bottom
  /// The number of the layer at a depth: the first or last beyond them.
  std::size_t at(double depth_m) const;
};

/// A way, and what is there: the rock of the boundary that the wave enters by and, where it is known in
/// layers, these.
template <int D>
struct PlaneWaveGround {
  PlaneWaveWay<D> way;
  Material rock;
  LevelLayers layers;
};

/// Throws as way_of_plane_wave(). Layers are those of the scene's own rows or, in their order, of the rows of
/// `bands`, the scenes of its bands of cells.
template <int D>
PlaneWaveGround<D> ground_of_plane_wave(const Scene<D>& scene, const Source<D>& source,
                                        const std::vector<Scene<D>>& bands = {});

}  // namespace slipwave
