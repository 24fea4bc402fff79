// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/incident_pml.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

constexpr auto piece = incident_piece;

/// From one cell of what was swept on.
template <int D, class Real>
SweptCells<D, Real> part_of(const SweptCells<D, Real>& swept, const IndexRange& cells) {
  auto part = swept;
  part.cells = cells;
  part.before += cells.first - swept.cells.first;
  part.now += cells.first - swept.cells.first;
  return part;
}

}  // namespace

template <int D>
PmlSettings pml_of_plane_wave(const Scene<D>& scene) {
  PmlSettings settings;
  settings.idle_cells = reach_of(scene.numerics.order) + 1;
  return settings;
}

template <int D, class Real>
IncidentPml<D, Real>::IncidentPml(const Layout<D>& layout, const Domain<D>& domain,
                                  std::unique_ptr<Pml<D, Real>> pml, const PmlSettings& settings,
                                  std::unique_ptr<IncidentWave<D, Real>> incident, SweepClocks<D> clocks)
    : domain_(domain),
      layout_(layout),
      pml_(std::move(pml)),
      idle_cells_(settings.idle_cells),
      incident_(std::move(incident)),
      clocks_(std::move(clocks)) {}

template <int D, class Real>
bool IncidentPml<D, Real>::initialize(State<D, Real>& state) {
  incident_->begin(state);
  return true;
}

template <int D, class Real>
void IncidentPml<D, Real>::serialize(Archive& archive) {
  pml_->serialize(archive);
  incident_->serialize(archive);
}

/// Whether a cell of a zone is one of its outermost.
template <int D, class Real>
bool IncidentPml<D, Real>::prescribed(int axis, std::int64_t cell) const {
  const auto from_end = domain_.grid.shape[std::size_t(axis)] - 1 - cell;
  return cell < std::min<std::int64_t>(idle_cells_, domain_.low_zone[std::size_t(axis)]) ||
         from_end < std::min<std::int64_t>(idle_cells_, domain_.high_zone[std::size_t(axis)]);
}

/// In the zones of the other axes all columns, in those of x the columns of these.
template <int D, class Real>
bool IncidentPml<D, Real>::enters(const StepTime& time, std::int64_t row, const IndexRange& columns) const {
  const auto line = layout_.line_index(row);
  bool in_zone =
      columns.first < domain_.low_zone[0] || columns.last > domain_.grid.shape[0] - domain_.high_zone[0];
  for (std::size_t axis = 1; axis < D; ++axis)
    in_zone = in_zone || line[axis] < domain_.low_zone[axis] ||
              line[axis] >= domain_.grid.shape[axis] - domain_.high_zone[axis];
  return in_zone && incident_->reaches(time, line);
}

template <int D, class Real>
void IncidentPml<D, Real>::filter(const SweptCells<D, Real>& swept) {
  const auto axis = swept.axis;
  const auto first = axis > 0 ? swept.row[std::size_t(axis)] : swept.cells.first;
  const int side = first < domain_.low_zone[std::size_t(axis)] ? 0 : 1;
  // Beyond the end of a row there are only cells that fill it up.
  const auto last = std::min(swept.cells.last, domain_.grid.shape[0]);
  auto cell = swept.cells.first;
  if (incident_->enters(axis, side))
    for (; cell < last; cell = std::min(cell + piece, last))
      filter_piece(part_of(swept, {cell, std::min(cell + piece, last)}), side);
  if (cell < swept.cells.last) pml_->filter(part_of(swept, {cell, swept.cells.last}));
}

template <int D, class Real>
void IncidentPml<D, Real>::filter_piece(const SweptCells<D, Real>& swept, int side) {
  constexpr int rows = FieldRows<D>::count;
  const auto axis = swept.axis;
  const auto n = swept.cells.count();
  std::array<Real, std::size_t(piece * rows)> was{}, is{}, scattered;
  auto line = swept.row;
  line[0] = 0;
  incident_->values(clocks_.before(swept.time), axis, side, line, swept.cells.first, n, was.data(), piece);
  incident_->values(clocks_.after(swept.time, double(swept.fraction)), axis, side, line, swept.cells.first, n,
                    is.data(), piece);
  auto part = swept;
  part.before = scattered.data();
  part.before_pitch = piece;
  for (std::size_t k = 0; k < swept.field_rows.size(); ++k) {
    const auto row = swept.field_rows[k];
    const Real* const before = swept.before + std::int64_t(k) * swept.before_pitch;
    Real* const now = swept.now + row * swept.pitch;
    for (std::int64_t i = 0; i < n; ++i) {
      scattered[k * piece + std::size_t(i)] = before[i] - was[std::size_t(row * piece + i)];
      now[i] -= is[std::size_t(row * piece + i)];
    }
  }
  pml_->filter(part);
  for (const int row : swept.field_rows) {
    Real* const now = swept.now + row * swept.pitch;
    for (std::int64_t i = 0; i < n; ++i) {
      const auto at = axis > 0 ? swept.row[std::size_t(axis)] : swept.cells.first + i;
      const Real incident = is[std::size_t(row * piece + i)];
      now[i] = prescribed(axis, at) ? incident : now[i] + incident;
    }
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, pml_of_plane_wave);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class IncidentPml);

}  // namespace slipwave::solver
