// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/sweep_tables.hpp"

#include <algorithm>
#include <utility>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "solver/sweep/tilted_contrasts.hpp"

namespace slipwave::solver {
namespace {

/// Whether the axes of a cell's rock, or of its mean, do not lie along the grid.
template <int D>
bool couples_pairs(const Domain<D>& domain, const Index<D>& at) {
  const auto* const medium = domain.anisotropic_medium(at);
  return medium && (medium->turned || medium->mean);
}

/// Whether free surfaces of more than one axis may meet in space: free edges of the whole model, or void,
/// whose faces may have any direction.
template <int D>
bool free_surfaces_meet(const Domain<D>& domain) {
  if constexpr (D == 2) return false;
  const auto& p_waves = domain.impedance(wave_p);
  if (domain.subdomain.has_void || std::find(p_waves.begin(), p_waves.end(), 0.F) != p_waves.end())
    return true;
  int axes = 0;
  for (int axis = 0; axis < D; ++axis)
    axes += domain.whole_edges[axis][0] == EdgeLaw::free || domain.whole_edges[axis][1] == EdgeLaw::free;
  return axes > 1;
}

/// Adds the cells first to last, counted along an axis from one cell, that are in the grid.
template <int D>
void add_cells_along(const Grid<D>& grid, Index<D> at, int axis, std::int64_t first, std::int64_t last,
                     std::vector<std::int64_t>& cells) {
  auto& place = at[std::size_t(axis)];
  const auto from = std::max<std::int64_t>(place + first, 0),
             to = std::min(place + last, grid.shape[std::size_t(axis)] - 1);
  for (place = from; place <= to; ++place) cells.push_back(grid.flat(at));
}

/// Faces that fractures split for a pair of sweeps along an axis.
template <int D>
SplitLine<D> split_along(const Domain<D>& domain, int axis, int pair, int reach) {
  SplitLine<D> line;
  std::vector<std::pair<std::int64_t, std::int32_t>> faces;  // cell behind, place in the domain's list
  for (std::size_t n = 0; n < domain.split.size(); ++n) {
    const auto& face = domain.split[n];
    if (face.axis != axis || !face.parts(pair)) continue;
    faces.emplace_back(domain.grid.flat(face.behind), std::int32_t(n));
    add_cells_along(domain.grid, face.behind, axis, -reach, reach - 1, line.near);
  }
  if (faces.empty()) return line;
  std::sort(line.near.begin(), line.near.end());
  line.place = [faces = std::move(faces), grid = domain.grid](const Index<D>& behind) {
    const std::pair<std::int64_t, std::int32_t> wanted{grid.flat(behind), 0};
    const auto found = std::lower_bound(faces.begin(), faces.end(), wanted);
    return found != faces.end() && found->first == wanted.first ? found->second : -1;
  };
  return line;
}

/// In cells that carry next to no stress and in line with them, and along fractures with springs.
template <int D>
ReachBounds reach_bounds(const Domain<D>& domain, int axis, int reach) {
  const auto& grid = domain.grid;
  std::vector<std::pair<std::int64_t, int>> found;  // cell, reach
  const auto bound = [&](Index<D> at, int along, std::int64_t offset, int to) {
    auto& place = at[std::size_t(along)];
    place += offset;
    if (place >= 0 && place < grid.shape[std::size_t(along)]) found.emplace_back(grid.flat(at), to);
  };
  for (const auto cell : domain.soft)
    for (int offset = 1 - reach; offset < reach; ++offset)
      bound(grid.index(cell), axis, offset, reach_up_to(std::abs(offset), most_reach_in_soft_cells, reach));
  for (const auto& face : domain.split) {
    if (face.axis == axis || !face.springs()) continue;
    for (int n = 0; most_reach_along_springs + n < reach; ++n)
      for (const int offset : {-1 - n, n})
        bound(face.behind, face.axis, offset, most_reach_along_springs + n);
  }
  std::sort(found.begin(), found.end());
  ReachBounds bounds;
  for (const auto& [cell, to] : found) {
    if (!bounds.cells.empty() && bounds.cells.back() == cell) continue;
    bounds.cells.push_back(cell);
    bounds.reaches.push_back(to);
  }
  return bounds;
}

template <int D, class Real>
std::array<InterfaceCorrections<D, Real>, std::size_t(D)> corrections_along_axes(
    const State<D, Real>& state, const Domain<D>& domain, const Metric<D, Real>& metric) {
  std::array<InterfaceCorrections<D, Real>, std::size_t(D)> all;
  for (int axis = 0; axis < D; ++axis)
    all[std::size_t(axis)] = InterfaceCorrections<D, Real>(state, domain, metric, axis);
  return all;
}

}  // namespace

template <int D, class Real>
SweepTables<D, Real>::SweepTables(State<D, Real>& state, const Domain<D>& domain, int order)
    : state(state),
      kernels{&solver::kernels<Real>(order, false), &solver::kernels<Real>(order, true)},
      edges(domain.edges),
      order(order),
      reach(reach_of(order)),
      shear(!state.fluid),
      anisotropic(domain.anisotropic()),
      couples_all(domain.changes_shear_across()),
      metric(domain),
      corrections(corrections_along_axes(state, domain, metric)) {
  for (int axis = 0; axis < D; ++axis) {
    pairs[axis] = make_pairs(axis);
    changed[axis] = rows_changed_along(axis);
    for (const int side : {0, 1}) {
      using Surface = FreeSurface<D, Real>;
      if (reach > 0) surfaces[axis][side] = Surface(state.layout, domain, axis, side);
      if (reach > 0 && shear)
        surfaces[axis][2 + side] = Surface::beside_void(state.layout, domain, axis, side);
    }
  }
  find_stencils(domain);
  anisotropic_cells = AnisotropicCells<D, Real>(domain, reach, stencils);
}

template <int D, class Real>
void SweepTables<D, Real>::find_stencils(const Domain<D>& domain) {
  std::array<TiltedFaces<D>, std::size_t(D)> tilted;
  for (int axis = 0; axis < D && !domain.anisotropic_cells().empty(); ++axis) {
    tilted[std::size_t(axis)].contrasts = tilted_contrasts(domain, axis, reach);
    tilted[std::size_t(axis)].crossed = [&](const Index<D>& at, const Index<D>& beside) {
      const auto& s_waves = domain.impedance(wave_s);
      return (couples_pairs(domain, at) || couples_pairs(domain, beside)) && s_waves(at) > 0 &&
             s_waves(beside) > 0;
    };
  }
  const bool meet = free_surfaces_meet(domain);
  std::array<ReachBounds, std::size_t(D)> bounds;
  for (int axis = 0; axis < D; ++axis) bounds[std::size_t(axis)] = reach_bounds(domain, axis, reach);
  // Each reads all cells.
  if (domain.splits_shear()) distinct_pairs = D;
  parallel_for(std::int64_t(distinct_pairs) * D, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto n = begin; n < end; ++n) {
      const int axis = int(n / distinct_pairs), pair = int(n % distinct_pairs);
      const auto wave = pair == 0 ? wave_p : wave_s;
      if (wave == wave_s && !shear) continue;
      const SlotBeside<D> slot_beside = [this, axis](Index<D> at, int side) {
        const auto number = beside_void(axis, side).corrected(at);
        at[std::size_t(axis)] += side;
        return number >= 0 ? of_void(number) : corrections[axis].slot(at);
      };
      // The order rises away from an edge in line with a cell: from a corrected free surface, and where free
      // surfaces `meet`, from any of a solid. Where plain images, near a second free surface say, let it
      // reach further than corrected ones beside them, stresses at rest in the surface of a box grew
      // (theory/interfaces.md).
      const RisesFrom<D> rises_from = [this, &domain, axis, meet](Index<D> at, int side) {
        at[std::size_t(axis)] = side ? domain.grid.shape[std::size_t(axis)] - 1 : 0;
        return meet ? edges[axis][side] == EdgeLaw::free && domain.impedance(wave_s)(at) > 0
                    : surfaces[axis][side].corrects(at, 0);
      };
      stencils[std::size_t(axis)][std::size_t(pair)] =
          InterfaceStencils(StencilSearch<D>{.impedances = {&domain.impedance_of_pair(axis, pair)},
                                             .waves = {wave},
                                             .edges = edges,
                                             .axis = axis,
                                             .reach = reach,
                                             .rises_from = rises_from,
                                             .slot_beside = slot_beside,
                                             .tilted = tilted[std::size_t(axis)],
                                             .split = split_along(domain, axis, pair, reach),
                                             .bounds = bounds[std::size_t(axis)]});
    }
  });
}

