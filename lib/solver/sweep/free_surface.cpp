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

/// The velocities round a cell of a free surface.
template <int D>
class AlongSurface {
 public:
  AlongSurface(const Domain<D>& domain, const Index<D>& at, int axis, int side)
      : domain_(domain), at_(at), axis_(axis), side_(side) {}

  /// Adds the difference along `along` of the velocity `row`, times `factor`; false where there is none.
  bool add_difference(int along, int row, double factor) {
    for (std::size_t k = 0; k < offsets_along.size(); ++k) {
      Index<D> offset{};
      offset[std::size_t(along)] = offsets_along[k];
      if (!add_term(domain_, at_, offset, row, factor * weights_along[k], terms_)) return false;
      if (!ends_at_free_surface(domain_, terms_.back().cell, axis_, side_)) return false;
    }
    return true;
  }
  const std::vector<SurfaceTerm<D>>& terms() const { return terms_; }

 private:
  const Domain<D>& domain_;
  Index<D> at_;
  int axis_, side_;
  std::vector<SurfaceTerm<D>> terms_;
};

/// Returns the terms of the slope of a velocity at a free surface of a curvilinear row at an end of z: all
/// velocities of the neighbours take part.
template <int D>
std::vector<SurfaceTerm<D>> bent_slope(const Domain<D>& domain, const Index<D>& at, int side, int row) {
  const auto [normal, height] = end_of_rows(domain, at, side);
  const double zp = domain.impedance(wave_p)(at), zs = domain.impedance(wave_s)(at);
  const double mu = zs * zs / (zp * zp), outward = side ? -1 : 1,
               factor = outward * height / dot(normal, normal);
  AlongSurface<D> velocities(domain, at, D - 1, side);
  for (int along = 0; along < D - 1; ++along) {
    if (thin(domain, along)) {
      if (ends_free(domain, along)) return {};
      continue;
    }
    for (int of = 0; of < D; ++of) {
      std::array<RowVector<D, double>, std::size_t(D - 1)> one{};
      component(one[std::size_t(along)], of) = 1;
      auto bend = scaled(normal, factor, factor / mu, traction_of_motion_along<D>(normal, 1.0, mu, one));
      const double share = component(bend, row);
      if (share != 0 && !velocities.add_difference(along, FieldRows<D>::velocity(of), share)) return {};
    }
  }
  return velocities.terms();
}

/// Returns the terms of the slope of a velocity at a free surface of an anisotropic cell of a curvilinear
/// row: the acoustic tensor of N takes the slopes to the traction of motion along the rows.
template <int D>
std::vector<SurfaceTerm<D>> anisotropic_bent_slope(const Domain<D>& domain, const Index<D>& at, int side,
                                                   int row) {
  const auto [normal, height] = end_of_rows(domain, at, side);
  const auto c = elasticity_at(domain, at);
  const auto n = normal_in_grid<D>(normal);
  const auto over = inverse_of(christoffel<D>(c, n));
  const double outward = (side ? -1 : 1) * height;
  AlongSurface<D> velocities(domain, at, D - 1, side);
  for (int along = 0; along < D - 1; ++along) {
    if (thin(domain, along)) {
      if (ends_free(domain, along)) return {};
      continue;
    }
    const auto bend = product_of(over, tractions<D>(c, n, unit_vector<std::size_t(D)>(std::size_t(along))));
    for (int of = 0; of < D; ++of) {
      const double share = outward * bend[std::size_t(row)][std::size_t(of)];
      if (share != 0 && !velocities.add_difference(along, FieldRows<D>::velocity(of), share)) return {};
    }
  }
  return velocities.terms();
}

/// Adds what motion along one axis of the edge bends of a velocity in rock whose axes are turned; false where
/// there is no difference.
template <int D>
bool add_turned(const Elasticity<D>& elasticity, int axis, int along, int row, double outward,
                AlongSurface<D>& velocities) {
  const auto coupling = edge_coupling<D>(elasticity, axis, along);
  for (int of = 0; of < D; ++of) {
    const double factor = outward * coupling[std::size_t(row)][std::size_t(of)];
    if (factor != 0 && !velocities.add_difference(along, FieldRows<D>::velocity(of), factor)) return false;
  }
  return true;
}

/// The sign of a field in its mirror image at an edge of an axis.
template <int D>
double sign_beyond(EdgeLaw law, int axis, int row) {
  using Rows = FieldRows<D>;
  const bool is_velocity = row < D;
  bool shear = is_velocity && row != Rows::velocity(axis);
  for (int other = 0; other < D; ++other) shear |= other != axis && row == Rows::shear_stress(axis, other);
  const auto extension = extension_of(law, shear ? wave_s : wave_p);
  if (is_velocity) return extension == Extension::motionless ? -1 : 1;
  return extension == Extension::traction_free ? -1 : 1;
}

}  // namespace

