// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/velocity_gradient.hpp"

#include <cmath>
#include <vector>

#include "acquisition/interpolation.hpp"
#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave::solver {
namespace {

/// Depth of the centre of a cell of the computed grid of a fitted model, in cells.
template <int D>
double centre_depth(const Domain<D>& domain, const Index<D>& cell) {
  constexpr int corners = 1 << D;
  double sum = 0;
  for (int n = 0; n < corners; ++n) {
    Index<D> corner = cell;
    for (int axis = 0; axis < D; ++axis) corner[std::size_t(axis)] += (n >> axis) & 1;
    sum += corner_depth(domain, corner);
  }
  return sum / corners;
}

/// What a free surface of normal n (of any length) makes of a change of the velocity v_k along a coordinate
/// of gradient g on it: the change it forces along the coordinate whose gradient is n. With w the latter,
///   lambda tr(G) n + mu (G + G^T) n = 0,  G = w n^T + e_k g^T + .. (the other changes),
/// a linear system for w. Lame parameters over density.
template <int D>
Point<D> forced_change(const Point<D>& n, const Point<D>& g, std::size_t k, double lambda, double mu) {
  Point<D> load;
  for (std::size_t i = 0; i < D; ++i)
    load[i] = lambda * g[k] * n[i] + mu * ((i == k ? dot_product(g, n) : 0) + g[i] * n[k]);
  const double square = dot_product(n, n),
               along = dot_product(load, n) * (lambda + mu) / (lambda + 2 * mu) / square;
  Point<D> change;
  for (std::size_t i = 0; i < D; ++i) change[i] = -(load[i] - along * n[i]) / (mu * square);
  return change;
}

/// Overload for anisotropic rock: T(n, n) w = -T(n, g) e_k, T(n, g)_ik the sum of C_ijkl n_j g_l.
template <int D>
Point<D> forced_change(const Point<D>& n, const Point<D>& g, std::size_t k, const Elasticity<D>& c) {
  auto load = product_of(tractions<D>(c, n, g), unit_vector<std::size_t(D)>(k));
  for (double& part : load) part = -part;
  return solved(christoffel<D>(c, n), load);
}

template <int D, class Add>
void for_products(const std::array<std::vector<CellWeight>, std::size_t(D)>& along, const Add& add) {
  std::array<std::size_t, std::size_t(D)> n{};
  for (const auto& weights : along)
    if (weights.empty()) return;
  for (;;) {
    Index<D> cell;
    double weight = 1;
    for (std::size_t axis = 0; axis < D; ++axis) {
      cell[axis] = along[axis][n[axis]].cell;
      weight *= along[axis][n[axis]].weight;
    }
    add(cell, weight);
    std::size_t axis = 0;
    while (axis < D && ++n[axis] == along[axis].size()) n[axis++] = 0;
    if (axis == D) return;
  }
}

template <int D>
std::array<std::vector<CellWeight>, std::size_t(D)> gradient_weights_along(
    const std::array<AxisCells, std::size_t(D)>& usable, const std::array<double, std::size_t(D)>& at,
    int derivative) {
  std::array<std::vector<CellWeight>, std::size_t(D)> weights;
  for (std::size_t axis = 0; axis < D; ++axis)
    weights[axis] =
        int(axis) == derivative ? axis_slopes(at[axis], usable[axis]) : axis_weights(at[axis], usable[axis]);
  return weights;
}

}  // namespace

template <int D>
VelocityGradient<D>::Sum::Sum(const Cells& cells) : cells_(cells) {
  std::int64_t count = D;
  for (const auto& of_axis : cells) count *= of_axis.high - of_axis.low + 1;
  weights_.assign(std::size_t(count), 0);
}

template <int D>
std::vector<ValueWeight> VelocityGradient<D>::Sum::values(const Layout<D>& layout) const {
  std::vector<ValueWeight> values;
  Index<D> cell;
  for (std::size_t axis = 0; axis < D; ++axis) cell[axis] = cells_[axis].low;
  for (;;) {
    for (int row = 0; row < D; ++row)
      if (const double weight = weights_[place(cell, row)]; weight != 0)
        values.push_back({layout.line_number(cell), cell[0] + row * layout.row_pitch(), weight});
    std::size_t axis = 0;
    while (axis < D && ++cell[axis] > cells_[axis].high) {
      cell[axis] = cells_[axis].low;
      ++axis;
    }
    if (axis == D) return values;
  }
}

template <int D>
VelocityGradient<D>::VelocityGradient(const Domain<D>& domain, const Point<D>& point_m)
    : domain_(domain),
      centre_(cell_at(domain, point_m)),
      fluid_(domain.impedance(wave_s)(centre_) == 0),
      inner_(usable(0)) {
  const auto ends_free = extended_cells(domain_, centre_, 0, fluid_, Reach::to_strong_interfaces).ends_free;
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  for (int axis = 0; axis < D; ++axis) {
    auto& cells = inner_[std::size_t(axis)];
    at_[std::size_t(axis)] = domain.grid.position(axis, place[std::size_t(axis)]);
    cells.below = cells.above = Beyond::unknown;
    for (const int side : {0, 1})
      if (!fluid_ && ends_free[std::size_t(axis)][std::size_t(side)])
        free_faces_.push_back({axis, side, side ? cells.high : cells.low});
  }
}

