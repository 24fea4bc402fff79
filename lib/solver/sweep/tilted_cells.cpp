#include "solver/sweep/tilted_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/kernels/reconstruction.hpp"

namespace slipwave::solver {
namespace {

/// Calls what(entry, its place among the columns) for entries of a row that lie in these columns.
template <class Entry, class What>
void for_each_of(const std::vector<Entry>& entries, const std::vector<std::int64_t>& first, std::int64_t row,
                 const IndexRange& columns, const What& what) {
  const auto end = entries.begin() + first[std::size_t(row) + 1];
  for (auto entry = std::lower_bound(entries.begin() + first[std::size_t(row)], end, columns.first,
                                     [](const Entry&of, std::int64_t x) { return of.x < x; });
       entry != end && entry->x < columns.last; ++entry)
    what(*entry, entry->x - columns.first);
}

}  // namespace

template <int D, class Real>
TiltedCells<D, Real>::TiltedCells(
    const State<D, Real>& state, const Domain<D>& domain, int reach,
    const std::array<std::array<InterfaceStencils, 2>, std::size_t(D)>& stencils) {
  if (domain.tilted().empty()) return;
  const auto& shape = domain.grid.shape;
  for (int axis = 0; axis < D; ++axis) {
    auto& of = of_axis_[std::size_t(axis)];
    of.first_cells.assign(std::size_t(shape[D - 1]) + 1, 0);
    for (const auto& tilted : domain.tilted()) {
      const auto at = domain.grid.index(tilted.cell);
      const auto row = at[D - 1];
      const auto& c = tilted.stiffness;
      const double step = double(state.material.data()[state.material_layout.cell(at)]) * tilted.rho;  // dt/h
      const bool along_x = axis == 0;
      const double normal = along_x ? c.c11 : c.c33, mixed = along_x ? c.c15 : c.c35;
      const auto waves = waves_along(tilted, axis);
      // Of the cell as loops take it.
      const double zp = domain.impedance(wave_p, axis)(at), zs = domain.impedance(wave_s)(at);
      const double p = zp * zp / tilted.rho, mu = zs * zs / tilted.rho;
      const double coupling = domain.anisotropic() ? domain.coupling(at) / tilted.rho : p - 2 * mu;
      Cell cell{};
      cell.x = std::int32_t(at[0]);
      cell.cosine = Real(waves.cosine), cell.sine = Real(waves.sine);
      for (std::size_t wave : {0, 1}) {
        cell.z[wave] = Real(waves.z[wave]);
        cell.courant[wave] = Real(waves.z[wave] / tilted.rho * step);
      }
      cell.impedance = {Real(waves.along), Real(waves.mixed), Real(waves.across)};
      cell.more = {Real((normal - p) * step), Real(mixed * step), Real((c.c55 - mu) * step)};
      cell.passive = Real((c.c13 - coupling) * step);
      cell.passive_across = Real((along_x ? c.c35 : c.c15) * step);
      cell.reach = reach;
      for (const Wave wave : {wave_p, wave_s}) {
        const auto* found = stencils[std::size_t(axis)][wave].find(row, at[0]);
        const auto whole = std::int8_t(reach);
        cell.stencils[wave] =
            found ? *found : InterfaceStencil{cell.x, whole, whole, Extension::none, Extension::none, 0, 0,
                                              0,      0,     whole};
        cell.reach = std::min(cell.reach, int(cell.stencils[wave].reach));
      }
      of.cells.push_back(cell);
      of.first_cells[std::size_t(row) + 1] = std::int64_t(of.cells.size());
    }
    for (std::size_t row = 1; row < of.first_cells.size(); ++row)
      of.first_cells[row] = std::max(of.first_cells[row], of.first_cells[row - 1]);
    add_faces(axis, shape);
  }
}

/// Those on both sides of each cell.
template <int D, class Real>
void TiltedCells<D, Real>::add_faces(int axis, const Index<D>& shape) {
  auto& of = of_axis_[std::size_t(axis)];
  const auto number = [&](std::int64_t row, std::int64_t x) {
    std::int32_t found = none;
    if (row >= 0 && row < shape[D - 1])
      for_each_of(of.cells, of.first_cells, row, {x, x + 1},
                  [&](const Cell& cell, std::int64_t) { found = std::int32_t(&cell - of.cells.data()); });
    return found;
  };
  // Before a row there are faces of its cells and of those of the row before.
  const std::int64_t rows = axis == 0 ? shape[D - 1] : shape[D - 1] + 1;
  of.first_faces.assign(1, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    std::vector<std::int64_t> columns;
    for (const auto& [from, to] :
         {std::pair{row, std::int64_t(axis == 0)}, std::pair{row - (axis != 0), std::int64_t(0)}})
      if (from >= 0 && from < shape[D - 1])
        for (auto n = of.first_cells[std::size_t(from)]; n < of.first_cells[std::size_t(from) + 1]; ++n)
          columns.push_back(of.cells[std::size_t(n)].x + to);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const auto x : columns)
      of.faces.push_back(
          {std::int32_t(x), axis == 0 ? number(row, x - 1) : number(row - 1, x), number(row, x)});
    of.first_faces.push_back(std::int64_t(of.faces.size()));
  }
}