template <int D, class Real>
auto SweepTables<D, Real>::make_pairs(int axis) const -> std::array<Pair, D> {
  using Rows = FieldRows<D>;
  std::array<Pair, D> all{};
  all[0] = {wave_p, Rows::velocity(axis), Rows::stored(state.layout, Rows::normal_stress(axis))};
  int n = 1;
  for (int other = 0; other < D; ++other)
    if (other != axis) all[n++] = {wave_s, Rows::velocity(other), Rows::shear_stress(axis, other)};
  return all;
}

template <int D, class Real>
auto SweepTables<D, Real>::rows_changed_along(int axis) const -> std::array<int, changed_at_most> {
  std::array<int, changed_at_most> rows{};
  int n = 0;
  rows[n++] = pairs[axis][0].v;
  rows[n++] = pairs[axis][0].s;
  for (int other = 0; other < D; ++other)
    if (other != axis) rows[n++] = FieldRows<D>::normal_stress(other);
  for (int p = 1; p < D; ++p) {
    rows[n++] = pairs[axis][p].v;
    rows[n++] = pairs[axis][p].s;
  }
  if constexpr (D == 3)
    rows[n++] = FieldRows<D>::shear_stress(axis_of_pair<D>(axis, 1), axis_of_pair<D>(axis, 2));
  return rows;
}