template <int D>
auto VelocityGradient<D>::on_face(Place at, const Face& face) const -> Place {
  at[std::size_t(face.axis)] = double(face.last) + (face.side ? 0.5 : -0.5);
  return at;
}

template <int D>
double VelocityGradient<D>::distance(const Place& at, const Face& face) const {
  const auto axis = std::size_t(face.axis);
  return std::abs(at[axis] - on_face(at, face)[axis]);
}

template <int D>
double VelocityGradient<D>::lacking(const std::vector<CellWeight>& weights, const Face& face,
                                    double exact) const {
  Place at{};
  for (const auto& weight : weights) {
    at[std::size_t(face.axis)] = double(weight.cell);
    exact -= weight.weight * distance(at, face);
  }
  return std::abs(exact) < 1e-9 ? 0 : exact;
}

template <int D>
void VelocityGradient<D>::add_product(const Cells& usable, const Place& at, int row, int along, double factor,
                                      Sum& sum) const {
  for_products<D>(gradient_weights_along<D>(usable, at, along),
                  [&](const Index<D>& cell, double weight) { sum.add(cell, row, factor * weight); });
}

template <int D>
void VelocityGradient<D>::add_enforced_slope(const Place& at, int row, const Face& face, Values values,
                                             double factor, Sum& sum) const {
  Index<D> cell = centre_;
  cell[std::size_t(face.axis)] = face.last;
  const double zp = domain_.impedance(wave_p)(cell), zs = domain_.impedance(wave_s)(cell);
  const double mu = zs * zs, lambda = zp * zp - 2 * mu;
  const auto gradients = row_gradients(at);
  for (int along = 0; along < D; ++along)
    for (int moved = 0; along != face.axis && moved < D; ++moved) {
      const auto& normal = gradients[std::size_t(face.axis)];
      const auto& tangent = gradients[std::size_t(along)];
      double change = domain_.anisotropic() ? forced_change<D>(normal, tangent, std::size_t(moved),
                                                               elasticity_at(domain_, cell))[std::size_t(row)]
                                            : forced_change<D>(normal, tangent, std::size_t(moved), lambda,
                                                               mu)[std::size_t(row)];
      if (change == 0) continue;
      change *= face.side ? -factor : factor;
      if (values == Values::one_sided)
        add_product(inner_, at, moved, along, change, sum);
      else
        add_slope_along(at, moved, along, change, sum);
    }
}

template <int D>
void VelocityGradient<D>::add_slope_along(const Place& at, int row, int along, double factor,
                                          Sum& sum) const {
  const auto cells = usable(row);
  add_product(cells, at, row, along, factor, sum);
  for (const auto& face : free_faces_) {
    const auto across = std::size_t(face.axis);
    if (face.axis == along) continue;
    const double missing = lacking(axis_weights(at[across], cells[across]), face, distance(at, face));
    if (missing == 0) continue;
    auto place = on_face(at, face);
    for (const auto& weight : axis_slopes(at[std::size_t(along)], cells[std::size_t(along)])) {
      place[std::size_t(along)] = double(weight.cell);
      add_enforced_slope(place, row, face, Values::one_sided, factor * missing * weight.weight, sum);
    }
  }
}

template <int D>
void VelocityGradient<D>::add_slope(int row, int along, double factor, Sum& sum) const {
  add_slope_along(at_, row, along, factor, sum);
  const auto cells = usable(row)[std::size_t(along)];
  for (const auto& face : free_faces_) {
    if (face.axis != along) continue;
    const double missing = lacking(axis_slopes(at_[std::size_t(along)], cells), face, face.side ? -1 : 1);
    if (missing != 0)
      add_enforced_slope(on_face(at_, face), row, face, Values::with_images, factor * missing, sum);
  }
}

template <int D>
std::array<Point<D>, std::size_t(D)> VelocityGradient<D>::row_gradients(const Place& at) const {
  constexpr std::size_t z = D - 1;
  const double h = domain_.grid.spacing_m;
  std::array<Point<D>, std::size_t(D)> gradients{};
  for (std::size_t axis = 0; axis < D; ++axis) gradients[axis][axis] = 1 / h;
  if (!domain_.model_grid.rows) return gradients;
  // Depths are differentiated as velocities are, so that linear fields have exact derivatives.
  Point<D> depth{};
  for (std::size_t axis = 0; axis < D; ++axis)
    for_products<D>(
        gradient_weights_along<D>(inner_, at, int(axis)),
        [&](const Index<D>& cell, double weight) { depth[axis] += weight * centre_depth(domain_, cell); });
  if (!(depth[z] > 0)) depth[z] = 1;  // a single row
  gradients[z][z] = 1 / (h * depth[z]);
  for (std::size_t axis = 0; axis < z; ++axis) gradients[z][axis] = -depth[axis] / (h * depth[z]);
  return gradients;
}

template <int D>
std::vector<ValueWeight> VelocityGradient<D>::weights(const Layout<D>& layout, int axis, int along) const {
  const auto gradients = row_gradients(at_);
  Sum sum(inner_);
  for (int coordinate = 0; coordinate < D; ++coordinate)
    if (const double part = gradients[std::size_t(coordinate)][std::size_t(along)]; part != 0)
      add_slope(FieldRows<D>::velocity(axis), coordinate, part, sum);
  return sum.values(layout);
}

SLIPWAVE_INSTANTIATE_D(TYPE, class VelocityGradient);

}  // namespace slipwave::solver
