// SPDX-License-Identifier: BSD-3-Clause
#include "scene/plane_wave.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "rock/anisotropy.hpp"
#include "rock/plane_motion.hpp"
#include "rock/space_motion.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

/// Below it a direction counts as along an axis.
constexpr double least_share = 1e-9;

/// "vp 1500 vs 0 rho 1000 at x=5 z=10"
template <int D>
std::string described(const Medium<D>& medium, std::size_t cell) {
  std::string text;
  for (const Property property : medium.properties())
    text += row_of(property).name + ' ' + shown(medium[property][cell]) + ' ';
  return text + "at " + place_of(medium.grid(), std::int64_t(cell));
}

/// Calls `see` with all cells along a boundary, until it returns false.
template <int D, class See>
bool each_along_edge(const Grid<D>& grid, int axis, int side, const See& see) {
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    if (at[std::size_t(axis)] != (side ? grid.shape[std::size_t(axis)] - 1 : 0)) continue;
    if (!see(std::size_t(n), at)) return false;
  }
  return true;
}

/// The first cell along a boundary that differs from the reference or is void. The reference is the first
/// cell where there is none yet.
template <int D>
std::optional<std::size_t> other_medium(const Scene<D>& scene, int axis, int side,
                                        std::optional<std::size_t>& reference) {
  const auto& medium = scene.model.medium;
  std::optional<std::size_t> other;
  each_along_edge(medium.grid(), axis, side, [&](std::size_t cell, const Index<D>&) {
    if (!reference) reference = cell;
    if (!medium.same(cell, *reference) || medium.is_void(cell)) other = cell;
    return !other;
  });
  return other;
}

/// Refuses a boundary of more than one medium; `needs` says why.
template <int D>
void check_uniform_edge(const Scene<D>& scene, int axis, int side, const std::string& needs,
                        std::optional<std::size_t>& reference) {
  if (const auto other = other_medium(scene, axis, side, reference))
    throw Error(needs + ", found " + described(scene.model.medium, *reference) + " and " +
                described(scene.model.medium, *other));
}

/// `where`: where the wave must not be at t = 0.
template <int D>
[[noreturn]] void refuse_beginning(const std::string& where, const Grid<D>& grid, std::int64_t cell) {
  throw Error("at t = 0 the plane wave would already " + where + ", at " + place_of(grid, cell) +
              "; move --source back against its direction of travel");
}

/// Phase speed of the wave in a cell.
template <int D>
double speed_in(const Medium<D>& medium, std::size_t cell, const PlaneWave<D>& wave) {
  const auto rock = material_of(medium, cell);
  if constexpr (D == 3) return space_motion(rock, wave.direction, wave.along, wave.shear).speed;
  return plane_motion(rock, wave.across(), wave.direction[D - 1], wave.shear).speed;
}

/// At t = 0 the wave stands on the near side of its front; that must lie in the medium it comes from.
template <int D>
void check_beginning(const Scene<D>& scene, const Source<D>& source, const PlaneWave<D>& wave,
                     std::size_t from) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const double length = source.wavelet.duration_s() * speed_in(medium, from, wave);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    double behind = 0;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double place_m = axis == D - 1 ? grid.depth(at) : grid.centre(int(axis), at[axis]);
      behind += (source.position_m[axis] - place_m) * wave.direction[axis];
    }
    if (behind < 0 || behind > length || medium.same(std::size_t(n), from)) continue;
    refuse_beginning("be in another material than that of the boundary it enters by", grid, n);
  }
}

/// No wave is faster.
double fastest_of(const Material& rock, bool in_3d) {
  return in_3d && rock.is_anisotropic_in_3d() ? fastest_in_3d(rock) : fastest_p_speed_at_most(rock);
}