template <int D, class Real>
bool TiltedCells<D, Real>::any(std::int64_t row, const IndexRange& columns) const {
  if (empty()) return false;
  bool found = false;
  for_each_of(of_axis_[0].cells, of_axis_[0].first_cells, row, columns,
              [&](const Cell&, std::int64_t) { found = true; });
  return found;
}

/// Both waves of the cell from v and s along their own directions of motion (theory.md (T4)).
template <int D, class Real>
template <int Order>
void TiltedCells<D, Real>::reconstruct_cell_of(const Cell& cell, std::int64_t stride, std::int64_t at,
                                               const Pairs& pairs, Real scale, std::array<Real, 2>& up,
                                               std::array<Real, 2>& down) const {
  constexpr int reach = reach_of(Order), count = 2 * reach + 1;
  Real v[2][count], s[2][count];
  for (std::size_t p : {0, 1})
    extended_pair(cell.stencils[p], reach, stride, pairs[p].v + at, pairs[p].s + at, pairs[p].corrections,
                  scale, v[p], s[p]);
  const Real sign = scale < 0 ? -1 : 1;
  up = down = {0, 0};
  for (std::size_t wave : {0, 1}) {
    const Real along = wave == 0 ? cell.cosine : -cell.sine, across = wave == 0 ? cell.sine : cell.cosine;
    Real v_of[count], s_of[count], of_up = 0, of_down = 0;
    for (int k = 0; k < count; ++k) {
      v_of[k] = along * v[0][k] + across * v[1][k];
      s_of[k] = along * s[0][k] + across * s[1][k];
    }
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * cell.z[wave],
                            sign * scale * cell.courant[wave], of_up, of_down);
    up[0] += along * of_up, up[1] += across * of_up;
    down[0] += along * of_down, down[1] += across * of_down;
  }
}

template <int D, class Real>
void TiltedCells<D, Real>::reconstruct(int axis, std::int64_t row, const IndexRange& columns,
                                       std::int64_t stride, const Pairs& pairs, Real scale,
                                       OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  for_each_of(of.cells, of.first_cells, row, columns, [&](const Cell& cell, std::int64_t i) {
    std::array<Real, 2> up{}, down{};
    const auto as = [&]<std::size_t... N>(std::index_sequence<N...>) {
      ((cell.reach == reach_of(orders[N])
            ? reconstruct_cell_of<orders[N]>(cell, stride, i, pairs, scale, up, down)
            : void()),
       ...);
    };
    as(std::make_index_sequence<std::size_t(order_count)>());
    for (std::size_t p : {0, 1}) outgoing.up(int(p))[i] = up[p], outgoing.down(int(p))[i] = down[p];
  });
}

template <int D, class Real>
void TiltedCells<D, Real>::solve(int axis, std::int64_t row, const IndexRange& columns,
                                 OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                                 const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                                 InterfaceStates<Real> faces) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  for_each_of(of.faces, of.first_faces, row, columns, [&](const Face& face, std::int64_t i) {
    const auto impedance = [&](std::int32_t cell, const MaterialRows<Real>& material) {
      return cell == none ? Matrix{material.zp[i], 0, material.zs[i]} : of.cells[std::size_t(cell)].impedance;
    };
    const Matrix z = impedance(face.lo, lo), other = impedance(face.hi, hi);
    const Real a = z.along + other.along, b = z.mixed + other.mixed, c = z.across + other.across;
    const Real up_p = below.up(0)[i], up_s = below.up(1)[i];
    const Real p = up_p + above.down(0)[i], s = up_s + above.down(1)[i], share = 1 / (a * c - b * b);
    // Z of both sides times v* is the sum of what comes in (theory.md (T5)).
    const Real v_p = (c * p - b * s) * share, v_s = (a * s - b * p) * share;
    faces.v(0)[i] = v_p, faces.v(1)[i] = v_s;
    faces.s(0)[i] = z.along * v_p + z.mixed * v_s - up_p;
    faces.s(1)[i] = z.mixed * v_p + z.across * v_s - up_s;
  });
}

template <int D, class Real>
void TiltedCells<D, Real>::add_stress(int axis, std::int64_t row, const IndexRange& columns, Real size,
                                      InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                                      const SweptRows<Real>& rows) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  for_each_of(of.cells, of.first_cells, row, columns, [&](const Cell& cell, std::int64_t i) {
    const Real p = size * (hi.v(0)[i] - lo.v(0)[i]), s = size * (hi.v(1)[i] - lo.v(1)[i]);
    rows.s[i] += cell.more.along * p + cell.more.mixed * s;
    rows.st[i] += cell.more.mixed * p + cell.more.across * s;
    rows.passive[i] += cell.passive * p + cell.passive_across * s;
  });
}

template <int D, class Real>
std::int64_t TiltedCells<D, Real>::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& of : of_axis_) bytes += of.cells.size() * sizeof(Cell) + of.faces.size() * sizeof(Face);
  return std::int64_t(bytes);
}

template class TiltedCells<2, float>;
template class TiltedCells<2, double>;
template class TiltedCells<3, float>;
template class TiltedCells<3, double>;

}  // namespace slipwave::solver
