// SPDX-License-Identifier: BSD-3-Clause
#include "scene/subdomains.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "acquisition/interpolation.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "model/cluster_edge.hpp"
#include "model/fracture.hpp"
#include "rock/coefficients.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/gauges.hpp"

namespace slipwave {
namespace {

/// Two are up to a tenth faster than one, more gain nothing (tests/bench, docs/performance.md).
constexpr int usual_steps = 2;

/// Rows that points read beyond the one they are in, at most.
constexpr std::int64_t beside_points = widest_stencil;

/// Rows beyond those refreshed whose material decides how sweeps treat these: whether an interface is
/// corrected, whether rows are level. Every rank must decide alike.
constexpr std::int64_t beside_refreshed = std::int64_t(2) * max_reach;

/// Whether stencils of a row reach corners of cells that are not level.
template <int D>
bool near_curvilinear_rows(const Grid<D>& grid, std::int64_t row, std::int64_t near) {
  const std::int64_t last = grid.rows->cells()[D - 1];
  for (auto n = row - near; n <= row + near + 1; ++n)
    if (!grid.rows->row_is_level(std::clamp<std::int64_t>(n, 0, last))) return true;
  return false;
}

template <class Value, int D>
Field<D, Value> rows_of(const Field<D, Value>& field, const Grid<D>& held, std::int64_t row) {
  if (field.empty()) return field;
  Field<D, Value> part(held);
  const std::int64_t a_row = held.size() / held.shape[D - 1];
  const auto first = field.begin() + row * a_row;
  std::copy(first, first + held.size(), part.begin());
  return part;
}

/// Rows that processes share, one below the other, and what decides where the rows of each end.
struct SharedRows {
  std::vector<std::int64_t> cells_before;  // computed before each row and before the end, zones included
  std::int64_t cells = 0;                  // all of them
  std::int64_t spread = 0;                 // of a tile
  std::vector<std::int64_t> faces{};       // rows at which bands begin, but the first
  std::vector<std::int64_t> points{};      // rows of receivers