template <int D>
bool add_term(const Domain<D>& domain, const Index<D>& at, const Index<D>& offset, int row, double weight,
              std::vector<SurfaceTerm<D>>& terms) {
  SurfaceTerm<D> term{at, row, weight};
  for (int axis = 0; axis < D; ++axis) {
    auto& place = term.cell[std::size_t(axis)];
    const std::int64_t n = domain.grid.shape[std::size_t(axis)];
    place += offset[std::size_t(axis)];
    const bool below = place < 0;
    if (!below && place < n) continue;
    const EdgeLaw law = domain.edges[axis][below ? 0 : 1];
    if (law == EdgeLaw::free) return false;
    term.weight *= sign_beyond<D>(law, axis, row);
    place = below ? -1 - place : 2 * n - 1 - place;
    if (law == EdgeLaw::absorbing) place = below ? 0 : n - 1;
    place = std::clamp<std::int64_t>(place, 0, n - 1);
  }
  if (!alike(domain, at, term.cell)) return false;
  terms.push_back(term);
  return true;
}

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

template <int D>
std::vector<SurfaceTerm<D>> surface_slope(const Domain<D>& domain, const Index<D>& at, int axis, int side,
                                          int row) {
  using Rows = FieldRows<D>;
  const double zs = domain.impedance(wave_s)(at);
  const bool bent = domain.bent(at[D - 1]);
  // On bent rows sides keep the plain mirror image.
  if (!ends_at_free_surface(domain, at, axis, side) || zs == 0 || (bent && axis < D - 1)) return {};
  Index<D> before = at;
  for (std::int64_t n = 1; n < fewest_across; ++n) {
    Index<D> next = before;
    auto& place = next[std::size_t(axis)];
    place += side ? -1 : 1;
    if (place < 0 || place >= domain.grid.shape[std::size_t(axis)] || !alike(domain, before, next)) return {};
    before = next;
  }
  if (bent && domain.anisotropic_cell(at)) return anisotropic_bent_slope(domain, at, side, row);
  if (bent) return bent_slope(domain, at, side, row);
  const double height = domain.height(at[D - 1]);
  AlongSurface<D> velocities(domain, at, axis, side);
  for (int along = 0; along < D; ++along) {
    if (along == axis) continue;
    // The first ghost lies a cell of this axis away, neighbours along the edge one of the other.
    const double outward = (side ? -1 : 1) * (axis == D - 1 ? height : along == D - 1 ? 1 / height : 1);
    if (thin(domain, along)) {
      if (ends_free(domain, along)) return {};
      continue;
    }
    if (const auto* const medium = domain.anisotropic_medium(at)) {
      if (!add_turned(medium->elasticity, axis, along, row, outward, velocities)) return {};
      continue;
    }
    const auto add = [&](int of, double factor) {
      return factor == 0 || velocities.add_difference(along, Rows::velocity(of), outward * factor);
    };
    bool found = true;
    if (row == Rows::velocity(axis))
      found = add(along, domain.coupling_at_edge(at, axis, along));
    else if (row == Rows::velocity(along))
      found = add(axis, 1);
    if (!found) return {};
  }
  return velocities.terms();
}

template <int D, class Real>
FreeSurface<D, Real>::FreeSurface(const Layout<D>& layout, int axis, int side, bool inside)
    : axis_(axis),
      side_(side),
      inside_(inside),
      outward_(side ? -1 : 1),
      padded_nx_(layout.padded_nx()),
      shape_(layout.shape()) {
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
    cells.back()[std::size_t(axis)] = side ? shape_[std::size_t(axis)] - 1 : 0;
  }
  find_corrections(layout, domain, cells);
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
    // Beside void in bent rows InterfaceCorrections serve.
    if (axis == D - 1 && domain.bent(at[D - 1])) continue;
    cells.push_back(at);
    surface.keys_.push_back(surface.key_of(at));
    surface.places_.push_back(layout.cell(at));
  }
  surface.find_corrections(layout, domain, cells);
  return surface;
}