/// The wave of t = 0 is that of the layers: it must not have come to any cell that differs from them.
template <int D>
void check_beginning_in_layers(const Scene<D>& scene, const Source<D>& source, const PlaneWave<D>& wave,
                               const PlaneWaveWay<D>& way) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const auto from = std::size_t(grid.flat(way.entry));
  const double c = speed_in(medium, from, wave);
  const double along = wave.across() / c, across = std::abs(wave.direction[D - 1]) / c;
  // The earliest arrival of each row, on the way from the boundary it enters by.
  const std::int64_t rows = grid.shape[D - 1];
  std::vector<double> arrival_s(std::size_t(rows), 0);
  double so_far = 0;
  for (std::int64_t n = 0; n < rows; ++n) {
    auto at = way.column;
    at[D - 1] = way.entry_side == 0 ? n : rows - 1 - n;
    const auto cell = std::size_t(grid.flat(at));
    const double fast = 1 / fastest_of(material_of(medium, cell), D == 3), height = grid.height(at);
    const double slowness = medium.same(cell, from) && so_far == 0
                                ? across
                                : std::sqrt(std::max(fast * fast - along * along, 0.));
    if (n == 0)
      arrival_s[std::size_t(at[D - 1])] =
          (grid.depth(at) - source.position_m[D - 1]) * (way.entry_side == 0 ? 1 : -1) * across;
    else
      arrival_s[std::size_t(at[D - 1])] = so_far + slowness * height / 2;
    so_far = arrival_s[std::size_t(at[D - 1])] + slowness * height / 2;
  }
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    auto layer = way.column;
    layer[D - 1] = at[D - 1];
    if (medium.same(std::size_t(n), std::size_t(grid.flat(layer)))) continue;
    double later_s = 0;
    for (std::size_t axis = 0; axis + 1 < D; ++axis)
      later_s += wave.direction[axis] / c * (grid.centre(int(axis), at[axis]) - source.position_m[axis]);
    if (arrival_s[std::size_t(at[D - 1])] + later_s > 0) continue;
    refuse_beginning("have come to what is not one of the layers along the sides", grid, n);
  }
}

/// Checks that the same layers lie along all absorbing sides, and one medium along the absorbing top and
/// bottom.
template <int D>
void check_layers(const Scene<D>& scene, const PlaneWaveWay<D>& way) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const bool in_bands = !scene.numerics.bands.empty();
  for (const int side : {0, 1}) {
    std::optional<std::size_t> reference;
    if (scene.edges[D - 1][side] == EdgeLaw::absorbing)
      check_uniform_edge(
          scene, D - 1, side,
          std::string("a plane wave needs one solid or fluid along the ") +
              (side == way.entry_side ? "boundary it enters by" : "absorbing boundary opposite"),
          reference);
  }
  for (int axis = 0; axis < D - 1; ++axis)
    for (const int side : {0, 1}) {
      if (scene.edges[axis][side] != EdgeLaw::absorbing) continue;
      each_along_edge(grid, axis, side, [&](std::size_t cell, const Index<D>& at) {
        auto layer = way.column;
        layer[D - 1] = at[D - 1];
        const auto other = std::size_t(grid.flat(layer));
        if (medium.same(cell, other) && !medium.is_void(cell)) return true;
        throw Error(std::string(in_bands ? "a plane wave in bands of cells" : "an oblique plane wave") +
                    " needs the same layers along all absorbing sides, without void; found " +
                    described(medium, other) + " and " + described(medium, cell) +
                    (in_bands ? "; without --bands a vertical one in 2-D takes others" : ""));
      });
    }
}

template <int D>
void check_edges(const Scene<D>& scene, const PlaneWave<D>& wave) {
  constexpr int z = D - 1;
  if (const auto& rows = scene.model.grid().rows; rows && rows->first_curvilinear_row())
    throw Error(
        "a plane wave needs a grid with level rows, found rows that follow a horizon; build the "
        "model with --fit none");
  const double down = wave.direction[z];
  const int entry = down > 0 ? 0 : 1;
  const char* entry_name = entry == 0 ? "top" : "bottom";
  if (std::abs(down) > least_share && scene.edges[z][entry] != EdgeLaw::absorbing)
    throw Error("the plane wave enters by the " + std::string(entry_name) + "; use --" + entry_name +
                " absorbing");
  for (int axis = 0; axis < z; ++axis)
    if (const double along = wave.direction[std::size_t(axis)];
        std::abs(along) > least_share && scene.edges[axis][along > 0 ? 0 : 1] != EdgeLaw::absorbing)
      throw Error("the plane wave enters by a side; use --sides absorbing");
}

/// Whether all absorbing boundaries lie in one medium, `reference`; else refuses or not.
template <int D>
bool in_one_medium(const Scene<D>& scene, bool refuse, std::optional<std::size_t>& reference) {
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      if (scene.edges[axis][side] != EdgeLaw::absorbing) continue;
      if (refuse)
        check_uniform_edge(
            scene, axis, side,
            "a plane wave along the rows needs one solid or fluid along all absorbing boundaries", reference);
      else if (other_medium(scene, axis, side, reference))
        return false;
    }
  return true;
}

template <int D>
bool absorbs_at_sides(const Scene<D>& scene) {
  return any_edge_absorbs(scene, D - 1);
}