  std::int64_t count() const { return std::int64_t(cells_before.size()) - 1; }
  /// Rows of a part, at least: as many as neighbours read if a receiver is near. They are no fewer than the
  /// bands beside a face read of each other.
  std::int64_t least() const { return spread + beside_points; }
  /// Whether a part may end before a row: both sides of faces between bands lie in one part.
  bool may_end(std::int64_t row) const {
    return std::none_of(faces.begin(), faces.end(),
                        [&](std::int64_t face) { return std::abs(row - face) < least(); });
  }
  /// Whether no point reads across the boundary before this row; `points` ascend.
  bool alone(std::int64_t row) const {
    const auto near = std::lower_bound(points.begin(), points.end(), row - beside_points);
    return near == points.end() || *near >= row + beside_points;
  }
  /// Parts that they make at most.
  int most_parts() const {
    int parts = 1;
    for (std::int64_t end = least(); end + least() <= count(); ++end)
      if (may_end(end)) ++parts, end += least() - 1;
    return parts;
  }
};

/// The rows before which so many parts end, at most most_parts(): each has about as many cells as the others.
std::vector<std::int64_t> ends_of_parts(const SharedRows& shared, int count) {
  // The last ones that leave enough rows to the parts below.
  std::vector<std::int64_t> latest(std::size_t(count), shared.count());
  for (auto n = latest.size() - 1; n-- > 0;) {
    latest[n] = latest[n + 1] - shared.least();
    while (!shared.may_end(latest[n])) --latest[n];
  }
  std::vector<std::int64_t> ends;
  for (std::size_t n = 0; n + 1 < latest.size(); ++n) {
    const auto last = latest[n], first = (ends.empty() ? 0 : ends.back()) + shared.least();
    const auto fits = [&](std::int64_t row) { return row >= first && row <= last && shared.may_end(row); };
    const auto before = std::int64_t(n + 1) * shared.cells / count;
    const auto& cells = shared.cells_before;
    const auto share = std::lower_bound(cells.begin(), cells.end(), before) - cells.begin();
    const auto wanted = std::clamp<std::int64_t>(share, first, last);
    auto end = last;
    for (auto row = first; row < last; ++row)
      if (fits(row) && std::abs(row - wanted) < std::abs(end - wanted)) end = row;
    for (std::int64_t way = 0, even = end; way <= beside_points && !shared.alone(end); ++way)
      for (const auto moved : {even - way, even + way})
        if (fits(moved) && shared.alone(moved) && !shared.alone(end)) end = moved;
    ends.push_back(end);
  }
  ends.push_back(shared.count());
  return ends;
}

/// The rows of one of so many processes.
struct Part {
  std::int64_t first, last, exchanged;
};
Part part_of(const SharedRows& shared, int number, int count) {
  const auto ends = ends_of_parts(shared, count);
  const bool alone =
      std::all_of(ends.begin(), ends.end() - 1, [&](std::int64_t end) { return shared.alone(end); });
  return {number > 0 ? ends[std::size_t(number) - 1] : 0, ends[std::size_t(number)],
          alone ? shared.spread : shared.least()};
}

[[noreturn]] void refuse(int count, const std::string& wanted) {
  throw Error("found " + std::to_string(count) + " processes a shot " + wanted, ErrorKind::usage);
}

template <int D>
bool any_plane_wave(const Scene<D>& scene) {
  const auto& sources = scene.survey.sources;
  return std::any_of(sources.begin(), sources.end(), [](const Source<D>& source) {
    return std::holds_alternative<PlaneWave<D>>(source.mechanism);
  });
}

template <int D>
void refuse_plane_waves(const Scene<D>& scene, int count) {
  if (any_plane_wave(scene))
    throw Error("found a plane wave and " + std::to_string(count) +
                    " processes a shot, expected a point source or --ranks-per-shot 1",
                ErrorKind::usage);
}

/// The rows in which receivers read the fields of a scene, on the whole grid of its model.
template <int D>
std::vector<std::int64_t> rows_of_receivers(const Scene<D>& scene, const Grid<D>& whole) {
  std::vector<std::int64_t> rows;
  const auto add = [&](const Point<D>& point, std::size_t, std::size_t) {
    rows.push_back(cell_of(whole, point)[D - 1]);
  };
  each_receiver<D>(scene.survey, add);
  if (scene.recording.fibre) each_gauge_point<D>(scene, add);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Rows of all bands, one below the other.
template <int D>
SharedRows rows_of_bands(const Scene<D>& scene, const std::vector<Scene<D>>& bands) {
  SharedRows shared;
  shared.spread = spread_of_a_tile(bands.front());
  const auto cells_of_zone = [&](const Scene<D>& band, int axis, int side) {
    return scene.edges[axis][side] == EdgeLaw::absorbing ? std::int64_t(band.numerics.zone_cells) : 0;
  };
  for (const auto& band : bands) {
    const auto& part = band.subdomain;
    std::int64_t a_row = 1;
    for (int axis = 0; axis < D - 1; ++axis)
      a_row *= band.model.grid().shape[axis] + cells_of_zone(band, axis, 0) + cells_of_zone(band, axis, 1);
    if (&band == &bands.front())
      shared.cells += cells_of_zone(band, D - 1, 0) * a_row;
    else
      shared.faces.push_back(std::int64_t(shared.cells_before.size()));
    const auto above = std::int64_t(shared.cells_before.size());
    for (const auto row : rows_of_receivers(scene, band.model.grid()))
      if (row >= part.first && row < part.last) shared.points.push_back(above + row - part.first);
    for (auto row = part.first; row < part.last; ++row, shared.cells += a_row)
      shared.cells_before.push_back(shared.cells);
    if (&band == &bands.back()) {
      shared.cells_before.push_back(shared.cells);
      shared.cells += cells_of_zone(band, D - 1, 1) * a_row;
    }
  }
  return shared;
}

}  // namespace

template <int D>
bool has_shear(const Medium<D>& medium) {
  if (const auto& rows = medium.grid().rows; rows && rows->first_curvilinear_row()) return true;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (medium.is_solid(cell)) return true;
  return false;
}

template <int D>
bool couples_pairs(const Medium<D>& medium, int order) {
  if (any_tilted_axes(medium)) return true;
  const auto& grid = medium.grid();
  const std::int64_t a_row = grid.size() / grid.shape[D - 1];
  for (std::int64_t row = 0; D == 3 && grid.rows && row < grid.shape[D - 1]; ++row) {
    if (!near_curvilinear_rows(grid, row + grid.first[D - 1], nearness_of(order))) continue;
    for (auto cell = std::size_t(row * a_row); cell < std::size_t((row + 1) * a_row); ++cell)
      if (is_anisotropic(medium, cell)) return true;
  }
  return false;
}

template <int D>
bool any_edge_absorbs(const Scene<D>& scene, int axes) {
  bool any = false;
  for (int axis = 0; axis < axes; ++axis)
    for (const int side : {0, 1}) any |= scene.edges[axis][side] == EdgeLaw::absorbing;
  return any;
}

template <int D>
bool has_void(const Medium<D>& medium) {
  return std::any_of(medium.vp.begin(), medium.vp.end(), [](float vp) { return vp == 0; });
}

template <int D>
void note_speeds(Scene<D>& scene) {
  scene.subdomain.fastest = fastest_speed(scene.model.medium);
  scene.subdomain.fastest_across_cells = fastest_across_cells(scene.model.medium);
}

template <int D>
bool corrects_inside(const Medium<D>& medium) {
  if (has_void(medium)) return true;
  const auto& grid = medium.grid();
  if (medium.vs.empty()) return false;  // before the model is read
  const auto nx = grid.shape[0], plane = grid.size() / grid.shape[D - 1];
  const auto part = [&](std::int64_t n, std::int64_t other) {
    return medium.is_solid(std::size_t(n)) != medium.is_solid(std::size_t(other));
  };
  for (std::int64_t line = plane; line < grid.size(); line += nx) {
    const auto at = grid.index(line);
    for (std::int64_t axis = 0, stride = 1; axis + 1 < D; stride *= grid.shape[std::size_t(axis++)]) {
      if (axis > 0 && at[std::size_t(axis)] == 0) continue;
      for (std::int64_t n = line + (axis == 0 ? 1 : 0); n < line + nx; ++n)
        if (part(n, n - stride) && part(n - plane, n - plane - stride)) return true;
    }
  }
  return false;
}

template <int D>
std::array<std::array<std::vector<double>, 2>, 2> side_speeds(const Medium<D>& medium,
                                                              const Subdomain& part) {
  const auto& grid = medium.grid();
  std::array<std::array<std::vector<double>, 2>, 2> speeds;
  if (!grid.rows) return speeds;
  FastestAcrossCell<D> speed(medium);
  for (std::size_t axis = 0; axis + 1 < std::size_t(D); ++axis)
    for (const std::size_t side : {0, 1}) {
      Grid<D> edge = grid;
      edge.shape[axis] = 1;
      for (std::int64_t n = 0; n < edge.size(); ++n) {
        auto at = edge.index(n);
        at[axis] = side ? grid.shape[axis] - 1 : 0;
        if (!part.owns(grid, at[D - 1])) continue;
        const auto cell = std::size_t(grid.flat(at));
        speeds[axis][side].push_back(medium.is_void(cell) ? 0 : speed(cell));
      }
    }
  return speeds;
}

template <int D>
Medium<D> rows_of(const Medium<D>& medium, std::int64_t first, std::int64_t last) {
  auto held = medium.grid();
  held.first[D - 1] += first;
  held.shape[D - 1] = last - first;
  Medium<D> rows;
  for (const Property property : medium.properties()) rows[property] = rows_of(medium[property], held, first);
  return rows;
}

int steps_of_a_tile(const Tiling& tiling) { return tiling.steps > 0 ? tiling.steps : usual_steps; }

template <int D>
std::int64_t spread_of_a_step(const std::vector<SweepFraction>& splitting, int axis, std::int64_t reach,
                              const std::array<std::int64_t, std::size_t(D)>& surface_reach) {
  std::int64_t cells = 0;
  for (const auto& sweep : splitting)
    cells += sweep.axis == axis ? reach + 1 : surface_reach[std::size_t(sweep.axis)];
  return cells;
}

template <int D>
std::int64_t spread_of_a_tile(const Scene<D>& scene) {
  std::array<std::int64_t, std::size_t(D)> surface_reach{};
  for (int axis = 0; axis < D; ++axis)
    for (const EdgeLaw law : scene.edges[axis])
      if (law == EdgeLaw::free) surface_reach[std::size_t(axis)] = free_surface_reach;
  for (const auto& set : scene.model.fracture_sets)
    if (set.on_faces) surface_reach[0] = free_surface_reach;
  if (scene.subdomain.corrects_inside || corrects_inside(scene.model.medium))
    surface_reach.fill(free_surface_reach);
  const auto spread_of = [&](const std::vector<SweepFraction>& sweeps) {
    return spread_of_a_step<D>(sweeps, D - 1, reach_of(scene.numerics.order), surface_reach);
  };
  const auto sweeps = splitting(D, scene.numerics.time_order);
  // The first tile of all has one more sweep along x.
  if (!scene.subdomain.in_bands())
    return steps_of_a_tile(scene.numerics.tiling) * spread_of(sweeps) + surface_reach[0];
  std::int64_t most = 0;
  std::vector<SweepFraction> tile;
  for (const int step : {0, 1})
    for (const auto& sweep : sweeps) {
      if (sweep.axis == D - 1) tile.clear();
      if (step > 0 || sweep.axis == D - 1 || !tile.empty()) tile.push_back(sweep);
      most = std::max(most, spread_of(tile));
    }
  return most;
}

template <int D>
Subdomain subdomain_for(const Scene<D>& scene, const Grid<D>& whole, int number, int count) {
  constexpr int z = D - 1;
  const std::int64_t rows = whole.shape[z];
  if (count == 1) return {};
  refuse_plane_waves(scene, count);
  std::int64_t zone = 0;
  for (const auto& source : scene.survey.sources)
    zone = std::max<std::int64_t>(zone, zone_cells(scene, source));
  const auto zone_at = [&](int side) { return scene.edges[z][side] == EdgeLaw::absorbing ? zone : 0; };
  SharedRows shared;
  shared.cells_before.resize(std::size_t(rows) + 1);
  std::iota(shared.cells_before.begin(), shared.cells_before.end(), zone_at(0));
  shared.cells = zone_at(0) + rows + zone_at(1);
  shared.spread = spread_of_a_tile(scene);
  shared.points = rows_of_receivers(scene, whole);
  if (const int most = shared.most_parts(); count > most)
    refuse(count, "for a model of " + std::to_string(rows) + " rows, expected at most " +
                      std::to_string(most) + ": each takes " + std::to_string(shared.least()) + " or more");
  const auto [first, last, exchanged] = part_of(shared, number, count);
  Subdomain part;
  part.rows = rows, part.first = first, part.last = last, part.exchanged = exchanged;
  return part;
}

template <int D>
int most_processes(const Scene<D>& scene, const std::vector<Scene<D>>& bands) {
  return any_plane_wave(scene) ? 1 : rows_of_bands(scene, bands).most_parts();
}

template <int D>
std::vector<Subdomain> subdomains_for(const Scene<D>& scene, const std::vector<Scene<D>>& bands, int number,
                                      int count) {
  std::vector<Subdomain> parts;
  for (const auto& band : bands) parts.push_back(band.subdomain);
  if (count == 1) return parts;
  refuse_plane_waves(scene, count);
  const auto shared = rows_of_bands(scene, bands);
  if (const int most = shared.most_parts(); count > most) {
    std::string rows;
    for (const auto& of : parts)
      rows += (rows.empty()           ? ""
               : &of == &parts.back() ? " and "
                                      : ", ") +
              std::to_string(of.last - of.first);
    refuse(count, "for bands of " + rows + " rows, expected at most " + std::to_string(most) +
                      ": each takes " + std::to_string(shared.least()) + " or more of a band that it shares");
  }
  const auto [first, last, exchanged] = part_of(shared, number, count);
  std::int64_t above = 0;  // rows of the bands before
  for (std::size_t n = 0; n < bands.size(); ++n) {
    auto& part = parts[n];
    const auto of_band = part.first;
    const auto rows = part.last - part.first;
    part.first = of_band + std::clamp<std::int64_t>(first - above, 0, rows);
    part.last = of_band + std::clamp<std::int64_t>(last - above, 0, rows);
    part.exchanged = exchanged;
    part.askew = askew_sets(bands[n]);
    above += rows;
  }
  return parts;
}

std::pair<std::int64_t, std::int64_t> rows_held(const Subdomain& part) {
  // The material round a source decides what it is spread over.
  const auto beside = std::max(
      {part.exchanged + beside_refreshed, beside_points, std::int64_t(widest_spread(Moment::lasting))});
  // Of other bands it holds all that its own does.
  return {part.ends_at_band(0) ? 0 : std::max<std::int64_t>(0, part.first - beside),
          part.ends_at_band(1) ? part.rows : std::min(part.rows, part.last + beside)};
}

template <int D>
std::vector<std::array<bool, 2>> askew_sets(const Scene<D>& scene) {
  if (!scene.subdomain.askew.empty()) return scene.subdomain.askew;
  const auto& model = scene.model;
  std::vector<std::array<bool, 2>> askew(model.fracture_sets.size());
  if (anisotropic_cells(model.medium) == 0) return askew;
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell)
    if (const auto code = model.fracture[cell]; code > 0)
      if (auto& any = askew[code - 1U][is_cut(model, cell)]; !any)
        any = lie_askew(model.fracture_sets[code - 1U], model.medium, cell);
  return askew;
}

template <int D>
Scene<D> cut_to(Scene<D> whole, const Subdomain& part) {
  whole.subdomain = part;
  if (part.is_whole()) return whole;
  const auto [first, last] = rows_held(part);
  auto& model = whole.model;
  if (first == 0 && last == model.grid().shape[D - 1]) return whole;
  model.medium = rows_of(model.medium, first, last);
  const auto held = model.grid();
  model.fracture = rows_of(model.fracture, held, first);
  model.fracture_share = rows_of(model.fracture_share, held, first);
  for (auto& component : model.prestress_pa) component = rows_of(component, held, first);
  return whole;
}

template <int D>
void join(Scene<D>& scene, Ranks& ranks) {
  scene.subdomain.askew = askew_sets(scene);
  for (auto& kinds : scene.subdomain.askew)
    for (bool& any : kinds) any = largest_of(&ranks, any ? 1 : 0) > 0;
  note_speeds(scene);
  for (auto* const fastest : {&scene.subdomain.fastest, &scene.subdomain.fastest_across_cells})
    *fastest = largest_of(&ranks, *fastest);
  scene.subdomain.anisotropic = largest_of(&ranks, anisotropic_cells(scene.model.medium) > 0 ? 1 : 0) > 0;
  scene.subdomain.tilted =
      largest_of(&ranks, couples_pairs(scene.model.medium, scene.numerics.order) ? 1 : 0) > 0;
  scene.subdomain.tilted_means = largest_of(&ranks, tilted_means(scene.model.medium) > 0 ? 1 : 0) > 0;
  scene.subdomain.side_speeds = side_speeds(scene.model.medium, scene.subdomain);
  for (auto& sides : scene.subdomain.side_speeds)
    for (auto& speeds : sides) speeds = allgather(&ranks, speeds);
  scene.subdomain.shear = largest_of(&ranks, has_shear(scene.model.medium) ? 1 : 0) > 0;
  scene.subdomain.has_void = largest_of(&ranks, has_void(scene.model.medium) ? 1 : 0) > 0;
  scene.subdomain.corrects_inside = largest_of(&ranks, corrects_inside(scene.model.medium) ? 1 : 0) > 0;
  scene.subdomain.slips = largest_of(&ranks, scene.slips() ? 1 : 0) > 0;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, askew_sets);
SLIPWAVE_INSTANTIATE_D(FUNCTION, any_edge_absorbs);
SLIPWAVE_INSTANTIATE_D(FUNCTION, has_shear);
SLIPWAVE_INSTANTIATE_D(FUNCTION, has_void);
SLIPWAVE_INSTANTIATE_D(FUNCTION, note_speeds);
SLIPWAVE_INSTANTIATE_D(FUNCTION, corrects_inside);
SLIPWAVE_INSTANTIATE_D(FUNCTION, couples_pairs);
SLIPWAVE_INSTANTIATE_D(FUNCTION, rows_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, side_speeds);
SLIPWAVE_INSTANTIATE_D(FUNCTION, spread_of_a_step);
SLIPWAVE_INSTANTIATE_D(FUNCTION, spread_of_a_tile);
SLIPWAVE_INSTANTIATE_D(FUNCTION, subdomain_for);
SLIPWAVE_INSTANTIATE_D(FUNCTION, subdomains_for);
SLIPWAVE_INSTANTIATE_D(FUNCTION, most_processes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, cut_to);
SLIPWAVE_INSTANTIATE_D(FUNCTION, join);

}  // namespace slipwave
