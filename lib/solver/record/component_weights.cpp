// SPDX-License-Identifier: BSD-3-Clause
#include "solver/record/component_weights.hpp"

#include <algorithm>
#include <optional>

#include "base/instantiate.hpp"
#include "solver/sweep/velocity_gradient.hpp"

namespace slipwave::solver {

template <int D>
std::vector<ValueWeight> component_weights(const Layout<D>& layout, const Domain<D>& domain,
                                           const Point<D>& point_m, Component component) {
  const auto& row = slipwave::row_of(component);
  const auto terms = row.terms_in(D);
  const bool slopes =
      std::any_of(terms.begin(), terms.end(), [](const auto& term) { return term.along >= 0; });
  std::optional<VelocityGradient<D>> gradient;
  if (slopes) gradient.emplace(domain, point_m);
  std::vector<ValueWeight> all;
  for (const auto& term : terms) {
    const int field_row = row_of<D>(term.field);
    const Side side = component == Component::p ? Side::fluid : Side::solid;
    const auto weights = term.along < 0 ? row_weights(layout, domain, point_m, field_row, side)
                                        : gradient->weights(layout, field_row, std::min(term.along, D - 1));
    for (auto weight : weights) {
      weight.weight /= term.sign * (row.is_sum ? 1 : int(terms.size()));
      all.push_back(weight);
    }
  }
  return all;
}

template <int D>
std::vector<ValueWeight> velocity_along(const Layout<D>& layout, const Domain<D>& domain,
                                        const Point<D>& point_m, const Point<D>& vector) {
  std::vector<ValueWeight> all;
  for (int axis = 0; axis < D; ++axis) {
    if (vector[std::size_t(axis)] == 0) continue;
    for (auto weight : row_weights(layout, domain, point_m, FieldRows<D>::velocity(axis))) {
      weight.weight *= vector[std::size_t(axis)];
      all.push_back(weight);
    }
  }
  return all;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, component_weights);
SLIPWAVE_INSTANTIATE_D(FUNCTION, velocity_along);

}  // namespace slipwave::solver
