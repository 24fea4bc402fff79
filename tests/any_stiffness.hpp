// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <random>
#include <type_traits>

#include "rock/anisotropy.hpp"

namespace slipwave {

/// Rock of any stiffness whose strains cost energy: the smaller `softest`, the softer some strains may be.
/// Draws are uniform in 0 .. 1.
template <int D>
Material any_stiffness(const std::function<double()>& random, double softest) {
  std::decay_t<decltype(Elasticity<D>::voigt)> parts, c;
  for (auto& row : parts)
    for (auto& part : row) part = 2 * random() - 1;
  c = product_of(parts, transposed(parts));
  double trace = 0;
  for (std::size_t n = 0; n < c.size(); ++n) trace += c[n][n];
  for (std::size_t n = 0; n < c.size(); ++n) c[n][n] += softest * trace;
  const double scale = (10e9 + 50e9 * random()) / trace;
  return rock_of_constants(Elasticity<D>{times(c, scale)}, 1800 + 1000 * random());
}

/// Gives solid cells of a medium any stiffness, by blocks of so many cells; vp and rho stay.
template <int D>
void put_any_stiffness(Medium<D>& medium, unsigned seed, int block) {
  const auto& grid = medium.grid();
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  medium[Property::c33] = Field<D>(grid);
  complete_anisotropy(medium);
  std::map<Index<D>, Material> drawn;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto cell = std::size_t(n);
    if (!medium.is_solid(cell)) continue;
    auto at = grid.index(n);
    for (auto& part : at) part /= block;
    if (!drawn.contains(at)) drawn[at] = any_stiffness<D>([&] { return uniform(engine); }, 0.05);
    const auto c = elasticity_of<D>(drawn[at]);
    const double rho = medium.rho[cell], vp = medium.vp[cell];
    put(medium, cell, rock_of_constants<D>(c.times(rho * vp * vp / c(3, 3)), rho));
  }
}

}  // namespace slipwave
