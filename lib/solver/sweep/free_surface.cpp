// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/free_surface.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/row_waves.hpp"

namespace slipwave::solver {
namespace {

/// The component along an axis.
template <int D>
double& component(RowVector<D, double>& vector, int axis) {
  if (axis == D - 1) return vector.z;
  if constexpr (D == 3)
    if (axis == 1) return vector.y;
  return vector.x;
}

/// The difference along `along` of the velocity `row` in cells of a free surface round one; nothing where
/// there is none.
template <int D>
std::optional<std::array<SurfaceTerm<D>, offsets_along.size()>> difference_along(const Domain<D>& domain,
                                                                                 const Index<D>& at, int axis,
                                                                                 int side, int along,
                                                                                 int row) {
  std::array<SurfaceTerm<D>, offsets_along.size()> terms;
  for (std::size_t k = 0; k < offsets_along.size(); ++k) {
    Index<D> offset{};
    offset[std::size_t(along)] = offsets_along[k];
    const auto term = surface_term(domain, at, offset, row, weights_along[k]);
    if (!term || !ends_at_free_surface(domain, term->cell, axis, side)) return {};
    terms[k] = *term;
  }
  return terms;
}

/// N of the first (side 0) or last face of the rows of a fitted grid at a cell beside it, and the height of
/// this cell in cells.
template <int D>
std::pair<RowVector<D, double>, double> end_of_rows(const Domain<D>& domain, const Index<D>& at, int side) {
  constexpr int z = D - 1, corners = 1 << z;
  RowVector<D, double> normal{};
  normal.z = 1;
  double height = 0;
  for (int n = 0; n < corners; ++n) {
    Index<D> upper = at, lower = at;
    for (int axis = 0; axis < z; ++axis) {
      upper[axis] += (n >> axis) & 1;
      lower[axis] = upper[axis];
    }
    ++lower[z];
    const double depth = corner_depth(domain, upper), below = corner_depth(domain, lower);
    height += (below - depth) / corners;
    for (int axis = 0; axis < z; ++axis)
      component(normal, axis) -= ((n >> axis) & 1 ? 2.0 : -2.0) / corners * (side ? below : depth);
  }
  return {normal, height};
}

}  // namespace

template <int D>
std::optional<SurfaceTerm<D>> surface_term(const Domain<D>& domain, const Index<D>& at,
                                           const Index<D>& offset, int row, double weight) {
  SurfaceTerm<D> term{at, row, weight};
  for (int axis = 0; axis < D; ++axis) {
    auto& place = term.cell[std::size_t(axis)];
    const std::int64_t n = domain.grid.shape[std::size_t(axis)];
    place += offset[std::size_t(axis)];
    const bool below = place < 0;
    if (!below && place < n) continue;
    const EdgeLaw law = domain.edges[axis][below ? 0 : 1];
    if (law == EdgeLaw::free) return {};
    term.weight *= image_sign<D>(law, axis, row);
    place = below ? -1 - place : 2 * n - 1 - place;
    if (law == EdgeLaw::absorbing) place = below ? 0 : n - 1;
    place = std::clamp<std::int64_t>(place, 0, n - 1);
  }
  if (!alike(domain, at, term.cell)) return {};
  return term;
}

template <int D>
std::pair<Point<D>, double> surface_at(const Domain<D>& domain, const Index<D>& at, int axis, int side) {
  if (domain.curvilinear(at[D - 1])) {
    const auto [normal, height] = end_of_rows(domain, at, side);
    return {normal_in_grid<D>(normal), height};
  }
  return {unit_vector<std::size_t(D)>(std::size_t(axis)), axis == D - 1 ? domain.height(at[D - 1]) : 1};
}

template <int D>
std::array<std::vector<SurfaceTerm<D>>, std::size_t(D)> surface_slopes(const Domain<D>& domain,
                                                                       const Index<D>& at, int axis, int side,
                                                                       const Point<D>& shares) {
  const bool curvilinear = domain.curvilinear(at[D - 1]);
  // On curvilinear rows sides keep the plain mirror image.
  if (!ends_at_free_surface(domain, at, axis, side) || domain.impedance(wave_s)(at) == 0 ||
      (curvilinear && axis < D - 1))
    return {};
  Index<D> before = at;
  for (std::int64_t n = 1; n < fewest_across; ++n) {
    Index<D> next = before;
    auto& place = next[std::size_t(axis)];
    place += side ? -1 : 1;
    if (place < 0 || place >= domain.grid.shape[std::size_t(axis)] || !alike(domain, before, next)) return {};
    before = next;
  }
  // The slope across takes away the traction that motion along the surface puts on it.
  const auto c = elasticity_at(domain, at);
  const auto [normal, away] = surface_at(domain, at, axis, side);
  const auto over = inverse_of(christoffel<D>(c, normal));
  std::array<std::vector<SurfaceTerm<D>>, std::size_t(D)> slopes;
  std::array<bool, std::size_t(D)> known;
  known.fill(true);
  for (int along = 0; along < D; ++along) {
    if (along == axis) continue;
    if (thin(domain, along)) {
      if (ends_free(domain, along)) return {};
      continue;
    }
    const double outward =
        (side ? -1 : 1) * away / (along == D - 1 ? domain.height(at[D - 1]) : 1) * shares[std::size_t(along)];
    const auto bend =
        product_of(over, tractions<D>(c, normal, unit_vector<std::size_t(D)>(std::size_t(along))));
    for (int of = 0; of < D; ++of) {
      const auto terms = difference_along(domain, at, axis, side, along, FieldRows<D>::velocity(of));
      for (std::size_t component = 0; component < D; ++component) {
        const double factor = outward * bend[component][std::size_t(of)];
        if (factor == 0) continue;
        known[component] = known[component] && terms;
        for (std::size_t k = 0; terms && k < terms->size(); ++k) {
          slopes[component].push_back((*terms)[k]);
          slopes[component].back().weight *= factor;
        }
      }
    }
  }
  for (std::size_t component = 0; component < D; ++component)
    if (!known[component]) slopes[component].clear();
  return slopes;
}

template <int D, class Real>
FreeSurface<D, Real>::FreeSurface(const Layout<D>& layout, int axis, int side, bool inside)
    : axis_(axis), side_(side), inside_(inside), outward_(side ? -1 : 1), layout_(layout) {
  // Only whole sweeps take tractions, and there are none along y.
  if (axis == 0) retained_cells_ = 2, retained_rows_ = int(layout.rows());
}

template <int D, class Real>
FreeSurface<D, Real>::FreeSurface(const Layout<D>& layout, const Domain<D>& domain, int axis, int side)
    : FreeSurface(layout, axis, side, false) {
  if (domain.edges[axis][side] != EdgeLaw::free) return;
  Grid<D> edge = domain.grid;
  edge.shape[std::size_t(axis)] = 1;
  std::vector<Index<D>> cells;
  for (std::int64_t n = 0; n < edge.size(); ++n) {
    cells.push_back(edge.index(n));
    cells.back()[std::size_t(axis)] = side ? layout.shape()[std::size_t(axis)] - 1 : 0;
  }
  find_corrections(domain, cells);
}

template <int D, class Real>
FreeSurface<D, Real> FreeSurface<D, Real>::beside_void(const Layout<D>& layout, const Domain<D>& domain,
                                                       int axis, int side) {
  FreeSurface surface(layout, axis, side, true);
  const auto& p_waves = domain.impedance(wave_p);
  const auto& grid = domain.grid;
  if (std::none_of(p_waves.begin(), p_waves.end(), [](float z) { return z == 0; })) return surface;
  std::int64_t stride = side ? 1 : -1;
  for (int other = 0; other < axis; ++other) stride *= grid.shape[std::size_t(other)];
  const float* const z = p_waves.data();
  std::vector<Index<D>> cells;
  for (std::int64_t n = std::max<std::int64_t>(0, -stride),
                    last = grid.size() - std::max<std::int64_t>(0, stride);
       n < last; ++n) {
    if (z[n] == 0 || z[n + stride] > 0) continue;
    const auto at = grid.index(n);
    if (at[std::size_t(axis)] == (side ? grid.shape[std::size_t(axis)] - 1 : 0)) continue;
    // Beside void in curvilinear rows InterfaceCorrections serve.
    if (axis == D - 1 && domain.curvilinear(at[D - 1])) continue;
    cells.push_back(at);
    surface.inside_cells_.end_lines_before(layout.line_number(at));
    surface.inside_cells_.cells.push_back({at[0], layout.cell(at)});
  }
  surface.inside_cells_.end_lines_before(layout.lines());
  surface.find_corrections(domain, cells);
  return surface;
}

template <int D, class Real>
void FreeSurface<D, Real>::find_corrections(const Domain<D>& domain, const std::vector<Index<D>>& cells) {
  for (const auto& at : cells) find_corrections(domain, at);
  if (empty()) return;
  Index<D> last = layout_.shape();
  for (auto& n : last) --n;
  const auto size = inside_ ? std::int64_t(cells.size()) : number(last) + layout_.padded_nx();
  if (axis_ < D - 1) retained_.assign(std::size_t(size * retained_cells_ * retained_rows_), 0);
  for (auto* lists : {&velocity_corrections_, &traction_corrections_})
    for (auto& list : *lists) list.assign(std::size_t(size), 0);
  // Sweeps along the axes between are halves.
  if (axis_ > 0 && axis_ < D - 1) return;
  tractions_ = SurfaceTractions<D, Real>(axis_, side_, size);
  const Layout<D> material(layout_.shape(), material_rows_of<D>(domain.material_kind()));
  for (const auto& at : cells)
    if (corrects_all(domain, at))
      tractions_.add(domain, at, number(at), place_of(at, 0, 0),
                     material.cell(at) + row_b * material.row_pitch(),
                     [&](const Index<D>& cell, int behind, int row) {
                       return place_of(cell, behind, row) - place_of(at, 0, 0);
                     });
  tractions_.finish();
}

/// Finds the corrections of all pairs at a cell.
template <int D, class Real>
void FreeSurface<D, Real>::find_corrections(const Domain<D>& domain, const Index<D>& at) {
  const auto kind = domain.material_kind();
  const Layout<D> material(layout_.shape(), material_rows_of<D>(kind));
  const auto place = [&](int material_row) {
    return material.cell(at) + material_row * material.row_pitch();
  };
  const double outward = outward_ / (axis_ == D - 1 ? domain.height(at[D - 1]) : 1);
  const auto slopes = surface_slopes(domain, at, axis_, side_);
  bool found = false;
  for (int pair = 0; pair < D; ++pair) {
    const int along = pair == 0 ? axis_ : axis_of_pair<D>(axis_, pair);
    const auto& terms = slopes[std::size_t(along)];
    if (terms.empty()) continue;
    found = true;
    const auto begin = terms_.size();
    for (const auto& term : terms) terms_.push_back({place_of(term.cell, 0, term.row), Real(term.weight)});
    const int impedance_row = pair == 0 ? p_row<D>(kind, axis_) : s_row<D>(kind, axis_, along);
    cells_.push_back(
        {pair, number(at), place(row_b), place(impedance_row), Real(outward), begin, terms_.size()});
    if (inside_) inside_cells_.cells[std::size_t(number(at))].corrected = true;
  }
  if (found && (domain.anisotropic_cell(at) || domain.curvilinear(at[D - 1])))
    matrix_ends_.push_back({number(at), place(row_b), stiffness_across(domain, at)});
}

/// Tractions as stresses of the first ghost: T = s N, with that of the last components along the rows as it
/// is.
template <int D, class Real>
SmallMatrix<std::size_t(D), Real> FreeSurface<D, Real>::stiffness_across(const Domain<D>& domain,
                                                                         const Index<D>& at) const {
  const auto [normal, away] = surface_at(domain, at, axis_, side_);
  const auto n = in_pairs<D>(normal, axis_);
  auto tensor = in_pairs<D>(christoffel<D>(elasticity_at(domain, at), normal), axis_);
  SmallMatrix<std::size_t(D), Real> stiffness;
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t i = 1; i < D; ++i) tensor[0][k] -= n[i] * tensor[i][k];
    for (std::size_t i = 0; i < D; ++i) stiffness[i][k] = Real(outward_ / away * tensor[i][k]);
  }
  return stiffness;
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::number(const Index<D>& at) const {
  if (inside_) return inside_cells_.from(layout_.line_number(at), at[0]);
  std::int64_t number = 0;
  for (int other = D - 1; other >= 0; --other)
    if (other != axis_)
      number = number * (other == 0 ? layout_.padded_nx() : layout_.shape()[std::size_t(other)]) +
               at[std::size_t(other)];
  return number;
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::corrected(const Index<D>& at) const {
  if (empty()) return -1;
  const auto* const found = inside_cells_.find(layout_.line_number(at), at[0]);
  return found && found->corrected ? found - inside_cells_.cells.data() : -1;
}

template <int D, class Real>
bool FreeSurface<D, Real>::corrects(const Index<D>& at, int pair) const {
  if (empty()) return false;
  const std::pair wanted(number(at), pair);
  const auto found = std::lower_bound(
      cells_.begin(), cells_.end(), wanted,
      [](const Cell& one, const auto& other) { return std::pair(one.number, one.pair) < other; });
  return found != cells_.end() && std::pair(found->number, found->pair) == wanted;
}

/// Whether all pairs of which there is motion are corrected.
template <int D, class Real>
bool FreeSurface<D, Real>::corrects_all(const Domain<D>& domain, const Index<D>& at) const {
  for (int pair = 0; pair < D; ++pair)
    if ((pair == 0 || !thin(domain, axis_of_pair<D>(axis_, pair))) && !corrects(at, pair)) return false;
  return true;
}

template <int D, class Real>
IndexRange FreeSurface<D, Real>::numbers(const IndexRange& lines, const IndexRange& columns) const {
  if (!inside_ && axis_ == 0) return lines;
  const auto at = [&](std::int64_t line, std::int64_t x) {
    if (inside_) return inside_cells_.from(line, x);
    const auto column = std::clamp<std::int64_t>(x, 0, layout_.padded_nx());
    // In 3-D an edge has a line of each row along y or along z.
    const auto of_row = layout_.shape()[1];
    return (D == 2 ? 0 : axis_ == 1 ? line / of_row : line % of_row) * layout_.padded_nx() + column;
  };
  return {at(lines.first, columns.first), at(lines.last - 1, columns.last)};
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::place_of(const Index<D>& at, int behind, int row) const {
  if (axis_ < D - 1) return (number(at) * retained_cells_ + behind) * retained_rows_ + row;
  return layout_.cell(at) + behind * outward_ * layout_.stride(axis_) + row * layout_.row_pitch();
}

template <int D, class Real>
void FreeSurface<D, Real>::retain(const State<D, Real>& state, std::int64_t line, const IndexRange& columns) {
  if (empty()) return;
  const auto copy = [&](std::int64_t number, std::int64_t place, std::int64_t cells) {
    Real* retained = retained_.data() + number * retained_cells_ * retained_rows_;
    const Real* const from = state.fields.data() + place;
    for (std::int64_t x = 0; x < cells; ++x)
      for (int behind = 0; behind < retained_cells_; ++behind)
        for (int row = 0; row < retained_rows_; ++row)
          *retained++ = from[row * state.layout.row_pitch() + x + behind * outward_];
  };
  if (inside_) {
    const auto here = numbers({line, line + 1}, columns);
    for (auto number = here.first; number < here.last; ++number) copy(number, inside_cells_[number].place, 1);
    return;
  }
  auto at = state.layout.line_index(line);
  const auto edge = side_ ? layout_.shape()[std::size_t(axis_)] - 1 : 0;
  if (axis_ == 0 ? edge < columns.first || edge >= columns.last : at[std::size_t(axis_)] != edge) return;
  at[std::size_t(axis_)] = edge;
  copy(number(at), layout_.cell(at), axis_ > 0 ? layout_.shape()[0] : 1);
}

template <int D, class Real>
void FreeSurface<D, Real>::update_corrections(const State<D, Real>& state, const IndexRange& numbers) {
  if (empty()) return;
  const auto& [first, last] = numbers;
  const Real* const fields = axis_ < D - 1 ? retained_.data() : state.fields.data();
  const Real* const material = state.material.data();
  auto cell = std::lower_bound(cells_.begin(), cells_.end(), first,
                               [](const Cell& one, std::int64_t number) { return one.number < number; });
  for (; cell != cells_.end() && cell->number < last; ++cell) {
    Real slope = 0;
    for (auto term = cell->terms_begin; term < cell->terms_end; ++term)
      slope += terms_[term].weight * fields[terms_[term].place];
    const Real z = material[cell->impedance], stiffness = z * z * material[cell->b];
    velocity_corrections_[std::size_t(cell->pair)][std::size_t(cell->number)] = slope;
    traction_corrections_[std::size_t(cell->pair)][std::size_t(cell->number)] =
        cell->outward * stiffness * slope;
  }
  auto end = std::lower_bound(matrix_ends_.begin(), matrix_ends_.end(), first,
                              [](const MatrixEnd& one, std::int64_t number) { return one.number < number; });
  for (; end != matrix_ends_.end() && end->number < last; ++end) {
    const auto n = std::size_t(end->number);
    std::array<Real, std::size_t(D)> slopes;
    for (std::size_t k = 0; k < D; ++k) slopes[k] = material[end->b] * velocity_corrections_[k][n];
    const auto stresses = product_of(end->stiffness, slopes);
    for (std::size_t i = 0; i < D; ++i) traction_corrections_[i][n] = stresses[i];
  }
  tractions_.update(fields, material, first, last);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, surface_slopes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, surface_term);
SLIPWAVE_INSTANTIATE_D(FUNCTION, surface_at);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class FreeSurface);

}  // namespace slipwave::solver
