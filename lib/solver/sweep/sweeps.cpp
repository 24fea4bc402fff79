// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "solver/sweep/tilted_contrasts.hpp"

namespace slipwave::solver {
namespace {

/// Columns swept together across: their data stays in the first cache.
constexpr std::int64_t stripe_width = 256;

/// Halves of rows to prefetch after the reconstruction and after the update of a curvilinear row: with those
/// of its metric there are twice as many.
constexpr int prefetched_by_curvilinear = 3;

}  // namespace

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

/// Whether the order of the reconstruction rises away from an edge in line with a cell: from a corrected free
/// surface, and where free surfaces `meet`, from any of a solid. Where plain images, near a second free
/// surface say, let it reach further than corrected ones beside them, stresses at rest in the surface of a
/// box grew (theory/interfaces.md).
template <int D>
bool order_rises_from(const Domain<D>& domain, Index<D> at, int axis, int side, bool meet) {
  at[std::size_t(axis)] = side ? domain.grid.shape[std::size_t(axis)] - 1 : 0;
  if (meet) return domain.edges[axis][side] == EdgeLaw::free && domain.impedance(wave_s)(at) > 0;
  return !surface_slope(domain, at, axis, side, FieldRows<D>::velocity(axis)).empty();
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
Sweeps<D, Real>::Sweeps(State<D, Real>& state, const Domain<D>& domain, int order)
    : state_(state),
      kernels_{&kernels<Real>(order, false), &kernels<Real>(order, true)},
      own_{0, domain.grid.shape[z_axis]},
      edges_(domain.edges),
      order_(order),
      reach_(reach_of(order)),
      shear_(!state.fluid),
      anisotropic_(domain.anisotropic()),
      couples_all_(domain.changes_shear_across()),
      metric_(domain),
      corrections_(corrections_along_axes(state, domain, metric_)),
      curvilinear_stencils_(domain, reach_, corrections_[z_axis], metric_) {
  for (int axis = 0; axis < D; ++axis) {
    pairs_[axis] = make_pairs(axis);
    changed_[axis] = rows_changed(axis);
    for (const int side : {0, 1}) {
      using Surface = FreeSurface<D, Real>;
      if (reach_ > 0) surfaces_[axis][side] = Surface(state.layout, domain, axis, side);
      if (reach_ > 0 && shear_)
        surfaces_[axis][2 + side] = Surface::beside_void(state.layout, domain, axis, side);
    }
  }
  find_stencils(domain);
  anisotropic_cells_ = Cells(domain, reach_, stencils_);
  anisotropic_across_ = AnisotropicCellsAcross<D, Real>(domain, metric_, reach_);
  find_plain_lines();
}

template <int D, class Real>
void Sweeps<D, Real>::find_stencils(const Domain<D>& domain) {
  std::array<TiltedFaces<D>, std::size_t(D)> tilted;
  for (int axis = 0; axis < D && !domain.anisotropic_cells().empty(); ++axis) {
    tilted[std::size_t(axis)].contrasts = tilted_contrasts(domain, axis, reach_);
    tilted[std::size_t(axis)].crossed = [&](const Index<D>& at, const Index<D>& beside) {
      const auto& s_waves = domain.impedance(wave_s);
      return (couples_pairs(domain, at) || couples_pairs(domain, beside)) && s_waves(at) > 0 &&
             s_waves(beside) > 0;
    };
  }
  const bool meet = free_surfaces_meet(domain);
  std::array<ReachBounds, std::size_t(D)> bounds;
  for (int axis = 0; axis < D; ++axis) bounds[std::size_t(axis)] = reach_bounds(domain, axis, reach_);
  // Each reads all cells.
  if (domain.splits_shear()) distinct_pairs_ = D;
  parallel_for(std::int64_t(distinct_pairs_) * D, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto n = begin; n < end; ++n) {
      const int axis = int(n / distinct_pairs_), pair = int(n % distinct_pairs_);
      const auto wave = pair == 0 ? wave_p : wave_s;
      if (wave == wave_s && !shear_) continue;
      const SlotBeside<D> slot_beside = [this, axis](Index<D> at, int side) {
        const auto number = beside_void(axis, side).corrected(at);
        at[std::size_t(axis)] += side;
        return number >= 0 ? of_void(number) : corrections_[axis].slot(at);
      };
      const RisesFrom<D> rises_from = [&domain, axis, meet](const Index<D>& at, int side) {
        return order_rises_from(domain, at, axis, side, meet);
      };
      stencils_[std::size_t(axis)][std::size_t(pair)] =
          InterfaceStencils(StencilSearch<D>{.impedances = {&domain.impedance_of_pair(axis, pair)},
                                             .waves = {wave},
                                             .edges = edges_,
                                             .axis = axis,
                                             .reach = reach_,
                                             .rises_from = rises_from,
                                             .slot_beside = slot_beside,
                                             .tilted = tilted[std::size_t(axis)],
                                             .split = split_along(domain, axis, pair, reach_),
                                             .bounds = bounds[std::size_t(axis)]});
    }
  });
}

template <int D, class Real>
void Sweeps<D, Real>::find_plain_lines() {
  for (int axis = 1; axis < D; ++axis) {
    auto& plain = plain_lines_[std::size_t(axis)];
    plain.resize(std::size_t(state_.layout.lines()));
    for (std::int64_t line = 0; line < state_.layout.lines(); ++line) {
      const IndexRange all{0, state_.layout.padded_nx()};
      plain[std::size_t(line)] =
          !metric_.curvilinear(line) && !any_stencils(axis, line, all) && !anisotropic_cells_.any(line, all);
    }
  }
}

template <int D, class Real>
void Sweeps<D, Real>::use(SweepFilter<D, Real>* filter) {
  if (filters_.size() == most_filters) throw std::length_error("too many effects filter sweeps");
  filters_.push_back(filter);
}

template <int D, class Real>
void Sweeps<D, Real>::split_faces(const Domain<D>& domain, double dt_s, double unit) {
  if (domain.split.empty()) return;
  split_ = std::make_unique<SplitFaces<D, Real>>(state_, domain, dt_s, unit);
  use(split_.get());
}

template <int D, class Real>
void Sweeps<D, Real>::keep_monotone() {
  if (metric_.any_curvilinear()) throw std::logic_error("no criterion of monotonicity on curvilinear rows");
  monotone_ = reach_ > 0;
}

template <int D, class Real>
Workspace<Real> Sweeps<D, Real>::make_workspace(std::int64_t widest) const {
  return Workspace<Real>(widest, state_.layout.rows(), pair_count());
}