template <int D, class Real>
void FreeSurface<D, Real>::find_corrections(const Layout<D>& layout, const Domain<D>& domain,
                                            const std::vector<Index<D>>& cells) {
  if (inside_) corrected_.assign(cells.size(), 0);
  for (const auto& at : cells) find_corrections(layout, domain, at);
  if (empty()) return;
  Index<D> last = shape_;
  for (auto& n : last) --n;
  const auto size = inside_ ? std::int64_t(cells.size()) : number(last) + padded_nx_;
  if (axis_ < D - 1) retained_.assign(std::size_t(size * retained_cells_ * retained_rows_), 0);
  for (auto* lists : {&velocity_corrections_, &traction_corrections_})
    for (auto& list : *lists) list.assign(std::size_t(size), 0);
  // Sweeps along the axes between are halves.
  if (axis_ > 0 && axis_ < D - 1) return;
  tractions_ = SurfaceTractions<D, Real>(axis_, side_, size);
  const Layout<D> material(shape_, material_rows_of<D>(domain.material_kind()));
  for (const auto& at : cells)
    if (!inside_ || corrected(at) >= 0)
      tractions_.add(domain, at, number(at), place_of(layout, at, 0, 0),
                     material.cell(at) + row_b * material.row_pitch(),
                     [&](const Index<D>& cell, int behind, int row) {
                       return place_of(layout, cell, behind, row) - place_of(layout, at, 0, 0);
                     });
  tractions_.finish();
}

/// Finds the corrections of all pairs at a cell.
template <int D, class Real>
void FreeSurface<D, Real>::find_corrections(const Layout<D>& layout, const Domain<D>& domain,
                                            const Index<D>& at) {
  const auto kind = domain.material_kind();
  const Layout<D> material(shape_, material_rows_of<D>(kind));
  const auto place = [&](int material_row) {
    return material.cell(at) + material_row * material.row_pitch();
  };
  const double outward = outward_ / (axis_ == D - 1 ? domain.height(at[D - 1]) : 1);
  bool found = false;
  for (int pair = 0; pair < D; ++pair) {
    const int along = pair == 0 ? axis_ : axis_of_pair<D>(axis_, pair);
    const auto terms = surface_slope(domain, at, axis_, side_, FieldRows<D>::velocity(along));
    found = !terms.empty();
    if (!found) continue;
    const auto begin = terms_.size();
    for (const auto& term : terms)
      terms_.push_back({place_of(layout, term.cell, 0, term.row), Real(term.weight)});
    const int impedance_row = pair == 0 ? p_row<D>(kind, axis_) : s_row<D>(kind, axis_, along);
    cells_.push_back(
        {pair, number(at), place(row_b), place(impedance_row), Real(outward), begin, terms_.size()});
    if (inside_) corrected_[std::size_t(number(at))] = 1;
    if (pair > 0 || !domain.bent(at[D - 1])) continue;
    const auto [normal, height] = end_of_rows(domain, at, side_);
    BentEnd end{number(at), place(row_b), place(row_zp), place(row_zs), {}, {}};
    end.normal.z = Real(normal.z), end.normal.x = Real(normal.x);
    if constexpr (D == 3) end.normal.y = Real(normal.y);
    if (domain.anisotropic_cell(at)) find_tensor(domain, at, normal, outward_ / height, end);
    end.factor = Real(dot(normal, normal) * outward_ / height);
    bent_ends_.push_back(end);
  }
  if (found && domain.anisotropic_cell(at) && !domain.bent(at[D - 1]))
    tilted_ends_.push_back({number(at), place(row_b), mixed_stiffness(domain, at, outward)});
}

template <int D, class Real>
void FreeSurface<D, Real>::find_tensor(const Domain<D>& domain, const Index<D>& at,
                                       const RowVector<D, double>& normal, double factor, BentEnd& end) {
  end.anisotropic = true;
  const auto tensor = in_pairs<D>(christoffel<D>(elasticity_at(domain, at), normal_in_grid<D>(normal)));
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) end.tensor[i][k] = Real(factor * tensor[i][k]);
}

