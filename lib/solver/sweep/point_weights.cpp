// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/point_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/instantiate.hpp"
#include "base/small_matrix.hpp"
#include "grid/locate.hpp"
#include "scene/splitting.hpp"
#include "solver/sweep/extension_errors.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/surface_errors.hpp"

namespace slipwave::solver {
namespace {

/// How a field row continues beyond an edge across `axis`. Stresses that are no traction on the edge follow
/// it only in fluid, where all of them are the pressure.
template <int D>
Beyond beyond_edge(EdgeLaw law, int axis, int row, bool fluid) {
  using Rows = FieldRows<D>;
  if (law == EdgeLaw::absorbing) return Beyond::unknown;
  // Along an edge the velocity of fluid follows the gradient of pressure, and so has its parity.
  if (fluid && row != Rows::velocity(axis)) row = Rows::normal_stress(axis);
  // Components without an index across a plane of symmetry are even about it.
  if (row >= D && !Rows::is_traction(axis, row) && law != EdgeLaw::mirror) return Beyond::unknown;
  return image_sign<D>(law, axis, row) < 0 ? Beyond::odd : Beyond::even;
}

/// Visits the cells of a box whose place along an axis is `layer`, until one is not `fit`.
template <int D, class Fit>
bool all_of_layer(const std::array<AxisCells, std::size_t(D)>& box, std::size_t axis, std::int64_t layer,
                  Fit&& fit) {
  Index<D> at;
  for (std::size_t other = 0; other < D; ++other) at[other] = box[other].low;
  at[axis] = layer;
  for (;;) {
    if (!fit(at)) return false;
    std::size_t other = 0;
    for (; other < D; ++other) {
      if (other == axis) continue;
      if (++at[other] <= box[other].high) break;
      at[other] = box[other].low;
    }
    if (other == D) return true;
  }
}

/// A box of cells, and where it ends at free surfaces, which all its cells at that end have.
template <int D>
struct Box {
  std::array<AxisCells, std::size_t(D)> cells;
  std::array<std::array<bool, 2>, std::size_t(D)> ends_free{};
};

/// The largest box round a cell of cells that are `alike(cell, the next one towards the centre)`, grown one
/// layer at a time on each side, by `rings` at most and, where `longest` is given, until it is that long.
/// Sides that a single fracture parts may move otherwise.
template <int D, class Alike>
Box<D> box_round(const Domain<D>& domain, const Index<D>& centre, int rings, std::int64_t longest,
                 Alike&& alike) {
  Box<D> box;
  for (std::size_t axis = 0; axis < D; ++axis) box.cells[axis].low = box.cells[axis].high = centre[axis];
  const auto find_surfaces = [&](std::size_t axis) {
    for (const int side : {0, 1}) {
      const auto& cells = box.cells[axis];
      box.ends_free[axis][std::size_t(side)] = all_of_layer<D>(
          box.cells, axis, side ? cells.high : cells.low,
          [&](const Index<D>& at) { return ends_at_free_surface(domain, at, int(axis), side); });
    }
  };
  const auto layer_fits = [&](std::size_t axis, std::int64_t layer) {
    if (layer < 0 || layer >= domain.grid.shape[axis]) return false;
    if (axis == D - 1 && !domain.in_band(layer)) return false;
    return all_of_layer<D>(box.cells, axis, layer, [&](const Index<D>& at) {
      Index<D> inside = at;
      inside[axis] += layer < centre[axis] ? 1 : -1;
      if (!alike(at, inside) || domain.is_split(layer < centre[axis] ? inside : at, int(axis))) return false;
      // Cells beside a surface end there with the others.
      for (std::size_t other = 0; other < D; ++other)
        for (const int side : {0, 1})
          if (other != axis && box.ends_free[other][std::size_t(side)] &&
              at[other] == (side ? box.cells[other].high : box.cells[other].low) &&
              !ends_at_free_surface(domain, at, int(other), side))
            return false;
      return true;
    });
  };
  for (std::size_t axis = 0; axis < D; ++axis) find_surfaces(axis);
  for (int ring = 0; ring < rings; ++ring)
    for (std::size_t axis = 0; axis < D; ++axis) {
      auto& cells = box.cells[axis];
      if (cells.high - cells.low + 1 >= longest) continue;
      const auto before = cells;
      if (cells.low == centre[axis] - ring && layer_fits(axis, cells.low - 1)) --cells.low;
      if (cells.high == centre[axis] + ring && layer_fits(axis, cells.high + 1)) ++cells.high;
      if (cells.low != before.low || cells.high != before.high) find_surfaces(axis);
    }
  return box;
}

/// Cells of one kind (solid or fluid) round a cell, within reach of a stencil.
template <int D>
Box<D> usable_cells(const Domain<D>& domain, const Index<D>& centre, Reach reach) {
  const auto kind = [&](const Index<D>& at) {
    return (domain.impedance(wave_p)(at) > 0) + (domain.impedance(wave_s)(at) > 0);
  };
  const int wanted = kind(centre);
  return box_round(domain, centre, widest_stencil, std::numeric_limits<std::int64_t>::max(),
                   [&](const Index<D>& at, const Index<D>& inside) {
                     return kind(at) == wanted &&
                            (reach == Reach::over_one_kind || alike(domain, at, inside));
                   });
}

/// Cells of the rock round a cell over which a source can be spread smoothly; nothing where there are too
/// few. Beyond a plane of symmetry lies the image of the source.
template <int D>
std::optional<std::array<AxisCells, D>> cells_of_the_rock(const Domain<D>& domain, const Index<D>& centre,
                                                          int field_row, int widest) {
  const auto alike = [&](const Index<D>& at, const Index<D>&) {
    for (const Wave wave : {wave_p, wave_s})
      for (const int axis : {D - 1, 0}) {
        const auto& impedance = domain.impedance(wave, axis);
        if (!are_one_rock(impedance(centre), impedance(at))) return false;
      }
    return true;
  };
  auto box = box_round(domain, centre, widest, widest + 1, alike).cells;
  for (std::size_t axis = 0; axis < D; ++axis) {
    auto& cells = box[axis];
    if (cells.low == 0 && domain.edges[int(axis)][0] == EdgeLaw::mirror)
      cells.below = beyond_edge<D>(EdgeLaw::mirror, int(axis), field_row, false);
    if (cells.high == domain.grid.shape[axis] - 1 && domain.edges[int(axis)][1] == EdgeLaw::mirror)
      cells.above = beyond_edge<D>(EdgeLaw::mirror, int(axis), field_row, false);
    const int images = (cells.below != Beyond::unknown) + (cells.above != Beyond::unknown);
    if (images < 2 && (cells.high - cells.low + 1) * (1 + images) < narrowest_spread) return {};
  }
  return box;
}

/// From here on stencils across an edge, in cells from the last centre, need nothing from beyond it.
constexpr int half_a_stencil = widest_stencil / 2;
constexpr double centred_from = half_a_stencil - 1;

/// Whether an edge across z makes even or odd what is along and across it, but not what is along x and z: on
/// curvilinear rows the stresses of a solid and the velocity of a fluid.
template <int D>
bool askew(const Domain<D>& domain, const Index<D>& centre, EdgeLaw law, int row, bool fluid) {
  if (!domain.curvilinear(centre[D - 1])) return false;
  return law == EdgeLaw::mirror || (law == EdgeLaw::free && (row < D) == fluid);
}

template <int D>
std::vector<ValueWeight> value_weights(const Layout<D>& layout, const std::vector<PointWeight<D>>& points,
                                       int field_row) {
  std::vector<ValueWeight> weights;
  if (!FieldRows<D>::is_stored(layout, field_row)) return weights;
  const auto row = FieldRows<D>::stored(layout, field_row);
  for (const auto& point : points) weights.push_back(value_weight(layout, point.cell, row, point.weight));
  return weights;
}

template <int D>
std::vector<ValueWeight> weights_within(const Layout<D>& layout, const Domain<D>& domain,
                                        const Point<D>& point_m,
                                        const std::array<AxisCells, std::size_t(D)>& usable, int field_row) {
  return value_weights(layout, point_weights<D>(domain.grid, point_m, usable), field_row);
}

/// A sum over cells from a face on, `last` the first of them.
double weighted(const std::vector<CellWeight>& weights, const std::vector<double>& values,
                std::int64_t last) {
  double sum = 0;
  for (const auto& [cell, weight] : weights)
    if (const auto n = std::size_t(std::abs(cell - last)); n < values.size()) sum += weight * values[n];
  return sum;
}

/// What a sum of velocities over cells `across`, on a side of an interface of rocks that steps make a kink
/// at, lies off (A24), as terms of fields of the cells on both sides of its face.
template <int D>
class InterfaceErrors {
 public:
  InterfaceErrors(const Domain<D>& domain, const Index<D>& behind, int axis, int velocity,
                  const std::vector<CellWeight>& across, int side, bool of_force)
      : domain_(domain), axis_(axis), velocity_(velocity), behind_(behind[std::size_t(axis)]) {
    const int pair = pair_of<D>(axis, velocity);
    const auto& impedance = domain.impedance_of_pair(axis, pair);
    SweepsAcross sweeps{domain.order, {}, {}, axis, axis == 0 ? 1 : 0, splitting(D, domain.steps.time_order)};
    auto &z = sweeps.impedance, &courant = sweeps.courant;
    sweeps.adjoint = of_force, sweeps.merges = !of_force;
    for (const auto n : {0U, 1U}) {
      const auto cell = beside(behind, n);
      z[n] = impedance(cell);
      courant[n] = domain.courant(cell, axis, pair);
    }
    // What slopes of 1 across, by side, and those of v that extensions are given (E11a) make of the sum and
    // of the differences of v and s over the face.
    const auto own = std::size_t(side);
    const auto told = [&](const SlopesBeside& slopes, const std::array<double, 2>& given) {
      const auto off = extension_errors(sweeps, slopes, given);
      return std::array{weighted(across, off.v[own], beside(behind, own)[std::size_t(axis)]),
                        (slopes.v[0] + slopes.v[1]) / 2 + off.v[1][0] - off.v[0][0],
                        (slopes.s[0] + slopes.s[1]) / 2 + off.s[1][0] - off.s[0][0]};
    };
    const bool corrected = !of_force && corrects_interface(domain, behind, axis);
    const bool welded = z[0] > 0 && z[1] > 0;
    std::array<std::array<double, 3>, 2> of_v{}, of_s{}, of_given{};
    std::array<double, 3> of_traction{}, of_motion{};
    for (const auto n : {0U, 1U}) {
      if (z[n] == 0) continue;
      const auto slope = unit_vector<2>(n);
      of_v[n] = told({slope, {}}, {});
      if (welded) of_s[n] = told({{}, slope}, {});
      if (corrected) of_given[n] = told({}, slope);
      for (std::size_t k = 0; k < 3; ++k) {
        of_traction[k] += of_v[n][k] / (courant[n] * z[n]);
        of_motion[k] += of_s[n][k] * z[n] / courant[n];
      }
    }
    // The differences tell by how much traction and motion of the face change in a step. Where fluid slides
    // along, the traction is none.
    if (welded)
      of_jump_ = solved(SmallMatrix<2>{{{of_traction[1], of_traction[2]}, {of_motion[1], of_motion[2]}}},
                        {-of_traction[0], -of_motion[0]});
    const std::array<double, 3> all{1, of_jump_[0], of_jump_[1]};
    for (const auto n : {0U, 1U}) {
      load_[n] = dot_product(all, of_v[n]) + dot_product(all, of_given[n]);
      thrust_[n] = dot_product(all, of_s[n]);
    }
  }

