// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "parallel/ranks.hpp"
#include "rock/coefficients.hpp"
#include "scene/scene.hpp"
#include "scene/splitting.hpp"

namespace slipwave {

/// FastestAcrossCell of the cells beside each side of a model in a fitted grid, of the rows that its process
/// owns, by horizontal axis and side; m/s, 0 in void. Empty where the grid is regular.
template <int D>
std::array<std::array<std::vector<double>, 2>, 2> side_speeds(const Medium<D>& medium, const Subdomain& part);

/// Whether there is shear stress in a model: in solid cells, and in fluid whose rows are curvilinear.
template <int D>
bool has_shear(const Medium<D>& medium);
/// Whether an edge of the first `axes` axes absorbs.
template <int D>
bool any_edge_absorbs(const Scene<D>& scene, int axes = D);
/// Whether any cell is void: sweeps then correct free surfaces inside the model.
template <int D>
bool has_void(const Medium<D>& medium);

/// These return the largest speeds in the whole model of which a medium is a part, m/s.
template <int D>
double fastest_speed(const Medium<D>& medium, const Subdomain& part) {
  return part.fastest > 0 ? part.fastest : fastest_speed(medium);
}
template <int D>
double fastest_across_cells(const Medium<D>& medium, const Subdomain& part) {
  return part.fastest_across_cells > 0 ? part.fastest_across_cells : fastest_across_cells(medium);
}
/// Looks for these speeds once for a model that is as it will be shot; with_model() forgets them.
template <int D>
void note_speeds(Scene<D>& scene);

/// Whether sweeps along any axis correct surfaces inside the model: beside void, and where fluid stands
/// beside solid in two rows (in 3-D planes) that follow each other at upright interfaces (theory.md (E11a)).
template <int D>
bool corrects_inside(const Medium<D>& medium);

/// Whether rock in 3-D has to be swept by all three waves at once, somewhere: axes that are turned, or rows
/// that bend.
template <int D>
bool couples_pairs(const Medium<D>& medium, int order);

/// Returns for each set of fractures whether its planes lie askew (lie_askew()) in any whole cell of any part
/// of the model, and in any that its edge cuts.
template <int D>
std::vector<std::array<bool, 2>> askew_sets(const Scene<D>& scene);

/// Rows first <= row < last of a medium, counted from its first one, as a part of its grid.
template <int D>
Medium<D> rows_of(const Medium<D>& medium, std::int64_t first, std::int64_t last);

/// Steps of a time tile.
int steps_of_a_tile(const Tiling& tiling);

/// Cells by which the fields of a cell spread along an axis in a step at most: a sweep along it reads `reach`
/// more, free surfaces of the others `surface_reach` (by axis).
template <int D>
std::int64_t spread_of_a_step(const std::vector<SweepFraction>& splitting, int axis, std::int64_t reach,
                              const std::array<std::int64_t, std::size_t(D)>& surface_reach);

/// Rows (in 3-D planes) by which a stale cell spreads at most before rows of other processes are refreshed
/// again: in a time tile, which in bands is a sweep along the last axis and what follows it before the next.
template <int D>
std::int64_t spread_of_a_tile(const Scene<D>& scene);

/// The rows of a model on this grid that process `number` of `count` owns: each has about as many cells to
/// compute as the others, zones included. `scene` needs no model yet. Throws an Error where there are too few
/// rows for so many processes, or a source that cannot be distributed.
template <int D>
Subdomain subdomain_for(const Scene<D>& scene, const Grid<D>& whole, int number, int count);

/// Returns the rows of each of scenes_of_bands() that a process owns: all of them share the rows of all
/// bands, one band below the other. Both sides of a face between bands are with one process: each has all of
/// a band, as many rows of it as bands read of each other or more, or none (Subdomain::is_empty()).
template <int D>
std::vector<Subdomain> subdomains_for(const Scene<D>& scene, const std::vector<Scene<D>>& bands, int number,
                                      int count);

/// The largest `count` that subdomains_for() takes.
template <int D>
int most_processes(const Scene<D>& scene, const std::vector<Scene<D>>& bands);

/// The rows of the whole model that the process must hold: first <= row < second.
std::pair<std::int64_t, std::int64_t> rows_held(const Subdomain& part);

/// Cuts a scene that holds the whole model down to the rows that this process holds.
template <int D>
Scene<D> cut_to(Scene<D> whole, const Subdomain& part);

/// Collective: gives the subdomains of a scene what they need of the whole model.
template <int D>
void join(Scene<D>& scene, Ranks& ranks);

}  // namespace slipwave