template <int D, class Real>
Ring<Real> Sweeps<D, Real>::make_ring(int axis, std::int64_t first, std::int64_t width) const {
  const int waiting = int(rows_behind() - reach_);
  // Faces need the outgoing waves of two rows. Uniform runs need them until their row is updated.
  const int outgoing = state_.uniform_interior[std::size_t(axis)].empty() ? 2 : waiting + 2;
  // Curvilinear faces have two velocities: what the cells on either side see.
  const int pairs = axis == z_axis && metric_.any_curvilinear() ? D + D / 2 + D % 2 : pair_count();
  return Ring<Real>(first, width, outgoing, waiting + 1, pairs);
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::interface_stencil_cells() const {
  std::size_t cells = 0;
  for (const auto& axis : stencils_)
    for (const auto& wave : axis) cells += wave.size();
  return std::int64_t(cells + curvilinear_stencils_.size());
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::memory_bytes() const {
  std::int64_t bytes = curvilinear_stencils_.memory_bytes() + metric_.memory_bytes() +
                       anisotropic_cells_.memory_bytes() + anisotropic_across_.memory_bytes() +
                       bytes_of(plain_lines_);
  for (const auto& of_axis : corrections_) bytes += of_axis.memory_bytes();
  for (const auto* treatment : treatments_) bytes += treatment->memory_bytes();
  for (const auto& of_axis : stencils_)
    for (const auto& of_pair : of_axis) bytes += of_pair.memory_bytes();
  for (const auto& of_axis : surfaces_)
    for (const auto& surface : of_axis) bytes += surface.memory_bytes();
  return bytes;
}

template <int D, class Real>
auto Sweeps<D, Real>::make_pairs(int axis) const -> std::array<Pair, D> {
  using Rows = FieldRows<D>;
  std::array<Pair, D> all{};
  all[0] = {wave_p, Rows::velocity(axis), Rows::stored(state_.layout, Rows::normal_stress(axis))};
  int n = 1;
  for (int other = 0; other < D; ++other)
    if (other != axis) all[n++] = {wave_s, Rows::velocity(other), Rows::shear_stress(axis, other)};
  return all;
}

template <int D, class Real>
auto Sweeps<D, Real>::rows_changed(int axis) const -> std::array<int, changed_at_most> {
  std::array<int, changed_at_most> rows{};
  int n = 0;
  rows[n++] = pairs_[axis][0].v;
  rows[n++] = pairs_[axis][0].s;
  for (int other = 0; other < D; ++other)
    if (other != axis) rows[n++] = FieldRows<D>::normal_stress(other);
  for (int p = 1; p < D; ++p) {
    rows[n++] = pairs_[axis][p].v;
    rows[n++] = pairs_[axis][p].s;
  }
  if constexpr (D == 3)
    rows[n++] = FieldRows<D>::shear_stress(axis_of_pair<D>(axis, 1), axis_of_pair<D>(axis, 2));
  return rows;
}

/// Outgoing waves of the cells of these columns; `outgoing` begins with the first of them.
template <int D, class Real>
void Sweeps<D, Real>::reconstruct_row(int axis, const Index<D>& line, const IndexRange& columns,
                                      const Real* fields, std::int64_t pitch, std::int64_t stride, Real scale,
                                      OutgoingWaves<Real> outgoing, PrefetchQueue<Real>& prefetch) const {
  const auto number = state_.layout.line_number(line);
  if (metric_.curvilinear(number))
    return reconstruct_curvilinear_row(axis, line, columns, fields, pitch, stride, scale, outgoing, prefetch);
  const bool whole_step = scale == 1;
  scale = scale_of(axis, line, scale);
  // Nothing reads the waves of the padding of a row.
  const IndexRange cells{columns.first, std::min(columns.last, state_.layout.shape()[0])};
  const auto impedance_of = [](int p, const MaterialRows<Real>& material) {
    return p == 0 ? material.zp : p == 1 ? material.zs : material.zs2;
  };
  const auto material = state_.material_from(line, columns.first, axis);
  const auto* const run = state_.uniform_run(number, cells.first, cells.last);
  const auto of_cells = run ? run->template rows<D>(axis) : material;
  for (int p = 0; p < pair_count(); ++p) {
    const Pair& pair = pairs_[axis][p];
    Real* const up = outgoing.up(p);
    Real* const down = outgoing.down(p);
    const Real* const v = fields + pair.v * pitch + columns.first;
    const Real* const s = fields + pair.s * pitch + columns.first;
    const auto& stencils = stencils_of(axis, p);
    // Between layers a few cells thick, interfaces leave nothing of a row.
    if (!stencils.all(number, cells))
      kernels_[run != nullptr]->reconstruct(columns.count(), stride, v, s, impedance_of(p, of_cells),
                                            of_cells.b, scale, up, down);
    if (stencils.in_line(number)) {
      auto of_pair = material;
      if (p > 0) of_pair.zs = impedance_of(p, material);
      stencils.correct(order_, number, columns,
                       PairOfLine<Real>{v, s, stride, corrections_of(axis, p, whole_step), scale}, of_pair,
                       up, down);
    }
    // After the stencils beside interfaces: their waves keep to the criterion, too.
    if (monotone_)
      kernels_[false]->limit(columns.count(), stride, v, s, state_.material_layout.stride(axis),
                             impedance_of(p, material), material.b, scale, up, down);
    prefetch.prefetch_one();
  }
  if (!anisotropic_cells_.empty())
    anisotropic_cells_.reconstruct(axis, number, columns, *kernels_[false], stride,
                                   pairs_from(axis, fields + columns.first, pitch, whole_step), material.b,
                                   scale, outgoing);
  for (const int side : {0, 1})
    if (whole_step && axis == 0) add_tractions(beside_void(axis, side), line, columns, outgoing);
}

/// From the first cell on.
template <int D, class Real>
auto Sweeps<D, Real>::pairs_from(int axis, const Real* fields, std::int64_t pitch, bool whole) const ->
    typename Cells::Pairs {
  typename Cells::Pairs pairs{};
  for (int p = 0; p < D; ++p) {
    const auto& of = pairs_[axis][std::size_t(p)];
    pairs[std::size_t(p)] = {fields + of.v * pitch, fields + of.s * pitch, corrections_of(axis, p, whole)};
  }
  return pairs;
}

template <int D, class Real>
void Sweeps<D, Real>::reconstruct_curvilinear_row(int axis, const Index<D>& line, const IndexRange& columns,
                                                  const Real* fields, std::int64_t pitch, std::int64_t stride,
                                                  Real scale, OutgoingWaves<Real> outgoing,
                                                  PrefetchQueue<Real>& prefetch) const {
  const auto number = state_.layout.line_number(line);
  prefetch.prefetch(prefetched_by_curvilinear);
  const auto material = state_.material_from(line, columns.first);
  if (axis == z_axis) {
    const CurvilinearFields<const Real> all{fields + columns.first, pitch, stride};
    const auto metric = metric_.across(line, columns.first);
    curvilinear_kernels().reconstruct_across(columns.count(), scale, all, material, metric, outgoing);
    anisotropic_across_.reconstruct(number, columns, *kernels_[false], all, metric, material.b, scale,
                                    outgoing);
    curvilinear_stencils_.correct(order_, number, columns, {all, metric, material, scale},
                                  corrections_[z_axis], anisotropic_across_, outgoing);
    return;
  }
  const auto metric = metric_.along(axis, line, columns.first);
  CurvilinearPairs<Real> pairs{};
  for (int p = 0; p < D; ++p) {
    pairs.v[p] = fields + pairs_[axis][p].v * pitch + columns.first;
    pairs.s[p] = fields + pairs_[axis][p].s * pitch + columns.first;
  }
  curvilinear_kernels().reconstruct_along(columns.count(), stride, pairs, material, scale, metric, outgoing);
  for (int p = 0; p < D; ++p)
    stencils_of(axis, p).correct(
        order_, number, columns,
        PairOfLine<Real>{pairs.v[p], pairs.s[p], stride, corrections_of(axis, p, scale == 1), scale},
        material, outgoing.up(p), outgoing.down(p), &metric);
  if (!anisotropic_cells_.empty())
    anisotropic_cells_.reconstruct(axis, number, columns, *kernels_[false], stride,
                                   pairs_from(axis, fields + columns.first, pitch, scale == 1), material.b,
                                   scale, outgoing, &metric);
}

template <int D, class Real>
void Sweeps<D, Real>::solve_anisotropic_across(const Index<D>& at, std::int64_t row,
                                               const IndexRange& columns, const CurvilinearSolve<Real>& face,
                                               Real sign, bool fluid) const {
  if (anisotropic_across_.empty()) return;
  const auto line = [&](std::int64_t k) {
    auto of = at;
    of[z_axis] = k;
    return k >= 0 && k < state_.layout.shape()[z_axis] ? state_.layout.line_number(of) : -1;
  };
  anisotropic_across_.solve(line(row - 1), line(row), columns, face, sign, fluid);
}

template <int D, class Real>
CurvilinearSolve<Real> Sweeps<D, Real>::curvilinear_face(const Index<D>& at, std::int64_t row, std::int64_t x,
                                                         Ring<Real>& ring) const {
  Index<D> lo = at, hi = at;
  lo[z_axis] = row - 1, hi[z_axis] = row;
  const auto fields = [&](const Index<D>& line) {
    return CurvilinearFields<const Real>{state_.field_row(line, 0) + x, state_.layout.row_pitch(), 0};
  };
  const auto faces = ring.faces(row, x);
  return {ring.outgoing(row - 1, x),
          ring.outgoing(row, x),
          state_.material_from(lo, x),
          state_.material_from(hi, x),
          fields(lo),
          fields(hi),
          metric_.across(hi, x),
          faces,
          faces.v(D),
          faces.pitch};
}

template <int D, class Real>
CurvilinearUpdate<Real> Sweeps<D, Real>::curvilinear_update(const Index<D>& line, std::int64_t x,
                                                            Real* fields, std::int64_t pitch,
                                                            InterfaceStates<Real> lo,
                                                            InterfaceStates<Real> hi) const {
  const bool fluid = metric_.fluid_at_face(state_.layout.line_number(line));
  return {lo,
          hi,
          lo.v(fluid ? D : 0),
          fluid ? lo.pitch : 2 * lo.pitch,
          state_.material_from(line, x),
          metric_.across(line, x),
          {fields + x, pitch, 0}};
}

template <int D, class Real>
SweptRows<Real> Sweeps<D, Real>::swept_rows(int axis, Real* fields, std::int64_t pitch) const {
  const auto at = [&](int n) { return fields + changed_[axis][n] * pitch; };
  if (!shear_) return {at(0), at(1), at(1), at(0), at(1)};
  if constexpr (D == 2)
    return {at(0), at(1), at(2), at(3), at(4)};
  else
    return {at(0), at(1), at(2), at(4), at(5), at(3), at(6), at(7)};
}

template <int D, class Real>
void Sweeps<D, Real>::update_curvilinear(int axis, const Index<D>& line, const IndexRange& columns,
                                         Real* fields, std::int64_t pitch, Real scale, const Flux& flux,
                                         const SweptRows<Real>& rows) const {
  const auto number = state_.layout.line_number(line);
  if (axis == z_axis) {
    const auto of = curvilinear_update(line, columns.first, fields, pitch, flux.lo, flux.hi);
    curvilinear_kernels().update_across(columns.count(), scale, of);
    anisotropic_across_.add_stress(number, columns, std::abs(scale), of);
    return;
  }
  curvilinear_kernels().update_along(columns.count(), scale, flux.lo, flux.hi,
                                     state_.material_from(line, columns.first),
                                     metric_.along(axis, line, columns.first).over_j, rows);
  add_missing_stress(axis, line, columns, fields, pitch, std::abs(scale), flux);
}

/// Advances these columns by advance(), and lets effects filter what that adds.
template <int D, class Real>
template <class Advance>
void Sweeps<D, Real>::filtered(int axis, const Index<D>& line, const IndexRange& columns, Real* fields,
                               Real scale, std::int64_t pitch, Workspace<Real>& work, bool remember,
                               Advance&& advance) {
  // What copies ahead hold of the zones is read by nothing.
  if (filters_.empty() || !remember) return advance();
  const auto& rows = changed_[axis];
  const int row_count = rows_changed();
  // Built in place: a copy would wait until all stores of the loops before this are done.
  std::array<std::array<IndexRange, 2>, most_filters> filtered;
  for (std::size_t f = 0; f < filters_.size(); ++f) filtered[f] = filters_[f]->filtered(axis, line, columns);
  const auto each_filtered = [&](auto&& what) {
    for (std::size_t f = 0; f < filters_.size(); ++f)
      for (const auto& part : filtered[f])
        if (!part.empty()) what(*filters_[f], part, work.before() + part.first - columns.first);
  };
  each_filtered([&](const auto&, const IndexRange& part, Real* before) {
    for (int n = 0; n < row_count; ++n) {
      const Real* const field = fields + rows[n] * pitch;
      std::copy(field + part.first, field + part.last, before + n * work.pitch());
    }
  });
  advance();
  each_filtered([&](auto& filter, const IndexRange& part, const Real* before) {
    filter.filter({axis,
                   scale,
                   line,
                   part,
                   {rows.data(), std::size_t(row_count)},
                   before,
                   work.pitch(),
                   fields + part.first,
                   pitch,
                   work.time()});
  });
  for (auto* const filter : filters_)
    if (const auto next = filter->next(work.time(), scale); next.axis >= 0)
      prepare(*filter, next, line, columns, fields, pitch);
}

template <int D, class Real>
void Sweeps<D, Real>::prepare(SweepFilter<D, Real>& filter, const NextSweep& next, const Index<D>& line,
                              const IndexRange& columns, Real* fields, std::int64_t pitch) const {
  const std::span<const int> rows{changed_[std::size_t(next.axis)].data(), std::size_t(rows_changed())};
  for (const auto& part : filter.filtered(next.axis, line, columns))
    if (!part.empty())
      filter.prepare({next.axis, 0, line, part, rows, nullptr, 0, fields + part.first, pitch, next.time});
}

/// Advances these columns.
template <int D, class Real>
void Sweeps<D, Real>::update(int axis, const Index<D>& line, const IndexRange& columns, Real* fields,
                             std::int64_t pitch, Real scale, const Flux& flux, Workspace<Real>& work,
                             bool remember) {
  const auto swept = [&](std::int64_t x) { return swept_rows(axis, fields + x, pitch); };
  const auto number = state_.layout.line_number(line);
  const Real own_scale = scale_of(axis, line, scale);
  const auto run_of = [&](const auto& part) { return state_.uniform_run(number, part.first, part.last); };
  const auto without_faces = [&](const IndexRange& part) {
    const auto from = part.first - columns.first;
    // Its material is known without reading it from memory.
    face_kernels(true).update_uniform(part.count(), own_scale, flux.below.at(from), flux.here.at(from),
                                      flux.above.at(from), run_of(part)->template rows<D>(axis),
                                      swept(part.first));
  };
  const auto between_faces = [&](const IndexRange& part) {
    const auto from = part.first - columns.first;
    const auto* run = run_of(part);
    face_kernels(run).update(part.count(), own_scale, flux.lo.at(from), flux.hi.at(from),
                             run ? run->template rows<D>(axis) : state_.material_from(line, part.first, axis),
                             swept(part.first));
  };
  filtered(axis, line, columns, fields, scale, pitch, work, remember, [&] {
    if (metric_.curvilinear(number)) {
      update_curvilinear(axis, line, columns, fields, pitch, scale, flux, swept(columns.first));
      work.prefetch().prefetch(prefetched_by_curvilinear);
    } else {
      split_by_runs(state_.uniform_interior[std::size_t(axis)].of(number), 0, columns, without_faces,
                    between_faces);
      add_missing_stress(axis, line, columns, fields, pitch, std::abs(own_scale), flux);
      for (auto* treatment : treatments_)
        treatment->add(axis, number, columns, own_scale, flux.lo, flux.hi, swept(columns.first), remember);
    }
    work.prefetch().prefetch_one();
  });
}

template <int D, class Real>
void Sweeps<D, Real>::add_missing_stress(int axis, const Index<D>& line, const IndexRange& columns,
                                         Real* fields, std::int64_t pitch, Real size,
                                         const Flux& flux) const {
  if (anisotropic_cells_.empty()) return;
  Real* const shear = D == 3 ? fields + columns.first + changed_[axis][changed_at_most - 1] * pitch : nullptr;
  anisotropic_cells_.add_stress(axis, state_.layout.line_number(line), columns, size,
                                state_.material_row(line, row_b) + columns.first, flux.lo, flux.hi,
                                swept_rows(axis, fields + columns.first, pitch), shear);
}

template <int D, class Real>
void Sweeps<D, Real>::along(int axis, Real scale, const SweepTime& time) {
  const auto& layout = state_.layout;
  const std::int64_t lines = layout.lines(), nx = layout.padded_nx();
  const std::int64_t widest = axis == 0 ? nx : stripe_width;
  std::vector<Workspace<Real>> work;
  for (int worker = 0; worker < parallel_workers(); ++worker) {
    work.push_back(make_workspace(widest));
    work.back().time() = time;
  }
  for (std::int64_t line = 0; line < lines && axis != z_axis && corrects_surface(axis); ++line)
    retain(axis, line, {0, layout.shape()[0]});
  if (axis == 0) {
    const auto own = own_lines();
    parallel_for(own.count(), 4, [&](std::int64_t begin, std::int64_t end, int worker) {
      StripeBoundary<Real> boundary{};
      for (auto line = own.first + begin; line < own.first + end; ++line) {
        correct_side_surfaces(line, {0, layout.shape()[0]});
        along_x(line, {0, layout.shape()[0]}, scale, boundary, work[std::size_t(worker)]);
      }
    });
    return;
  }
  const std::int64_t stripes = (nx + stripe_width - 1) / stripe_width, rows = layout.shape()[axis];
  const IndexRange steps = axis == z_axis ? steps_of_own_rows() : IndexRange{0, rows + rows_behind()};
  const IndexRange sheets = axis == z_axis ? IndexRange{0, lines / rows} : own_;
  // Free surfaces read columns of neighbouring stripes: these must not have been advanced.
  for (auto& surface : surfaces_[axis])
    surface.update_corrections(state_, {0, std::numeric_limits<std::int64_t>::max()});
  corrections_[axis].update(state_, {0, lines}, {0, nx});
  if (axis == z_axis && split_) split_->update_all();
  parallel_for(sheets.count() * stripes, 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t n = begin; n < end; ++n) {
      const auto stripe = n % stripes;
      const IndexRange columns{stripe * stripe_width, std::min((stripe + 1) * stripe_width, nx)};
      auto ring = make_ring(axis, columns.first, columns.count());
      Index<D> at{};
      if (D == 3) at[std::size_t(3 - axis)] = sheets.first + n / stripes;
      for (auto step = steps.first; step < steps.last; ++step)
        across(axis, at, step, columns, scale, ring, work[std::size_t(worker)]);
    }
  });
}