  /// Returns those where a cell lies along the interface, with the sign changed: none where rocks beside
  /// its cells differ.
  std::vector<SurfaceTerm<D>> terms(const Index<D>& at) const {
    std::vector<SurfaceTerm<D>> all;
    for (const auto n : {0U, 1U}) {
      const auto cell = beside(at, n);
      if (of_jump_[0] != 0)
        all.push_back({cell, FieldRows<D>::velocity(velocity_), sign_of(n) * of_jump_[0]});
      if (of_jump_[1] != 0)
        all.push_back({cell, FieldRows<D>::stress(axis_, velocity_), sign_of(n) * of_jump_[1]});
      if (!add_along(cell, load_[n], thrust_[n], all)) return {};
    }
    return all;
  }

 private:
  static double sign_of(std::size_t side) { return side == 0 ? -1 : 1; }
  Index<D> beside(Index<D> at, std::size_t side) const {
    at[std::size_t(axis_)] = behind_ - (side == 0 ? 1 : 0);
    return at;
  }
  /// What sweeps along the interface add in a cell to the traction on it, times `load`, and to the motion.
  bool add_along(const Index<D>& cell, double load, double thrust, std::vector<SurfaceTerm<D>>& all) const {
    const double high = axis_ == D - 1 ? domain_.height(cell[D - 1]) : 1;
    const auto c = elasticity_at(domain_, cell);
    const auto unit = [](int of) { return unit_vector<std::size_t(D)>(std::size_t(of)); };
    const double stiffness = christoffel<D>(c, unit(axis_))[std::size_t(axis_)][std::size_t(axis_)];
    for (int along = 0; along < D; ++along) {
      if (along == axis_ || thin(domain_, along)) continue;
      const double wide = along == D - 1 ? domain_.height(cell[D - 1]) : 1;
      const bool loads = velocity_ == axis_ || velocity_ == along;
      const auto by_strain = tractions<D>(c, unit(axis_), unit(along));
      const double of_strain =
          velocity_ == axis_ ? by_strain[std::size_t(axis_)][std::size_t(along)] / stiffness : 1;
      const int motion = velocity_ == axis_ ? along : axis_;
      for (std::size_t k = 0; k < offsets_along.size(); ++k) {
        Index<D> offset{};
        offset[std::size_t(along)] = offsets_along[k];
        const double difference = weights_along[k] * high / wide;
        const auto add = [&](int row, double weight) {
          const auto term = surface_term(domain_, cell, offset, row, weight);
          if (term) all.push_back(*term);
          return term.has_value();
        };
        if (loads && load != 0 && !add(FieldRows<D>::velocity(motion), load * of_strain * difference))
          return false;
        if (thrust != 0 && !add(FieldRows<D>::stress(along, velocity_), thrust * difference)) return false;
      }
    }
    return true;
  }

