// SPDX-License-Identifier: BSD-3-Clause
#include "rock/tilted_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {
namespace {

constexpr std::array cut_properties = {Property::cut_epsilon, Property::cut_delta, Property::cut_dip};
}  // namespace

template <int D>
Material tilted_mean_of(const Medium<D>& medium, std::size_t cell) {
  return {double(medium.vp[cell]),
          double(medium.vs[cell]),
          double(medium.rho[cell]),
          medium.value(Property::cut_epsilon, cell),
          medium.value(Property::cut_delta, cell),
          medium.value(Property::cut_dip, cell)};
}

template <int D>
std::vector<std::size_t> cells_of_tilted_means(const Medium<D>& medium) {
  std::vector<std::size_t> cells;
  const std::array fields{&medium[Property::cut_epsilon], &medium[Property::cut_delta]};
  const auto is_cut = [&](std::size_t cell) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const auto* field) { return !field->empty() && (*field)[cell] != 0; });
  };
  if (fields[0]->empty() && fields[1]->empty()) return cells;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (is_cut(cell)) cells.push_back(cell);
  return cells;
}

template <int D>
void add_tilted_means(Medium<D>& medium) {
  for (const auto property : cut_properties) medium[property] = Field<D>(medium.grid());
}

template <int D>
void put_tilted_mean(Medium<D>& medium, std::size_t cell, const Material& about_normal, double dip_rad) {
  const auto rounded = [](double value) { return std::abs(value) < least_anisotropy ? 0 : float(value); };
  medium[Property::cut_epsilon][cell] = rounded(about_normal.epsilon);
  medium[Property::cut_delta][cell] = rounded(about_normal.delta);
  if (is_tilted_mean(medium, cell)) medium[Property::cut_dip][cell] = float(dip_rad / degree);
}

template <int D>
void drop_tilted_means(Medium<D>& medium) {
  for (const auto property : cut_properties)
    if (medium.has(property)) medium[property] = {};
}

template <int D>
double fastest_in_tilted_mean(const Medium<D>& medium, std::size_t cell) {
  return fastest_p_speed_at_most(tilted_mean_of(medium, cell));
}

template <int D>
std::optional<AnisotropyFault> fault_of_tilted_mean(const Medium<D>& medium, std::size_t cell) {
  if (!is_tilted_mean(medium, cell)) return {};
  const auto expected_none = [&](const char* where) {
    const auto of =
        medium.value(Property::cut_epsilon, cell) != 0 ? Property::cut_epsilon : Property::cut_delta;
    return AnisotropyFault{of, "is " + shown(medium.value(of, cell), 6) + ", expected 0 " + where};
  };
  if (medium.is_fluid(cell)) return expected_none("in fluid: tilted means are of solids");
  if (is_anisotropic(medium, cell))
    return expected_none("where epsilon or delta is not 0: tilted means are of isotropic rocks");
  auto fault = fault_of_anisotropy(tilted_mean_of(medium, cell));
  if (fault) fault->of = fault->of == Property::epsilon ? Property::cut_epsilon : Property::cut_delta;
  return fault;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, cells_of_tilted_means);
SLIPWAVE_INSTANTIATE_D(FUNCTION, tilted_mean_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, add_tilted_means);
SLIPWAVE_INSTANTIATE_D(FUNCTION, put_tilted_mean);
SLIPWAVE_INSTANTIATE_D(FUNCTION, drop_tilted_means);
SLIPWAVE_INSTANTIATE_D(FUNCTION, fastest_in_tilted_mean);
SLIPWAVE_INSTANTIATE_D(FUNCTION, fault_of_tilted_mean);

}  // namespace slipwave