template <int D, class Real>
SweptRows<Real> SweepTables<D, Real>::swept_rows(int axis, Real* fields, std::int64_t pitch) const {
  const auto at = [&](int n) { return fields + changed[axis][n] * pitch; };
  if (!shear) return {at(0), at(1), at(1), at(0), at(1)};
  if constexpr (D == 2)
    return {at(0), at(1), at(2), at(3), at(4)};
  else
    return {at(0), at(1), at(2), at(4), at(5), at(3), at(6), at(7)};
}

template <int D, class Real>
std::int64_t SweepTables<D, Real>::stencil_cells() const {
  std::size_t cells = 0;
  for (const auto& axis : stencils)
    for (const auto& wave : axis) cells += wave.size();
  return std::int64_t(cells);
}

template <int D, class Real>
std::int64_t SweepTables<D, Real>::memory_bytes() const {
  std::int64_t bytes = metric.memory_bytes() + anisotropic_cells.memory_bytes();
  for (const auto& of_axis : corrections) bytes += of_axis.memory_bytes();
  for (const auto* treatment : treatments) bytes += treatment->memory_bytes();
  for (const auto& of_axis : stencils)
    for (const auto& of_pair : of_axis) bytes += of_pair.memory_bytes();
  for (const auto& of_axis : surfaces)
    for (const auto& surface : of_axis) bytes += surface.memory_bytes();
  return bytes;
}

template <int D, class Real>
bool SweepTables<D, Real>::any_stencils(int axis, std::int64_t line, const IndexRange& columns) const {
  for (int pair = 0; pair < (shear ? distinct_pairs : 1); ++pair)
    if (stencils_of(axis, pair).any(line, columns)) return true;
  return false;
}

template <int D, class Real>
PairCorrections<Real> SweepTables<D, Real>::corrections_of(int axis, int pair, bool whole) const {
  const auto& interfaces = corrections[axis];
  PairCorrections<Real> of{interfaces.velocity(pair), interfaces.traction(pair),
                           split ? split->images(pair) : nullptr};
  if (whole && !interfaces.empty())
    of.v_of_step = interfaces.velocity_of_step(pair), of.s_of_step = interfaces.traction_of_step(pair),
    of.curvature = interfaces.curvature(pair);
  for (const std::size_t side : {0, 1}) {
    const auto& surface = beside_void(axis, int(side));
    const auto& tractions = surface.tractions();
    of.beside_void[side] = {surface.velocity_correction(pair), surface.traction_correction(pair),
                            whole && !tractions.empty() ? tractions.bend(pair) : nullptr};
  }
  return of;
}

template <int D, class Real>
auto SweepTables<D, Real>::pairs_from(int axis, const Real* fields, std::int64_t pitch, bool whole) const ->
    typename AnisotropicCells<D, Real>::Pairs {
  typename AnisotropicCells<D, Real>::Pairs all{};
  for (int p = 0; p < D; ++p) {
    const auto& of = pairs[axis][std::size_t(p)];
    all[std::size_t(p)] = {fields + of.v * pitch, fields + of.s * pitch, corrections_of(axis, p, whole)};
  }
  return all;
}

template <int D, class Real>
void SweepTables<D, Real>::add_missing_stress(const RowPart<D, Real>& part, Real size,
                                              const RowFlux<Real>& flux) const {
  if (anisotropic_cells.empty()) return;
  anisotropic_cells.add_stress(part, size, state.material_row(part.at, row_b) + part.columns.first, flux,
                               swept_rows(part.axis, part.field(0), part.pitch),
                               part.field(changed[part.axis][changed_at_most - 1]));
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, struct SweepTables);

}  // namespace slipwave::solver