  const Domain<D>& domain_;
  int axis_, velocity_;
  std::int64_t behind_;
  std::array<double, 2> of_jump_{}, load_{}, thrust_{};  // of v and s across the face; by side of it
};

/// Whether the step makes a kink of a velocity at the face before a cell: a strong interface in level rows of
/// rocks whose axes are those of the grid, or of one and fluid, along all that steps and weights need of it.
template <int D>
bool kinks(const Domain<D>& domain, const Index<D>& behind, int axis, int velocity) {
  constexpr std::int64_t along_needed = widest_stencil;
  Index<D> before = behind;
  --before[axis];
  const int pair = pair_of<D>(axis, velocity);
  const auto& impedance = domain.impedance_of_pair(axis, pair);
  const auto& p_waves = domain.impedance(wave_p);
  if (domain.anisotropic_cell(before) || domain.anisotropic_cell(behind)) return false;
  if (!domain.steps.medium || p_waves(before) == 0 || p_waves(behind) == 0) return false;
  if (domain.curvilinear(behind[D - 1]) || domain.curvilinear(before[D - 1]) ||
      !strong_interface_between(impedance(before), impedance(behind)))
    return false;
  if (!domain.in_band(before[D - 1]) || !domain.in_band(behind[D - 1])) return false;
  if (domain.is_split(behind, axis)) return false;
  for (int along = 0; along < D; ++along)
    for (std::int64_t n = -along_needed; along != axis && n <= along_needed; ++n) {
      Index<D> one = before, other = behind;
      one[along] += n, other[along] += n;
      if (one[along] < 0 || one[along] >= domain.grid.shape[along]) continue;
      if (!alike(domain, before, one) || !alike(domain, behind, other)) return false;
    }
  return true;
}

/// The value of a velocity at a point, or a force on it, from the cells that are usable.
template <int D>
struct VelocityAtPoint {
  const Layout<D>& layout;
  const Domain<D>& domain;
  Index<D> centre;
  Point<D> point_m;
  std::array<AxisCells, std::size_t(D)> usable;
  int row;
  bool of_force;
};

/// Takes away what the velocity lies off at the interface of rocks that the cells end at on a side.
template <int D>
void add_interface_correction(const VelocityAtPoint<D>& value, int axis, int side,
                              std::vector<ValueWeight>& weights) {
  const auto& [layout, domain, centre, point_m, usable, row, of_force] = value;
  const auto& across = usable[std::size_t(axis)];
  Index<D> last = centre, behind = centre;
  last[axis] = side ? across.high : across.low;
  behind[axis] = last[axis] + (side ? 1 : 0);
  if (behind[axis] < 1 || behind[axis] >= domain.grid.shape[axis] || !kinks(domain, behind, axis, row))
    return;
  const InterfaceErrors<D> errors(domain, behind, axis, row,
                                  axis_weights(domain.grid.position(axis, point_m[axis]), across), 1 - side,
                                  of_force);
  // The interface's own cells, at the point's place along it.
  Point<D> on_edge = point_m;
  on_edge[axis] = domain.grid.centre(axis, last[axis]);
  auto cells = usable;
  cells[std::size_t(axis)] = {last[axis], last[axis]};
  std::vector<ValueWeight> all;
  for (const auto& at : point_weights<D>(domain.grid, on_edge, cells)) {
    const auto terms = errors.terms(at.cell);
    if (terms.empty()) return;
    for (const auto& term : terms)
      all.push_back(value_weight(layout, term.cell, term.row, at.weight * term.weight));
  }
  weights.insert(weights.end(), all.begin(), all.end());
}

/// The correction of velocity of the images beyond a free surface of a solid, and what steps leave below it
/// in records, or in the answer to forces (A23), as weights.
template <int D>
void add_surface_correction(const VelocityAtPoint<D>& value, int axis, int side,
                            std::vector<ValueWeight>& weights) {
  const auto& [layout, domain, centre, point_m, cells, row, of_force] = value;
  auto usable = cells;
  auto& across = usable[std::size_t(axis)];
  const std::int64_t last = side ? across.high : across.low;
  const double position = domain.grid.position(axis, point_m[axis]);
  auto evenly = axis_weights(position, across);
  (side ? across.above : across.below) = Beyond::odd;
  const auto oddly = axis_weights(position, across);
  double images = 0;
  for (std::size_t n = 0; n < evenly.size(); ++n)
    images += 0.5 * (evenly[n].weight - oddly[n].weight) * double(2 * std::abs(evenly[n].cell - last) + 1);
  Index<D> edge = centre;
  edge[axis] = last;
  Point<D> shares;
  shares.fill(images);
  for (int along = 0; along < D; ++along) {
    if (along == axis) continue;
    const double off =
        weighted(evenly, errors_below_surface(domain, edge, axis, along, row, of_force).v[1], last);
    if (std::abs(off) > least_error) shares[std::size_t(along)] += off;
  }
  if (shares == Point<D>{}) return;
  // The surface's own cells, at the point's place along it.
  Point<D> on_edge = point_m;
  on_edge[axis] = domain.grid.centre(axis, last);
  for (const auto& at : point_weights<D>(domain.grid, on_edge, usable)) {
    const auto slopes = surface_slopes(domain, at.cell, axis, side, shares);
    for (const auto& term : slopes[std::size_t(row)])
      weights.push_back(value_weight(layout, term.cell, term.row, at.weight * term.weight));
  }
}

}  // namespace

std::vector<std::int64_t> lines_of(const std::vector<ValueWeight>& values) {
  std::vector<std::int64_t> lines;
  for (const auto& value : values) lines.push_back(value.line);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

template <int D>
ExtendedCells<D> extended_cells(const Domain<D>& domain, const Index<D>& centre, int field_row, bool fluid,
                                Reach reach) {
  const auto box = usable_cells(domain, centre, reach);
  ExtendedCells<D> usable{box.cells, box.ends_free};
  for (std::size_t axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      auto& cells = usable.cells[axis];
      const bool at_edge = side ? cells.high == domain.grid.shape[axis] - 1 : cells.low == 0;
      if (!at_edge && !box.ends_free[axis][std::size_t(side)]) continue;
      const EdgeLaw law = at_edge ? domain.edges[int(axis)][side] : EdgeLaw::free;
      if (axis == D - 1 && askew(domain, centre, law, field_row, fluid)) continue;
      (side ? cells.above : cells.below) = beyond_edge<D>(law, int(axis), field_row, fluid);
    }
  return usable;
}

/// Whether a cell is of a side.
template <int D>
static bool is_of(const Domain<D>& domain, const Index<D>& cell, Side side) {
  return domain.impedance(wave_p)(cell) > 0 && (domain.impedance(wave_s)(cell) > 0) == (side == Side::solid);
}

template <int D>
bool owns_point(const Domain<D>& domain, const Point<D>& point_m, Side side) {
  if (!domain.subdomain.in_bands()) return domain.subdomain.owns(domain.model_grid, point_m);
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  const double row = domain.grid.position(D - 1, place[D - 1]) + 0.5;
  for (const int of : {0, 1}) {
    const auto face = of ? domain.own.last : domain.own.first;
    if (!domain.subdomain.ends_at_band(of) || std::abs(row - double(face)) > on_face) continue;
    Index<D> behind = domain.computed_cell(cell_of(domain.model_grid, point_m));
    behind[D - 1] = face;
    Index<D> before = behind;
    --before[D - 1];
    const bool in_front = is_of(domain, before, side) && !is_of(domain, behind, side);
    return in_front == (of == 1);
  }
  return domain.owns(std::int64_t(std::floor(row))) || (row < 0 && !domain.subdomain.cut(0)) ||
         (row >= double(domain.grid.shape[D - 1]) && !domain.subdomain.cut(1));
}

template <int D>
Index<D> cell_at(const Domain<D>& domain, const Point<D>& point_m, Side side) {
  Index<D> at = domain.computed_cell(cell_of(domain.model_grid, point_m));
  at[D - 1] = std::clamp(at[D - 1], domain.band.first, domain.band.last - 1);
  const auto& p_waves = domain.impedance(wave_p);
  const auto counts = [&](const Index<D>& cell) { return is_of(domain, cell, side); };
  if (counts(at)) return at;
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  for (int axis = 0; axis < D; ++axis)
    for (const int beyond : {-1, 1}) {
      Index<D> beside = at;
      auto& cell = beside[std::size_t(axis)];
      const double face = double(cell) + 0.5 * beyond;
      cell += beyond;
      if (std::abs(domain.grid.position(axis, place[axis]) - face) > on_face || cell < 0 ||
          cell >= domain.grid.shape[std::size_t(axis)] || !domain.in_band(beside[D - 1]))
        continue;
      if (counts(beside) || (p_waves(at) == 0 && p_waves(beside) > 0)) return beside;
    }
  return at;
}

/// The cells that a point reads or adds to: up to strong interfaces, unless too few are there, and only the
/// last ones where it is beyond their centres.
template <int D>
static ExtendedCells<D> cells_of_point(const Domain<D>& domain, const Index<D>& centre, const Point<D>& place,
                                       int field_row, bool fluid) {
  const auto near = extended_cells(domain, centre, field_row, fluid, Reach::to_strong_interfaces);
  // A model that is thinner has no more.
  bool enough = true;
  for (std::size_t axis = 0; axis < D; ++axis)
    enough &= near.cells[axis].high - near.cells[axis].low + 1 >=
              std::min<std::int64_t>(widest_beyond, domain.grid.shape[axis]);
  auto usable = enough ? near : extended_cells(domain, centre, field_row, fluid);
  for (std::size_t axis = 0; axis < D; ++axis) {
    auto& cells = usable.cells[axis];
    const double position = domain.grid.position(int(axis), place[axis]);
    if (position < double(cells.low) && cells.below == Beyond::unknown)
      cells = {cells.low, std::min(cells.high, cells.low + widest_beyond - 1)};
    else if (position > double(cells.high) && cells.above == Beyond::unknown)
      cells = {std::max(cells.low, cells.high - widest_beyond + 1), cells.high};
  }
  return usable;
}

/// Weights to read with, or those of a force.
template <int D>
static std::vector<ValueWeight> weights_of_value(const Layout<D>& layout, const Domain<D>& domain,
                                                 const Point<D>& point_m, int field_row, Side side,
                                                 bool of_force) {
  const Index<D> centre = cell_at(domain, point_m, side);
  const bool fluid = domain.impedance(wave_s)(centre) == 0;
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  const auto usable = cells_of_point(domain, centre, place, field_row, fluid);
  std::vector<ValueWeight> weights = weights_within(layout, domain, place, usable.cells, field_row);
  const VelocityAtPoint<D> value{layout, domain, centre, place, usable.cells, field_row, of_force};
  for (int axis = 0; !fluid && field_row < D && axis < D; ++axis)
    for (const int of : {0, 1}) {
      if (usable.ends_free[std::size_t(axis)][std::size_t(of)])
        add_surface_correction(value, axis, of, weights);
      else
        add_interface_correction(value, axis, of, weights);
    }
  return weights;
}

template <int D>
std::vector<ValueWeight> row_weights(const Layout<D>& layout, const Domain<D>& domain,
                                     const Point<D>& point_m, int field_row, Side side) {
  return weights_of_value(layout, domain, point_m, field_row, side, false);
}

template <int D>
std::vector<ValueWeight> source_weights(const Layout<D>& layout, const Domain<D>& domain,
                                        const Point<D>& point_m, int field_row, Side side) {
  const Index<D> centre = cell_at(domain, point_m, side);
  if (field_row < D || domain.impedance(wave_s)(centre) == 0)
    return weights_of_value(layout, domain, point_m, field_row, side, true);
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  auto usable = cells_of_point(domain, centre, place, field_row, false);
  for (int axis = 0; axis < D; ++axis) {
    auto& cells = usable.cells[std::size_t(axis)];
    const auto& ends_free = usable.ends_free[std::size_t(axis)];
    const double position = domain.grid.position(axis, place[axis]);
    const bool low = ends_free[0] && position - double(cells.low) < centred_from,
               high = ends_free[1] && double(cells.high) - position < centred_from;
    if (!low && !high) continue;
    // Those towards the surface lie off most (A23).
    const std::int64_t count = std::min<std::int64_t>(widest_beyond, cells.high - cells.low + 1);
    const auto first =
        low ? std::int64_t(std::floor(position)) : std::int64_t(std::ceil(position)) + 1 - count;
    cells.low = std::clamp(first, cells.low, cells.high + 1 - count);
    cells.high = cells.low + count - 1;
    cells.below = cells.above = Beyond::unknown;
  }
  return weights_within(layout, domain, place, usable.cells, field_row);
}

template <int D>
std::vector<ValueWeight> smooth_source_weights(const Layout<D>& layout, const Domain<D>& domain,
                                               const Point<D>& point_m, int field_row, Side side,
                                               Moment moment) {
  const Index<D> centre = cell_at(domain, point_m, side);
  if (domain.impedance(wave_s)(centre) == 0) return {};
  const auto usable = cells_of_the_rock(domain, centre, field_row, widest_spread(moment));
  if (!usable) return {};
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  return value_weights(layout, spread_point_weights<D>(domain.grid, place, *usable, moment), field_row);
}

template <int D>
int row_of(const WaveField& field) {
  const auto axis = [](int of_3d) { return std::min(of_3d, D - 1); };  // 2-D: x and z
  const int one = axis(field.axis), other = axis(field.other_axis);
  if (field.quantity == WaveField::Quantity::velocity) return FieldRows<D>::velocity(one);
  return FieldRows<D>::stress(one, other);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, cell_at);
SLIPWAVE_INSTANTIATE_D(FUNCTION, row_weights);
SLIPWAVE_INSTANTIATE_D(FUNCTION, source_weights);
SLIPWAVE_INSTANTIATE_D(FUNCTION, extended_cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, smooth_source_weights);
SLIPWAVE_INSTANTIATE_D(FUNCTION, owns_point);
SLIPWAVE_INSTANTIATE_D(FUNCTION, row_of);

}  // namespace slipwave::solver