namespace {

/// The wave that enters the grid through an edge, from the outgoing wave there (E11). The impedance of the
/// ghost beyond the edge is part of the law (fill_material).
template <class Real>
void enter(EdgeLaw law, Wave wave, std::int64_t n, const Real* outgoing, Real* entering) {
  const bool motionless = extension_of(law, wave) == Extension::motionless;
  for (std::int64_t i = 0; i < n; ++i) entering[i] = motionless ? -outgoing[i] : Real(0);
}

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::queue_prefetch(std::int64_t line, const IndexRange& columns,
                                     PrefetchQueue<Real>& prefetch) const {
  const Index<D> at = state_.layout.line_index(line);
  prefetch.clear();
  prefetch.add(state_.field_row(at, 0) + columns.first, columns.count(), state_.layout.row_pitch(),
               state_.layout.rows());
  if (!state_.uniform_run(line, columns.first, columns.last))
    prefetch.add(state_.material_row(at, 0) + columns.first, columns.count(),
                 state_.material_layout.row_pitch(), state_.material_layout.rows());
  if (metric_.curvilinear(line))
    prefetch.add(metric_.first_row(at) + columns.first, columns.count(), metric_.row_pitch(),
                 metric_.rows_of_line);
}

/// At the low edge the wave upwards follows from the one downwards, at the high edge the other way round.
template <int D, class Real>
void Sweeps<D, Real>::enter_grid(int axis, int side, std::int64_t n, OutgoingWaves<Real> outgoing,
                                 OutgoingWaves<Real> entering) const {
  const EdgeLaw law = edges_[axis][side];
  for (int p = 0; p < pair_count(); ++p)
    enter(law, pairs_[axis][p].wave, n, side ? outgoing.up(p) : outgoing.down(p),
          side ? entering.down(p) : entering.up(p));
}

template <int D, class Real>
void Sweeps<D, Real>::add_tractions(const FreeSurface<D, Real>& surface, const Index<D>& line,
                                    const IndexRange& columns, OutgoingWaves<Real> entering) const {
  const auto& tractions = surface.tractions();
  if (tractions.empty()) return;
  const auto number = state_.layout.line_number(line);
  const std::int64_t from = columns.first + surface.along_x();
  const auto cells = surface.numbers({number, number + 1}, {from, columns.last + surface.along_x()});
  for (int p = 0; p < D; ++p)
    for (auto n = cells.first; n < cells.last; ++n) {
      const auto x = surface.column(n) - from;
      if (surface.side())
        entering.down(p)[x] += tractions.of(p)[n];
      else
        entering.up(p)[x] -= tractions.of(p)[n];
    }
}

template <int D, class Real>
void Sweeps<D, Real>::along_x(std::int64_t line, const IndexRange& columns, Real scale,
                              StripeBoundary<Real>& boundary, Workspace<Real>& work, bool begins) {
  const auto& layout = state_.layout;
  const bool low = columns.first == 0, high = columns.last == layout.shape()[0];
  const std::int64_t first = low ? 0 : begins ? columns.first - lag : columns.first + lag;
  const IndexRange reconstructed{first, high ? layout.padded_nx() : columns.last + lag};
  advance_piece({line,
                 reconstructed,
                 {columns.first, high ? reconstructed.last : columns.last},
                 state_.field_row(layout.line_index(line), 0),
                 layout.row_pitch(),
                 true},
                begins || low, high, scale, boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::along_copy(const RowFields<Real>& copy, const IndexRange& columns, bool begins,
                                 Real scale, StripeBoundary<Real>& boundary, Workspace<Real>& work) {
  const IndexRange reconstructed{begins ? columns.first - lag : columns.first + lag, columns.last + lag};
  advance_piece({copy.row, reconstructed, columns, copy.first, copy.pitch, false}, begins, false, scale,
                boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::put(const RowFields<Real>& copy, const IndexRange& columns) {
  const auto to = state_.row_fields(copy.row);
  for (int row = 0; row < state_.layout.rows(); ++row)
    std::copy(copy.field(row) + columns.first, copy.field(row) + columns.last, to.field(row) + columns.first);
}

/// A piece of a sweep along x with the stored values of the piece before it, unless it begins.
template <int D, class Real>
void Sweeps<D, Real>::advance_piece(const Piece& piece, bool begins, bool ends, Real scale,
                                    StripeBoundary<Real>& boundary, Workspace<Real>& work) {
  const auto faces = work.faces();
  const auto outgoing = work.outgoing();
  const std::int64_t last =
      piece.reconstructed.last - std::min(piece.reconstructed.first, piece.update.first);
  // Of the waiting cells their interface states, their outgoing waves and the one upwards of the cell before.
  const bool uniform_interior = !state_.uniform_interior[0].empty();
  const auto waiting = [&](std::int64_t from, auto&& copy) {
    for (int p = 0; p < pair_count(); ++p) {
      copy(faces.v(p) + from, boundary.v[p]);
      copy(faces.s(p) + from, boundary.s[p]);
      if (uniform_interior) copy(outgoing.up(p) + from - 1, boundary.up[p]);
      if (uniform_interior) copy(outgoing.down(p) + from, boundary.down[p]);
      copy(outgoing.up(p) + from + lag - 1, boundary.last_up[p]);
    }
  };
  // Of known size, so that it is inlined.
  if (!begins) waiting(0, [](Real* to, const auto& kept) { std::memcpy(to, kept, sizeof kept); });
  for (int p = 0; begins && p < pair_count() && piece.reconstructed.first > 0; ++p) outgoing.up(p)[-1] = 0;
  sweep_piece(piece, scale, work);
  if (ends) return;
  waiting(last - lag, [](const Real* from, auto& kept) { std::memcpy(kept, from, sizeof kept); });
}

template <int D, class Real>
void Sweeps<D, Real>::copy_ahead(const IndexRange& columns, Real scale, const RowFields<Real>& copy,
                                 Workspace<Real>& work) {
  const std::int64_t nx = state_.layout.shape()[0];
  const IndexRange reconstructed{std::max<std::int64_t>(columns.first - lag, 0),
                                 columns.last + lag >= nx ? state_.layout.padded_nx() : columns.last + lag};
  const auto from = state_.row_fields(copy.row);
  for (int row = 0; row < state_.layout.rows(); ++row)
    std::copy(from.field(row) + reconstructed.first - max_reach,
              from.field(row) + reconstructed.last + max_reach,
              copy.field(row) + reconstructed.first - max_reach);
  const auto outgoing = work.outgoing();
  for (int p = 0; p < pair_count() && reconstructed.first > 0; ++p) outgoing.up(p)[-1] = 0;
  sweep_piece({copy.row, reconstructed, columns, copy.first, copy.pitch, false}, scale, work);
}

template <int D, class Real>
RowFields<Real> Sweeps<D, Real>::ahead_along_x(std::int64_t line, const IndexRange& columns, Real scale,
                                               Workspace<Real>& work) {
  // Cell 0 of the copy would be here.
  const RowFields<Real> copy{line, work.copy() - std::max<std::int64_t>(columns.first - lag, 0),
                             work.pitch()};
  copy_ahead(columns, scale, copy, work);
  return copy;
}

/// The interface states of the faces before these cells of a row, to which `outgoing` and `faces` point.
template <int D, class Real>
void Sweeps<D, Real>::solve_along(std::int64_t line, const IndexRange& cells, bool begins, bool ends,
                                  OutgoingWaves<Real> outgoing, InterfaceStates<Real> faces) const {
  const Index<D> at = state_.layout.line_index(line);
  const auto solve = [&](const IndexRange& part) {
    const auto from = part.first - cells.first;
    const auto here = outgoing.at(from);
    const auto material = state_.material_from(at, part.first - 1, 0);
    if (metric_.curvilinear(line)) {
      const Real* const half_face = metric_.along(0, at, part.first).half_lo;
      curvilinear_kernels().solve_along(part.count(), here.at(-1), here, material,
                                        state_.material_from(at, part.first), half_face, faces.at(from));
      anisotropic_cells_.solve(0, {line, line, 1}, part, here.at(-1), here, material,
                               state_.material_from(at, part.first, 0), faces.at(from), half_face);
      return;
    }
    const auto* run = state_.uniform_run(line, part.first - 1, part.last);
    const auto lo = run ? run->template rows<D>(0) : material;
    face_kernels(run).solve_riemann(part.count(), here.at(-1), here, lo,
                                    run ? lo : state_.material_from(at, part.first, 0), faces.at(from));
    anisotropic_cells_.solve(0, {line, line, 1}, part, here.at(-1), here, material,
                             state_.material_from(at, part.first, 0), faces.at(from));
  };
  if (metric_.curvilinear(line)) return solve(cells);
  // The faces at the ends of a row have other material on one side.
  const std::int64_t nx = state_.layout.shape()[0];
  const std::int64_t inner_first = begins ? std::min(lag, cells.last) : cells.first;
  const std::int64_t inner_last = ends ? std::max(inner_first, (nx - 1) / lag * lag) : cells.last;
  const auto uniform_interior = state_.uniform_interior[0].of(line);
  for (const IndexRange& part : {IndexRange{cells.first, inner_first}, IndexRange{inner_first, inner_last},
                                 IndexRange{inner_last, cells.last}})
    // The first face of a run is that of the cell before it, too.
    split_by_runs(
        uniform_interior, 1, part, [](const IndexRange&) {}, solve);
}

/// The outgoing waves of the cell before the first reconstructed one are already in place.
template <int D, class Real>
void Sweeps<D, Real>::sweep_piece(const Piece& piece, Real scale, Workspace<Real>& work) {
  const std::int64_t nx = state_.layout.shape()[0],
                     base = std::min(piece.reconstructed.first, piece.update.first);
  const bool begins = piece.reconstructed.first == 0, ends = piece.reconstructed.last >= nx;
  const Index<D> at = state_.layout.line_index(piece.line);
  const auto first = work.outgoing().at(piece.reconstructed.first - base);
  if (begins) fill_ghost_cells(piece.line, 0, piece.fields, piece.pitch, scale);
  if (ends) fill_ghost_cells(piece.line, 1, piece.fields, piece.pitch, scale);
  reconstruct_row(0, at, piece.reconstructed, piece.fields, piece.pitch, 1, scale, first, work.prefetch());
  const auto enter_by = [&](int side, OutgoingWaves<Real> outgoing, OutgoingWaves<Real> entering) {
    enter_grid(0, side, 1, outgoing, entering);
    if (scale == 1) add_tractions(edge(0, side), at, piece.reconstructed, first);
  };
  if (begins) enter_by(0, first, first.at(-1));
  IndexRange with_faces = piece.reconstructed;
  if (ends) {
    const auto beyond = first.at(nx - piece.reconstructed.first);
    with_faces.last += lag;  // where the row fills whole blocks its last face is in the next one
    for (int p = 0; p < pair_count(); ++p)
      for (Real* const zero : {beyond.up(p), beyond.down(p)})
        std::fill(zero, zero + with_faces.last - nx, Real(0));
    enter_by(1, beyond.at(-1), beyond);
  }
  const auto faces = work.faces();
  solve_along(piece.line, with_faces, begins, ends, first, faces.at(with_faces.first - base));
  work.prefetch().prefetch_one();
  const auto here = work.outgoing().at(piece.update.first - base);
  const auto lo = faces.at(piece.update.first - base);
  update(0, at, piece.update, piece.fields, piece.pitch, scale, {lo, lo.at(1), here.at(-1), here, here.at(1)},
         work, piece.remember);
}

/// The interface states of the face before a row, of these columns.
template <int D, class Real>
void Sweeps<D, Real>::solve_across(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                   Real scale, Ring<Real>& ring) const {
  const auto& layout = state_.layout;
  const std::int64_t rows = layout.shape()[axis], x = columns.first;
  Index<D> line_lo = at, line_hi = at;
  line_lo[axis] = row - 1, line_hi[axis] = row;
  const bool has_lo = row > 0, has_hi = row < rows;
  const typename Cells::Sides lines{has_lo ? layout.line_number(line_lo) : -1,
                                    has_hi ? layout.line_number(line_hi) : -1, 0};
  const auto up = ring.outgoing(row - 1, x), down = ring.outgoing(row, x);
  const auto faces = ring.faces(row, x);
  const auto material_lo = state_.material_from(line_lo, x, axis),
             material_hi = state_.material_from(line_hi, x, axis);
  if ((has_lo && metric_.curvilinear_row(line_lo[z_axis])) ||
      (has_hi && metric_.curvilinear_row(line_hi[z_axis]))) {
    if (axis == z_axis) {
      const bool fluid = metric_.fluid_at_face(layout.line_number(line_hi));
      const Real sign = scale < 0 ? -1 : 1;
      const auto face = curvilinear_face(at, row, x, ring);
      curvilinear_kernels().solve_across[fluid](columns.count(), sign, face);
      solve_anisotropic_across(at, row, columns, face, sign, fluid);
      return;
    }
    const Real* const half_face = metric_.along(axis, line_hi, x).half_lo;
    curvilinear_kernels().solve_along(columns.count(), up, down, material_lo, material_hi, half_face, faces);
    anisotropic_cells_.solve(axis, lines, columns, up, down, material_lo, material_hi, faces, half_face);
    return;
  }
  const auto run = [&](const Index<D>& line, bool is_there) {
    return is_there ? state_.uniform_run(layout.line_number(line), x, columns.last) : nullptr;
  };
  const auto *lo = run(line_lo, has_lo), *hi = run(line_hi, has_hi);
  const bool uniform = lo && hi;
  face_kernels(uniform).solve_riemann(columns.count(), up, down,
                                      uniform ? lo->template rows<D>(axis) : material_lo,
                                      uniform ? hi->template rows<D>(axis) : material_hi, faces);
  anisotropic_cells_.solve(axis, lines, columns, up, down, material_lo, material_hi, faces);
}

template <int D, class Real>
void Sweeps<D, Real>::across(int axis, const Index<D>& at, std::int64_t step, const IndexRange& columns,
                             Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  const auto& layout = state_.layout;
  const std::int64_t rows = layout.shape()[axis], row = step - reach_;
  const IndexRange wide = with_padding(columns);
  const auto line = [&](std::int64_t k) {
    Index<D> index = at;
    index[axis] = k;
    return index;
  };
  if (row == 0) fill_ghost_rows(axis, at, 0, wide, scale);
  if (row == std::max<std::int64_t>(0, rows - reach_)) fill_ghost_rows(axis, at, 1, wide, scale);
  if (fused_row(axis, at, row, wide, scale, ring, work)) return;
  const std::int64_t x = wide.first, n = wide.count();
  if (row >= 0 && row < rows)
    reconstruct_row(axis, line(row), wide, state_.field_row(line(row), 0), layout.row_pitch(),
                    layout.stride(axis), scale, ring.outgoing(row, x), work.prefetch());
  if (row >= 0 && row <= rows) {
    const auto above = ring.outgoing(row - 1, x), here = ring.outgoing(row, x);
    if (row == 0) enter_grid(axis, 0, n, here, above);
    if (row == rows) enter_grid(axis, 1, n, above, here);
    // Splittings of fourth order have no whole steps: nothing is missing there. Beside void only now: they
    // are known once the row behind that of the surface is there.
    if (axis == z_axis && scale == 1) {
      if (row < rows) add_tractions(row == 0 ? edge(axis, 0) : beside_void(axis, 0), line(row), wide, above);
      if (row > 0)
        add_tractions(row == rows ? edge(axis, 1) : beside_void(axis, 1), line(row - 1), wide, here);
    }
    if (advance_curvilinear(axis, at, row, wide, scale, ring, work)) return;
    const auto uniform_runs = [&](std::int64_t k) {
      return k >= 0 && k < rows ? state_.uniform_interior[std::size_t(axis)].of(layout.line_number(line(k)))
                                : std::span<const IndexRange>();
    };
    const auto solve = [&](const IndexRange& part) { solve_across(axis, at, row, part, scale, ring); };
    // Faces between cells of uniform runs are left out.
    const auto below = uniform_runs(row - 1);
    split_by_runs(
        uniform_runs(row), 0, wide,
        [&](const IndexRange& part) {
          split_by_runs(
              below, 0, part, [](const IndexRange&) {}, solve);
        },
        solve);
    share(axis, at, row, wide, ring);
  }
  work.prefetch().prefetch_one();
  const std::int64_t done = step - rows_behind();
  if (done >= 0 && done < rows)
    update(axis, line(done), wide, state_.field_row(line(done), 0), layout.row_pitch(), scale,
           {ring.faces(done, x), ring.faces(done + 1, x), ring.outgoing(done - 1, x), ring.outgoing(done, x),
            ring.outgoing(done + 1, x)},
           work, true);
}

template <int D, class Real>
std::array<SharedFaces<Real>*, 2> Sweeps<D, Real>::share_faces(const Domain<D>& domain) {
  own_ = domain.own;
  const auto& layout = state_.layout;
  for (const int side : {0, 1}) {
    if (!domain.subdomain.cut(side)) continue;
    SharedFaces<Real> face{.row = side ? own_.last : own_.first, .pitch = layout.padded_nx()};
    face.rows = std::int64_t(2) * make_ring(z_axis, 0, 0).pairs();
    face.values.resize(std::size_t(layout.lines() / layout.shape()[z_axis] * face.rows * face.pitch));
    shared_[std::size_t(side)] = std::make_unique<SharedFaces<Real>>(std::move(face));
  }
  return {shared_[0].get(), shared_[1].get()};
}

template <int D, class Real>
bool Sweeps<D, Real>::split_and_shared_at_rest(std::int64_t line, const IndexRange& columns) const {
  if (split_ && !split_->at_rest(line, columns)) return false;
  for (const auto& face : shared_) {
    if (!face || !face->given) continue;
    const auto at = state_.layout.line_index(line);
    const auto row = at[z_axis];
    if (row != face->row && row + 1 != face->row) continue;
    const Real* const values = std::as_const(*face).of_line(D == 3 ? at[1] : 0);
    for (std::int64_t n = 0; n < face->rows; ++n) {
      const Real* const states = values + n * face->pitch;
      if (std::any_of(states + columns.first, states + columns.last, [](Real state) { return state != 0; }))
        return false;
    }
  }
  return true;
}

template <int D, class Real>
void Sweeps<D, Real>::share(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                            Ring<Real>& ring) {
  if (axis != z_axis) return;
  for (const auto& face : shared_) {
    if (!face || face->row != row) continue;
    const auto states = ring.faces(row, columns.first);
    Real* const values = face->of_line(D == 3 ? at[1] : 0) + columns.first;
    for (std::int64_t n = 0; n < face->rows; ++n) {
      Real *const here = states.first + n * states.pitch, *const there = values + n * face->pitch;
      face->given ? std::copy(there, there + columns.count(), here)
                  : std::copy(here, here + columns.count(), there);
    }
  }
}

template <int D, class Real>
bool Sweeps<D, Real>::filters(int axis, const Index<D>& line, const IndexRange& columns) const {
  return std::any_of(filters_.begin(), filters_.end(), [&](const auto* filter) {
    const auto parts = filter->filtered(axis, line, columns);
    return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.empty(); });
  });
}

/// The solution at the face before a row and the update of the row `reach` before, in one loop. Returns
/// false, and does nothing, where other work is needed between them.
template <int D, class Real>
bool Sweeps<D, Real>::advance_curvilinear(int axis, const Index<D>& at, std::int64_t row,
                                          const IndexRange& columns, Real scale, Ring<Real>& ring,
                                          Workspace<Real>& work) {
  const std::int64_t rows = state_.layout.shape()[axis], done = row - reach_, x = columns.first;
  // The update of the row just before would read what the solution writes.
  if (axis != z_axis || reach_ < 2 || done < 0 || !metric_.curvilinear_row(done)) return false;
  if (!metric_.curvilinear_row(row - 1) && (row == rows || !metric_.curvilinear_row(row))) return false;
  Index<D> here = at, advanced = at;
  here[axis] = row, advanced[axis] = done;
  if (filters(axis, advanced, columns)) return false;
  const bool fluid = metric_.fluid_at_face(state_.layout.line_number(here));
  const auto face = curvilinear_face(at, row, x, ring);
  const auto of = curvilinear_update(advanced, x, state_.field_row(advanced, 0), state_.layout.row_pitch(),
                                     ring.faces(done, x), ring.faces(done + 1, x));
  curvilinear_kernels().advance_across[fluid](columns.count(), scale, face, of);
  solve_anisotropic_across(at, row, columns, face, scale < 0 ? -1 : 1, fluid);
  anisotropic_across_.add_stress(state_.layout.line_number(advanced), columns, std::abs(scale), of);
  for (auto* const filter : filters_)
    if (const auto next = filter->next(work.time(), scale); next.axis >= 0)
      prepare(*filter, next, advanced, columns, state_.field_row(advanced, 0), state_.layout.row_pitch());
  work.prefetch().prefetch(prefetched_by_curvilinear + 2);
  return true;
}

template <int D, class Real>
void Sweeps<D, Real>::skip(std::int64_t step, const IndexRange& columns, Ring<Real>& ring) const {
  const std::int64_t row = step - reach_;
  if (row < 0) return;
  const std::int64_t last =
      columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last;
  const auto outgoing = ring.outgoing(row, columns.first);
  const auto faces = ring.faces(row, columns.first);
  const auto clear = [&](Real* zero) { std::fill(zero, zero + last - columns.first, Real(0)); };
  for (int p = 0; p < pair_count(); ++p)
    for (Real* const zero : {outgoing.up(p), outgoing.down(p), faces.v(p), faces.s(p)}) clear(zero);
  for (int c = 0; c < D && ring.pairs() > D; ++c) clear(faces.v(D) + c * faces.pitch);
}

/// Whether the loops over a row of a sweep across and over the one that it updates can be one.
template <int D, class Real>
bool Sweeps<D, Real>::fuses(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns) const {
  const auto& layout = state_.layout;
  const std::int64_t done = row - std::max(reach_, 1);
  if (monotone_ || done < 0 || row >= layout.shape()[axis]) return false;
  if (axis == z_axis)
    for (const auto& face : shared_)
      if (face && face->row == row) return false;
  Index<D> here = at, below = at, advanced = at;
  here[axis] = row, below[axis] = row - 1, advanced[axis] = done;
  const auto number = layout.line_number(here);
  // Uniform runs are faster with their own loops.
  if (state_.uniform_run(number, columns.first, columns.last)) return false;
  const auto lines = {number, layout.line_number(below), layout.line_number(advanced)};
  for (const auto* treatment : treatments_)
    if (treatment->beside(axis, layout.line_number(advanced))) return false;
  // Rows in between become those before and behind others.
  if (scale_of(axis, here, 1) != scale_of(axis, advanced, 1)) return false;
  const auto& plain = plain_lines_[std::size_t(axis)];
  // The material may have been filled in since these were found.
  const auto is_plain = [&](auto line) {
    return plain[std::size_t(line)] && state_.uniform_runs_of(line).empty();
  };
  if (std::all_of(lines.begin(), lines.end(), is_plain)) return true;
  for (const auto line : lines)
    if (metric_.curvilinear(line) || anisotropic_cells_.any(line, columns)) return false;
  // The outgoing waves downwards are not stored, which uniform runs would need.
  for (const auto line : lines)
    for (const auto& run : state_.uniform_interior[std::size_t(axis)].of(line))
      if (run.first < columns.last && run.last > columns.first) return false;
  return !any_stencils(axis, number, columns);
}

/// What that loop needs.
template <int D, class Real>
FusedRow<Real> Sweeps<D, Real>::fused(int axis, const Index<D>& at, std::int64_t row,
                                      const IndexRange& columns, Ring<Real>& ring) {
  const auto& layout = state_.layout;
  const std::int64_t x = columns.first, done = row - std::max(reach_, 1);
  Index<D> here = at, advanced = at;
  here[axis] = row, advanced[axis] = done;
  const std::int64_t pitch = state_.material_layout.row_pitch();
  const Real* const material = state_.material_row(here, row_b) + x;
  const Real* const of_done = state_.material_row(advanced, row_b) + x;
  const auto from = ring.outgoing(row - 1, x), to = ring.outgoing(row, x);
  const auto faces = ring.faces(row, x);
  return {
      swept_rows(axis, state_.field_row(here, 0) + x, layout.row_pitch()),
      layout.stride(axis),
      pitch,
      to.up(1) - to.up(0),
      faces.pitch,
      material - state_.material_layout.stride(axis),
      material,
      of_done,
      from.up(0),
      to.up(0),
      faces.first,
      ring.faces(done, x).first,
      ring.faces(done + 1, x).first,
      anisotropic_ ? of_done + coupling_row<D>(state_.kind, axis, axis_of_pair<D>(axis, 1)) * pitch : nullptr,
      anisotropic_ ? of_done + coupling_row<D>(state_.kind, axis, axis_of_pair<D>(axis, D - 1)) * pitch
                   : nullptr,
      p_row<D>(state_.kind, axis) * pitch,
      s_row<D>(state_.kind, axis, axis_of_pair<D>(axis, 1)) * pitch,
      s_row<D>(state_.kind, axis, axis_of_pair<D>(axis, D - 1)) * pitch};
}

/// A row across in one loop. Returns false, and does nothing, where other work is needed between its parts.
template <int D, class Real>
bool Sweeps<D, Real>::fused_row(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  if (!fuses(axis, at, row, columns)) return false;
  Index<D> here = at, advanced = at;
  here[axis] = row, advanced[axis] = row - std::max(reach_, 1);
  work.prefetch().prefetch(2);
  const auto& all = *kernels_[false];
  const auto loop = anisotropic_ ? all.fused_anisotropic_row[D - 2]
                    : shear_     ? all.fused_row[D - 2]
                                 : all.fused_fluid_row;
  filtered(axis, advanced, columns, state_.field_row(advanced, 0), scale, state_.layout.row_pitch(), work,
           true,
           [&] { loop(columns.count(), scale_of(axis, here, scale), fused(axis, at, row, columns, ring)); });
  work.prefetch().prefetch(2);
  return true;
}

namespace {

/// Signs of the mirror image of a pair.
template <class Real>
struct Mirror {
  Real v, s;
  bool constant;
  explicit Mirror(Extension law)
      : v(law == Extension::motionless ? -1 : 1),
        s(law == Extension::traction_free ? -1 : 1),
        constant(law == Extension::constant) {}
};
/// What stands for a ghost: a cell, counted from the edge, times signs.
template <class Real>
struct Image {
  std::int64_t cell;
  Real v, s;
};
/// Returns the image for ghost j beyond an edge of that law; fewer cells than j are mirrored at the `other`
/// end, too.
template <class Real>
Image<Real> image_of(std::int64_t j, std::int64_t cells, const Mirror<Real>& edge,
                     const Mirror<Real>& other) {
  if (edge.constant) return {0, edge.v, edge.s};
  Image<Real> image = {j, edge.v, edge.s};
  bool beyond_other = false;
  for (; image.cell >= cells; image.cell -= cells) {
    beyond_other = !beyond_other;
    const auto& mirror = beyond_other ? other : edge;
    if (mirror.constant) return {cells - 1, image.v, image.s};
    image.v *= mirror.v, image.s *= mirror.s;
  }
  if (beyond_other) image.cell = cells - 1 - image.cell;
  return image;
}

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::retain(int axis, std::int64_t line, const IndexRange& columns) {
  if (axis == 0 && split_) split_->retain(line, lagging(columns));
  corrections_[axis].retain(state_, line, axis == 0 ? lagging(columns) : columns);
  for (auto& surface : surfaces_[axis])
    surface.retain(state_, line, axis == 0 && surface.inside() ? lagging(columns) : columns);
}

template <int D, class Real>
void Sweeps<D, Real>::correct(FreeSurface<D, Real>& surface, const IndexRange& lines,
                              const IndexRange& columns) {
  if (!surface.empty() && !lines.empty()) surface.update_corrections(state_, surface.numbers(lines, columns));
}

template <int D, class Real>
void Sweeps<D, Real>::correct_side_surfaces(std::int64_t line, const IndexRange& columns) {
  if (split_) split_->update_line(line, lagging(columns));
  corrections_[0].update(state_, {line, line + 1}, lagging(columns));
  for (auto& surface : surfaces_[0]) correct(surface, {line, line + 1}, lagging(columns));
}

template <int D, class Real>
void Sweeps<D, Real>::correct_flank_surfaces(std::int64_t plane, const IndexRange& rows) {
  const auto of_plane = state_.layout.shape()[1];
  const IndexRange whole{0, state_.layout.padded_nx()};
  corrections_[1].update(
      state_, {plane * of_plane + rows.first, plane * of_plane + std::min(rows.last, of_plane)}, whole);
  for (auto& surface : surfaces_[1]) {
    IndexRange of{rows.first, std::min(rows.last, of_plane)};
    if (!surface.inside()) {
      const auto edge = surface.side() ? of_plane : 0;  // the face
      if (edge < rows.first || edge >= rows.last) continue;
      of = surface.side() ? IndexRange{edge - 1, edge} : IndexRange{0, 1};
    }
    correct(surface, {plane * of_plane + of.first, plane * of_plane + of.last}, whole);
  }
}

template <int D, class Real>
void Sweeps<D, Real>::correct_end_surfaces(std::int64_t step, const IndexRange& columns) {
  const auto rows = state_.layout.shape()[z_axis], lines = D == 2 ? 1 : state_.layout.shape()[1];
  const IndexRange of_row =
      D == 2 ? IndexRange{0, 1} : IndexRange{columns.first, std::min(columns.last, lines)};
  const IndexRange cells = D == 2 ? columns : IndexRange{0, state_.layout.padded_nx()};
  corrections_[z_axis].update(state_, {step * lines + of_row.first, step * lines + of_row.last}, cells);
  for (auto& surface : surfaces_[z_axis]) {
    // Inside of the row before: the one behind it must be as before the sweep, too.
    const auto row = surface.inside() || surface.side() ? step - 1 : 0;
    const bool due = surface.inside() ? row >= 0 && row < rows : step == (surface.side() ? rows : reach_);
    if (due) correct(surface, {row * lines + of_row.first, row * lines + of_row.last}, cells);
  }
  if (split_) split_->update(step, columns);
}

/// Fills the ghost cells that stencils read beyond an end of a row.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_cells(std::int64_t line, int side, Real* fields, std::int64_t pitch,
                                       Real scale) const {
  const std::int64_t n = state_.layout.shape()[0];
  const auto& edge = this->edge(0, side);
  const auto& all = pairs_[0];
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(edges_[0][side], all[p].wave));
    const Mirror<Real> other(extension_of(edges_[0][1 - side], all[p].wave));
    Real* const v = fields + all[p].v * pitch;
    Real* const s = fields + all[p].s * pitch;
    for (std::int64_t j = 0; j < reach_; ++j) {
      const auto image = image_of(j, n, mirror, other);
      const std::int64_t ghost = side ? n + j : -1 - j, cell = side ? n - 1 - image.cell : image.cell;
      v[ghost] = image.v * v[cell];
      s[ghost] = image.s * s[cell];
      if (edge.empty()) continue;
      v[ghost] += Real(2 * j + 1) * edge.velocity_correction(p)[line];
      s[ghost] += scale * edge.traction_correction(p)[line];
      if (scale == 1 && !edge.tractions().empty())
        v[ghost] += Real(2 * j + 1) * edge.tractions().bend(p)[line];
    }
  }
}

/// Fills the ghost rows that stencils read beyond the first or the last row of another axis.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_rows(int axis, const Index<D>& at, int side, const IndexRange& columns,
                                      Real scale) {
  const std::int64_t n = state_.layout.shape()[axis];
  const auto& edge = this->edge(axis, side);
  const auto& all = pairs_[axis];
  const auto first = edge.empty() ? 0 : edge.number(at);
  for (int p = 0; p < pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(edges_[axis][side], all[p].wave));
    const Mirror<Real> other(extension_of(edges_[axis][1 - side], all[p].wave));
    for (std::int64_t j = 0; j < reach_; ++j) {
      const auto image = image_of(j, n, mirror, other);
      Index<D> ghost = at, cell = at;
      ghost[axis] = side ? n + j : -1 - j;
      cell[axis] = side ? n - 1 - image.cell : image.cell;
      const auto fill = [&](int row, Real sign, const Real* gain, Real share) {
        Real* const to = state_.field_row(ghost, row);
        const Real* const source = state_.field_row(cell, row);
        for (std::int64_t i = columns.first; i < columns.last; ++i)
          to[i] = sign * source[i] + (gain ? share * gain[i] : Real(0));
      };
      fill(all[p].v, image.v, edge.empty() ? nullptr : edge.velocity_correction(p) + first, Real(2 * j + 1));
      fill(all[p].s, image.s, edge.empty() ? nullptr : edge.traction_correction(p) + first, scale);
      // As in across().
      if (const auto& splitting = edge.tractions(); axis == z_axis && scale == 1 && !splitting.empty()) {
        const Real* const bend = splitting.bend(p) + first;
        Real* const v = state_.field_row(ghost, all[p].v);
        for (std::int64_t i = columns.first; i < columns.last; ++i) v[i] += Real(2 * j + 1) * bend[i];
      }
      // Tractions on curvilinear rows take all stresses.
      if (p > 0 || axis != z_axis || !metric_.curvilinear_row(side ? n - 1 : 0)) continue;
      for (int row = D; row < FieldRows<D>::count; ++row)
        if (std::none_of(all.begin(), all.end(), [row](const Pair& pair) { return pair.s == row; }))
          fill(row, image.s, nullptr, 0);
    }
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Sweeps);

}  // namespace slipwave::solver
