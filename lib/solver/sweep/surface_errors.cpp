// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/surface_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/instantiate.hpp"
#include "base/small_matrix.hpp"
#include "scene/splitting.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/motion_along.hpp"

namespace slipwave::solver {

template <int D>
ExtensionErrors errors_below_surface(const Domain<D>& domain, const Index<D>& at, int axis, int along,
                                     int velocity, bool of_source) {
  const double courant = domain.courant(at, axis, pair_of<D>(axis, velocity));
  if (courant == 0) return {};
  const auto of_step = splitting(D, domain.steps.time_order);
  const auto times = std::count_if(of_step.begin(), of_step.end(),
                                   [axis](const SweepFraction& sweep) { return sweep.axis == axis; });
  // A single sweep across, in the middle of the step, leaves nothing where its images have the slope.
  if (!of_source && times == 1) return {};
  SweepsAcross sweeps{domain.order, {0, 1}, {0, courant}, axis, along, of_step};
  sweeps.merges = !of_source, sweeps.beside_void = true;
  // Images have the slope in the steps, but for those of the transposed step.
  return extension_errors(sweeps, {{0, 1}, {}}, {0, of_source ? 0. : 1.});
}

namespace {

/// A moment that adds to stress (i, j) of cells, below a free surface across an axis.
template <int D>
class MomentBelowSurface {
 public:
  MomentBelowSurface(const Layout<D>& layout, const Domain<D>& domain,
                     const std::vector<ValueWeight>& weights, int i, int j, int axis, int side,
                     const Index<D>& edge)
      : layout_(layout),
        domain_(domain),
        weights_(weights),
        i_(i),
        j_(j),
        axis_(axis),
        side_(side),
        edge_(edge) {}

  /// Sweeps along the surface find velocities along it that lie off, so strains along it do; those across it
  /// follow, since sweeps across heal tractions. The difference of two cells tells of the slope.
  void add_of_motion(int along, std::vector<ValueWeight>& all) const {
    using Rows = FieldRows<D>;
    if (!traction() && i_ != along && j_ != along) return;
    const auto errors = errors_below_surface(domain_, edge_, axis_, along, along, true).v_found[1];
    const auto c = elasticity_at(domain_, edge_);
    const auto unit = [](int of) { return unit_vector<std::size_t(D)>(std::size_t(of)); };
    const auto bend =
        product_of(inverse_of(christoffel<D>(c, unit(axis_))), tractions<D>(c, unit(axis_), unit(along)));
    const double share = traction() ? -bend[std::size_t(velocity())][std::size_t(along)] : i_ == j_ ? 1 : 0.5;
    const auto row = Rows::stored(layout_, traction() ? Rows::normal_stress(along) : Rows::stress(i_, j_));
    for (const auto& [edge, sum] : sums(errors)) {
      const double off = share * sum / (1 + errors[1] - errors[0]);
      for (const int n : {0, 1}) {
        auto cell = domain_.grid.index(edge);
        cell[std::size_t(axis_)] += side_ ? -n : n;
        all.push_back(value_weight(layout_, cell, row, n ? -off : off));
      }
    }
  }
  /// Tractions lie off in proportion to the slope of their velocity.
  void add_of_traction(int along, std::vector<ValueWeight>& all) const {
    if (!traction()) return;
    const auto errors = errors_below_surface(domain_, edge_, axis_, along, velocity(), true).s[1];
    const double z = domain_.impedance_of_pair(axis_, pair_of<D>(axis_, velocity()))(edge_);
    const auto share = unit_vector<std::size_t(D)>(std::size_t(along));
    for (const auto& [edge, sum] : sums(errors)) {
      const auto slopes = surface_slopes(domain_, domain_.grid.index(edge), axis_, side_, share);
      for (const auto& term : slopes[std::size_t(velocity())])
        all.push_back(value_weight(layout_, term.cell, term.row, -sum * term.weight / z));
    }
  }

 private:
  bool traction() const { return i_ == axis_ || j_ == axis_; }
  /// That of the traction.
  int velocity() const { return i_ == axis_ ? j_ : i_; }
  /// Weights times errors, in the cells below each of the surface.
  std::map<std::int64_t, double> sums(const std::vector<double>& errors) const {
    std::map<std::int64_t, double> all;
    for (const auto& value : weights_) {
      auto cell = cell_of_value(layout_, value);
      auto& place = cell[std::size_t(axis_)];
      const auto n = std::size_t(std::abs(place - edge_[std::size_t(axis_)]));
      place = edge_[std::size_t(axis_)];
      if (n < errors.size()) all[domain_.grid.flat(cell)] += value.weight * errors[n];
    }
    std::erase_if(all, [](const auto& sum) { return std::abs(sum.second) < least_error; });
    return all;
  }

  const Layout<D>& layout_;
  const Domain<D>& domain_;
  const std::vector<ValueWeight>& weights_;
  int i_, j_, axis_, side_;
  Index<D> edge_;  // a cell of the surface
};

}  // namespace

template <int D>
std::vector<ValueWeight> moment_corrections(const Layout<D>& layout, const Domain<D>& domain,
                                            const Index<D>& centre, const std::vector<ValueWeight>& weights,
                                            int i, int j) {
  std::vector<ValueWeight> all;
  if (domain.curvilinear(centre[D - 1])) return all;
  const auto usable = extended_cells(domain, centre, FieldRows<D>::stress(i, j), false);
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      const auto& across = usable.cells[std::size_t(axis)];
      if (!usable.ends_free[std::size_t(axis)][std::size_t(side)] || across.high == across.low) continue;
      Index<D> edge = centre;
      edge[std::size_t(axis)] = side ? across.high : across.low;
      const MomentBelowSurface<D> moment(layout, domain, weights, i, j, axis, side, edge);
      for (int along = 0; along < D; ++along) {
        if (along == axis || thin(domain, along)) continue;
        moment.add_of_motion(along, all);
        moment.add_of_traction(along, all);
      }
    }
  return all;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, errors_below_surface);
SLIPWAVE_INSTANTIATE_D(FUNCTION, moment_corrections);

}  // namespace slipwave::solver
