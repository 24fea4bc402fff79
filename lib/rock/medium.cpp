// SPDX-License-Identifier: BSD-3-Clause
#include "rock/medium.hpp"

#include <algorithm>

#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
Field<D>& Medium<D>::optional(Property property) {
  // Room for all of them, so that no reference goes stale.
  if (optional_.empty()) optional_.resize(material_properties().size() - required_properties);
  return optional_[std::size_t(property) - required_properties];
}

template <int D>
const Field<D>& Medium<D>::absent() {
  static const Field<D> none;
  return none;
}

template <int D>
double Medium<D>::value_if_absent(Property property) {
  static const auto values = [] {
    std::vector<double> of_rows;
    for (const auto& row : material_properties()) of_rows.push_back(row.if_absent.value_or(0));
    return of_rows;
  }();
  return values[std::size_t(property)];
}

template <int D>
std::vector<Property> Medium<D>::properties() const {
  std::vector<Property> present;
  for (const Property property : all_properties())
    if (has(property)) present.push_back(property);
  return present;
}

template <int D>
bool Medium<D>::same(std::size_t a, std::size_t b) const {
  const auto alike = [&](const Field<D>& field) { return field.empty() || field[a] == field[b]; };
  return alike(vp) && alike(vs) && alike(rho) && std::all_of(optional_.begin(), optional_.end(), alike);
}

SLIPWAVE_INSTANTIATE_D(TYPE, class Medium);

}  // namespace slipwave