/// Chooses in which medium the incident field of a wave is known that is not a vertical one in 2-D.
template <int D>
void choose_background(const Scene<D>& scene, const PlaneWave<D>& wave, PlaneWaveWay<D>& way) {
  constexpr int z = D - 1;
  const auto& grid = scene.model.grid();
  const bool along_rows = std::abs(wave.direction[z]) < least_share;
  std::optional<std::size_t> reference;
  const bool open = scene.edges[z][1 - way.entry_side] == EdgeLaw::absorbing;
  if (along_rows || open || !absorbs_at_sides(scene)) {
    if (in_one_medium(scene, along_rows, reference)) {
      way.entry = grid.index(std::int64_t(*reference));
      return;
    }
    if (!absorbs_at_sides(scene)) {
      reference.reset();
      check_uniform_edge(scene, z, way.entry_side,
                         "a plane wave needs one solid or fluid along the boundary it enters by", reference);
      way.by_entry_only = true;
      return;
    }
  }
  way.kind = PlaneWaveKind::layered;
  for (int axis = z - 1; axis >= 0; --axis)
    for (const int side : {1, 0})
      if (scene.edges[axis][side] == EdgeLaw::absorbing) {
        way.column = {};
        way.column[std::size_t(axis)] = side ? grid.shape[std::size_t(axis)] - 1 : 0;
      }
  const auto row = way.entry[z];
  way.entry = way.column;
  way.entry[z] = row;
  check_layers(scene, way);
}

}  // namespace

template <int D>
PlaneWaveWay<D> way_of_plane_wave(const Scene<D>& scene, const Source<D>& source) {
  const auto& wave = std::get<PlaneWave<D>>(source.mechanism);
  const auto& medium = scene.model.medium;
  constexpr int z = D - 1;
  if (scene.attenuates())
    throw Error(
        "found a plane wave in a model that attenuates, expected a point source or --without attenuation",
        ErrorKind::usage);
  check_edges(scene, wave);
  PlaneWaveWay<D> way;
  way.entry_side = wave.direction[z] > 0 ? 0 : 1;
  if (way.entry_side == 1) way.entry[z] = medium.grid().shape[z] - 1;
  if (D == 2 && std::abs(wave.direction[0]) < least_share && scene.numerics.bands.empty()) {
    way.kind = PlaneWaveKind::vertical;
    std::optional<std::size_t> reference;
    check_uniform_edge(scene, z, way.entry_side,
                       "a plane wave needs one solid or fluid along the boundary it enters by", reference);
  } else {
    choose_background(scene, wave, way);
  }
  const auto from = std::size_t(medium.grid().flat(way.entry));
  if (wave.shear && !medium.is_solid(from))
    throw Error("a plane S wave needs rock along the boundary it enters by, found " +
                described(medium, from) + "; use --kind plane");
  if (way.kind == PlaneWaveKind::layered)
    check_beginning_in_layers(scene, source, wave, way);
  else
    check_beginning(scene, source, wave, from);
  return way;
}

std::size_t LevelLayers::at(double depth_m) const {
  const auto below = std::upper_bound(depths_m.begin() + 1, depths_m.end() - 1, depth_m);
  return std::size_t(below - depths_m.begin()) - 1;
}

template <int D>
PlaneWaveGround<D> ground_of_plane_wave(const Scene<D>& scene, const Source<D>& source,
                                        const std::vector<Scene<D>>& bands) {
  constexpr int z = D - 1;
  const auto& medium = scene.model.medium;
  const auto way = way_of_plane_wave(scene, source);
  PlaneWaveGround<D> ground{way, material_of(medium, std::size_t(medium.grid().flat(way.entry))), {}};
  if (way.kind != PlaneWaveKind::layered) return ground;
  auto& layers = ground.layers;
  const auto add_rows = [&](const Medium<D>& of, std::int64_t first, std::int64_t last) {
    const auto& grid = of.grid();
    auto cell = way.column;
    for (int axis = 0; axis < z; ++axis)
      if (cell[axis] > 0) cell[axis] = grid.shape[axis] - 1;
    for (cell[z] = first; cell[z] < last; ++cell[z]) {
      const auto rock = material_of(of, std::size_t(grid.flat(cell)));
      if (!layers.rocks.empty() && layers.rocks.back() == rock) continue;
      layers.rocks.push_back(rock);
      layers.depths_m.push_back(grid.depth_of_face(cell[z]));
    }
    return grid.depth_of_face(last);
  };
  double bottom_m = 0;
  for (const auto& band : bands)
    bottom_m = add_rows(band.model.medium, band.subdomain.first, band.subdomain.last);
  if (bands.empty()) bottom_m = add_rows(medium, 0, medium.grid().shape[z]);
  layers.depths_m.push_back(bottom_m);
  return ground;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, way_of_plane_wave);
SLIPWAVE_INSTANTIATE_D(FUNCTION, ground_of_plane_wave);

}  // namespace slipwave
