// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>

#include "grid/field.hpp"
#include "rock/property.hpp"

namespace slipwave {

/// A material: a field of each property, all on one grid. vs = 0 marks fluid, rho = 0 marks void (air).
/// Formulas use the fields by their letters; what treats all properties alike walks properties().
template <int D>
class Medium {
 public:
  Field<D> vp, vs;  // m/s
  Field<D> rho;     // kg/m3

  Medium() = default;
  Medium(Field<D> vp, Field<D> vs, Field<D> rho)
      : vp(std::move(vp)), vs(std::move(vs)), rho(std::move(rho)) {}
  /// Zeros, of what every medium has.
  explicit Medium(const Grid<D>& grid) : vp(grid), vs(grid), rho(grid) {}
  /// Zeros, of what another medium has; that may be in 2-D and this one in 3-D.
  template <int E>
  Medium(const Grid<D>& grid, const Medium<E>& like) {
    for (const Property property : like.properties()) (*this)[property] = Field<D>(grid);
  }

  const Grid<D>& grid() const { return vp.grid(); }
  bool is_void(std::size_t cell) const { return rho[cell] == 0; }
  bool is_fluid(std::size_t cell) const { return rho[cell] != 0 && vs[cell] == 0; }
  bool is_solid(std::size_t cell) const { return rho[cell] != 0 && vs[cell] != 0; }

  /// Its field, empty where an optional property is absent; assigning one makes it present. References stay
  /// good as long as the medium does.
  Field<D>& operator[](Property property) {
    return std::size_t(property) < required_properties ? this->*required[std::size_t(property)]
                                                       : optional(property);
  }
  const Field<D>& operator[](Property property) const {
    return std::size_t(property) < required_properties ? this->*required[std::size_t(property)]
                                                       : optional(property);
  }
  bool has(Property property) const {
    if (std::size_t(property) < required_properties) return true;
    return !optional_.empty() && !optional_[std::size_t(property) - required_properties].empty();
  }
  /// Returns the properties it has, in the order of the table.
  std::vector<Property> properties() const;
  /// Returns the value of a cell; what the property's row says where the medium lacks it.
  double value(Property property, std::size_t cell) const {
    return has(property) ? double((*this)[property][cell]) : value_if_absent(property);
  }
  /// Are two cells of one material?
  bool same(std::size_t a, std::size_t b) const;

 private:
  static constexpr std::array<Field<D> Medium::*, required_properties> required = {&Medium::vp, &Medium::vs,
                                                                                   &Medium::rho};
  Field<D>& optional(Property property);
  const Field<D>& optional(Property property) const {
    return optional_.empty() ? absent() : optional_[std::size_t(property) - required_properties];
  }
  static const Field<D>& absent();
  static double value_if_absent(Property property);

  std::vector<Field<D>> optional_;  // of the rows after the required ones; none where all are absent
};

/// What a check of a medium lets through beyond the usual.
struct MediumLimits {
  bool allow_auxetic = false;  // vs > vp/sqrt(2), that is lambda < 0
  bool allow_slow = false;     // speeds and densities that no rock, soil or fluid has
  bool in_3d = false;          // a section of what becomes a model in 3-D: rock must be one there
};

}  // namespace slipwave
