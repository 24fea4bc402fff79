#include "model/medium.hpp"

#include <algorithm>
#include <array>

namespace slipwave {
namespace {

template <int D>
constexpr std::array<Field<D> Medium<D>::*, required_properties> required = {&Medium<D>::vp, &Medium<D>::vs,
                                                                             &Medium<D>::rho};

}  // namespace

template <int D>
Field<D>& Medium<D>::operator[](Property property) {
  const auto n = std::size_t(property);
  if (n < required_properties) return this->*required<D>[n];
  // Room for all of them, so that no reference goes stale.
  if (optional_.empty()) optional_.resize(material_properties().size() - required_properties);
  return optional_[n - required_properties];
}

template <int D>
const Field<D>& Medium<D>::operator[](Property property) const {
  static const Field<D> absent;
  const auto n = std::size_t(property);
  if (n < required_properties) return this->*required<D>[n];
  return optional_.empty() ? absent : optional_[n - required_properties];
}

template <int D>
bool Medium<D>::has(Property property) const {
  return std::size_t(property) < required_properties || !(*this)[property].empty();
}

template <int D>
std::vector<Property> Medium<D>::properties() const {
  std::vector<Property> present;
  for (const Property property : all_properties())
    if (has(property)) present.push_back(property);
  return present;
}

template <int D>
double Medium<D>::value(Property property, std::size_t cell) const {
  if (has(property)) return double((*this)[property][cell]);
  return row_of(property).if_absent.value();
}

template <int D>
bool Medium<D>::same(std::size_t a, std::size_t b) const {
  const auto alike = [&](const Field<D>& field) { return field.empty() || field[a] == field[b]; };
  return alike(vp) && alike(vs) && alike(rho) && std::all_of(optional_.begin(), optional_.end(), alike);
}

template class Medium<2>;
template class Medium<3>;

}  // namespace slipwave