/// Returns the stiffnesses that mix two pairs: in 2-D both, in 3-D the first two, the first and the last, and
/// the last two.
template <int D, class Real>
auto FreeSurface<D, Real>::mixed_stiffness(const Domain<D>& domain, const Index<D>& at, double factor) const
    -> Mixed {
  const auto& medium = *domain.anisotropic_medium(at);
  Mixed all;
  std::size_t n = 0;
  for (int one = 0; one < D; ++one)
    for (int other = one + 1; other < D; ++other) {
      const auto motion = [&](int pair) { return pair == 0 ? axis_ : axis_of_pair<D>(axis_, pair); };
      all[n++] = Real(medium.elasticity(motion(one), axis_, motion(other), axis_) * medium.rho * factor);
    }
  return all;
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::number(const Index<D>& at) const {
  if (inside_) return std::lower_bound(keys_.begin(), keys_.end(), key_of(at)) - keys_.begin();
  std::int64_t number = 0;
  for (int other = D - 1; other >= 0; --other)
    if (other != axis_)
      number = number * (other == 0 ? padded_nx_ : shape_[std::size_t(other)]) + at[std::size_t(other)];
  return number;
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::key_of(const Index<D>& at) const {
  std::int64_t key = 0;
  for (int axis = D - 1; axis >= 0; --axis)
    key = key * (axis == 0 ? padded_nx_ : shape_[std::size_t(axis)]) + at[std::size_t(axis)];
  return key;
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::corrected(const Index<D>& at) const {
  if (empty()) return -1;
  const auto found = number(at);
  if (found == std::int64_t(keys_.size()) || keys_[std::size_t(found)] != key_of(at)) return -1;
  return corrected_[std::size_t(found)] ? found : -1;
}

template <int D, class Real>
IndexRange FreeSurface<D, Real>::numbers(const IndexRange& lines, const IndexRange& columns) const {
  if (!inside_ && axis_ == 0) return lines;
  const auto at = [&](std::int64_t line, std::int64_t x) {
    const auto column = std::clamp<std::int64_t>(x, 0, padded_nx_);
    // In 3-D an edge has a line of each row along y or along z.
    if (!inside_ && D == 3) line = axis_ == 1 ? line / shape_[1] : line % shape_[1];
    if (!inside_) return (D == 2 ? 0 : line) * padded_nx_ + column;
    return std::lower_bound(keys_.begin(), keys_.end(), line * padded_nx_ + column) - keys_.begin();
  };
  return {at(lines.first, columns.first), at(lines.last - 1, columns.last)};
}

template <int D, class Real>
std::int64_t FreeSurface<D, Real>::place_of(const Layout<D>& layout, const Index<D>& at, int behind,
                                            int row) const {
  if (axis_ < D - 1) return (number(at) * retained_cells_ + behind) * retained_rows_ + row;
  return layout.cell(at) + behind * outward_ * layout.stride(axis_) + row * layout.row_pitch();
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
    for (auto number = here.first; number < here.last; ++number)
      copy(number, places_[std::size_t(number)], 1);
    return;
  }
  auto at = state.layout.line_index(line);
  const auto edge = side_ ? shape_[std::size_t(axis_)] - 1 : 0;
  if (axis_ == 0 ? edge < columns.first || edge >= columns.last : at[std::size_t(axis_)] != edge) return;
  at[std::size_t(axis_)] = edge;
  copy(number(at), state.layout.cell(at), axis_ > 0 ? shape_[0] : 1);
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
  correct_tilted_ends(state, first, last);
  correct_bent_ends(state, first, last);
  tractions_.update(fields, material, first, last);
}

/// Tractions that the bend of one velocity puts on the other component (theory.md (V7)).
template <int D, class Real>
void FreeSurface<D, Real>::correct_tilted_ends(const State<D, Real>& state, std::int64_t first,
                                               std::int64_t last) {
  auto end = std::lower_bound(tilted_ends_.begin(), tilted_ends_.end(), first,
                              [](const TiltedEnd& one, std::int64_t number) { return one.number < number; });
  for (; end != tilted_ends_.end() && end->number < last; ++end) {
    const auto n = std::size_t(end->number);
    std::size_t k = 0;
    for (std::size_t one = 0; one < D; ++one)
      for (std::size_t other = one + 1; other < D; ++other) {
        const Real mixed = end->mixed[k++] * state.material.data()[end->b];
        traction_corrections_[one][n] += mixed * velocity_corrections_[other][n];
        traction_corrections_[other][n] += mixed * velocity_corrections_[one][n];
      }
  }
}

/// The traction that bends velocities as the corrections do, as stresses of the first ghost cells: with that
/// of the last component along the rows as it is, T = s N.
template <int D, class Real>
void FreeSurface<D, Real>::correct_bent_ends(const State<D, Real>& state, std::int64_t first,
                                             std::int64_t last) {
  auto end = std::lower_bound(bent_ends_.begin(), bent_ends_.end(), first,
                              [](const BentEnd& one, std::int64_t number) { return one.number < number; });
  const Real* const material = state.material.data();
  for (; end != bent_ends_.end() && end->number < last; ++end) {
    const auto n = std::size_t(end->number);
    RowVector<D, Real> bend;
    bend.z = velocity_corrections_[0][n], bend.x = velocity_corrections_[1][n];
    if constexpr (D == 3) bend.y = velocity_corrections_[2][n];
    const Real b = material[end->b], zp = material[end->zp], zs = material[end->zs];
    auto t = end->factor * scaled(end->normal, zp * zp * b, zs * zs * b, bend);
    if (end->anisotropic) {
      t = b * row_vector<D>(product_of(end->tensor, components<D>(bend)));
    }
    traction_corrections_[0][n] = t.z - end->normal.x * t.x;
    traction_corrections_[1][n] = t.x;
    if constexpr (D == 3) {
      traction_corrections_[0][n] -= end->normal.y * t.y;
      traction_corrections_[2][n] = t.y;
    }
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, surface_slope);
SLIPWAVE_INSTANTIATE_D(FUNCTION, add_term);
SLIPWAVE_INSTANTIATE_D(FUNCTION, end_of_rows);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class FreeSurface);

}  // namespace slipwave::solver
