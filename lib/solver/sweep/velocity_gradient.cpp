#include "solver/sweep/velocity_gradient.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "acquisition/interpolation.hpp"

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

template <int D>
double dot(const Point<D>& one, const Point<D>& other) {
  double sum = 0;
  for (std::size_t axis = 0; axis < D; ++axis) sum += one[axis] * other[axis];
  return sum;
}

/// What a free surface of normal n (of any length) makes of a change of the velocity v_k along a coordinate
/// of gradient g on it: the change it forces along the coordinate whose gradient is n. With w the latter,
///   lambda tr(G) n + mu (G + G^T) n = 0,  G = w n^T + e_k g^T + .. (the other changes),
/// a linear system for w. Lame parameters over density.
template <int D>
Point<D> forced_change(const Point<D>& n, const Point<D>& g, std::size_t k, double lambda, double mu) {
  Point<D> load;
  for (std::size_t i = 0; i < D; ++i)
    load[i] = lambda * g[k] * n[i] + mu * ((i == k ? dot<D>(g, n) : 0) + g[i] * n[k]);
  const double square = dot<D>(n, n), along = dot<D>(load, n) * (lambda + mu) / (lambda + 2 * mu) / square;
  Point<D> change;
  for (std::size_t i = 0; i < D; ++i) change[i] = -(load[i] - along * n[i]) / (mu * square);
  return change;
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
std::array<std::vector<CellWeight>, std::size_t(D)> weights_along(
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
VelocityGradient<D>::VelocityGradient(const Domain<D>& domain, const Point<D>& point_m)
    : domain_(domain),
      centre_(cell_at(domain, point_m)),
      fluid_(domain.impedance(wave_s)(centre_) == 0),
      inner_(extended_cells(domain, centre_, 0, fluid_, Reach::to_strong_interfaces)) {
  const Point<D> place = domain.model_grid.row_coordinates(point_m);
  for (int axis = 0; axis < D; ++axis) at_[std::size_t(axis)] = domain.grid.position(axis, place[axis]);
  for (auto& cells : inner_) cells.below = cells.above = Beyond::unknown;
}

template <int D>
bool VelocityGradient<D>::is_free(int axis, int side) const {
  const auto& cells = inner_[std::size_t(axis)];
  return !fluid_ && domain_.edges[axis][side] == EdgeLaw::free &&
         (side ? cells.high == domain_.grid.shape[std::size_t(axis)] - 1 : cells.low == 0);
}

template <int D>
auto VelocityGradient<D>::product(const Cells& usable, const Place& at, int row, int along,
                                  double factor) const -> Terms {
  Terms terms;
  for_products<D>(weights_along<D>(usable, at, along), [&](const Index<D>& cell, double weight) {
    terms.push_back({cell, row, factor * weight});
  });
  return terms;
}

template <int D>
auto VelocityGradient<D>::slope_on_surface(int row, int axis, int side) const -> Terms {
  Place at = at_;
  at[std::size_t(axis)] = side ? double(domain_.grid.shape[std::size_t(axis)]) - 0.5 : -0.5;
  Index<D> cell = centre_;
  cell[std::size_t(axis)] = side ? domain_.grid.shape[std::size_t(axis)] - 1 : 0;
  const double zp = domain_.impedance(wave_p)(cell), zs = domain_.impedance(wave_s)(cell);
  const double mu = zs * zs, lambda = zp * zp - 2 * mu;
  const auto gradients = row_gradients(at);
  Terms terms;
  for (int along = 0; along < D; ++along) {
    if (along == axis) continue;
    for (int moved = 0; moved < D; ++moved) {
      const double change = forced_change<D>(gradients[std::size_t(axis)], gradients[std::size_t(along)],
                                             std::size_t(moved), lambda, mu)[std::size_t(row)];
      if (change == 0) continue;
      const auto one = product(inner_, at, moved, along, side ? -change : change);
      terms.insert(terms.end(), one.begin(), one.end());
    }
  }
  return terms;
}

template <int D>
auto VelocityGradient<D>::slope(int row, int along) const -> Terms {
  // Values are read on one side of a free surface, as slope_on_surface() does, so that traction on it
  // vanishes to the last digit; what its images lack in the derivative across it is added.
  auto usable = extended_cells(domain_, centre_, row, fluid_, Reach::to_strong_interfaces);
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1})
      if (axis != along && is_free(axis, side))
        (side ? usable[std::size_t(axis)].above : usable[std::size_t(axis)].below) = Beyond::unknown;
  auto terms = product(usable, at_, row, along, 1);
  for (const int side : {0, 1}) {
    if (!is_free(along, side)) continue;
    const std::int64_t last = side ? domain_.grid.shape[std::size_t(along)] - 1 : 0;
    double lacking = side ? -1 : 1;  // of a field that is the distance from the surface
    for (const auto& weight : axis_slopes(at_[std::size_t(along)], usable[std::size_t(along)]))
      lacking -= weight.weight * (double(std::abs(weight.cell - last)) + 0.5);
    if (std::abs(lacking) < 1e-9) continue;
    for (auto term : slope_on_surface(row, along, side)) {
      term.weight *= lacking;
      terms.push_back(term);
    }
  }
  return terms;
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
    for_products<D>(weights_along<D>(inner_, at, int(axis)), [&](const Index<D>& cell, double weight) {
      depth[axis] += weight * centre_depth(domain_, cell);
    });
  if (!(depth[z] > 0)) depth[z] = 1;  // a single row
  gradients[z][z] = 1 / (h * depth[z]);
  for (std::size_t axis = 0; axis < z; ++axis) gradients[z][axis] = -depth[axis] / (h * depth[z]);
  return gradients;
}

template <int D>
std::vector<ValueWeight> VelocityGradient<D>::weights(const Layout<D>& layout, int axis, int along) const {
  const auto gradients = row_gradients(at_);
  std::map<std::pair<std::int64_t, std::int64_t>, double> sums;  // by line, place
  for (int coordinate = 0; coordinate < D; ++coordinate) {
    const double part = gradients[std::size_t(coordinate)][std::size_t(along)];
    if (part == 0) continue;
    for (const auto& term : slope(FieldRows<D>::velocity(axis), coordinate))
      sums[{layout.line_number(term.cell), term.cell[0] + term.row * layout.row_pitch()}] +=
          part * term.weight;
  }
  std::vector<ValueWeight> weights;
  weights.reserve(sums.size());
  for (const auto& [at, weight] : sums) weights.push_back({at.first, at.second, weight});
  return weights;
}

template class VelocityGradient<2>;
template class VelocityGradient<3>;

}  // namespace slipwave::solver
