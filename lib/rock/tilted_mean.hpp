// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rock/anisotropy.hpp"

namespace slipwave {

// Cells that an interface of two isotropic solids cuts are transversely isotropic about its normal (theory.md
// (T1)). vp, vs and rho are the speeds along the normal and the mean density: what the isotropic mean has,
// too. The cell's cut_epsilon, cut_delta and cut_dip say the rest.

/// Less anisotropy in a mean is rounding, as where rocks differ in density alone.
inline constexpr double least_anisotropy = 1e-5;

/// Whether a cell is a tilted mean.
template <int D>
bool is_tilted_mean(const Medium<D>& medium, std::size_t cell) {
  return medium.value(Property::cut_epsilon, cell) != 0 || medium.value(Property::cut_delta, cell) != 0;
}
/// These return the cells that are tilted means, and how many there are.
template <int D>
std::vector<std::size_t> cells_of_tilted_means(const Medium<D>& medium);
template <int D>
std::int64_t tilted_means(const Medium<D>& medium) {
  return std::int64_t(cells_of_tilted_means(medium).size());
}

/// What it is about the normal, with the dip as its tilt.
template <int D>
Material tilted_mean_of(const Medium<D>& medium, std::size_t cell);

/// Returns the rock of any cell, or what the cell is about the normal where it is a tilted mean.
template <int D>
Material rock_of(const Medium<D>& medium, std::size_t cell) {
  return is_tilted_mean(medium, cell) ? tilted_mean_of(medium, cell) : material_of(medium, cell);
}

/// Gives a medium the properties of tilted means, none anywhere.
template <int D>
void add_tilted_means(Medium<D>& medium);
/// Makes a cell one: epsilon and delta are those of a mean about the normal of beds with that dip.
template <int D>
void put_tilted_mean(Medium<D>& medium, std::size_t cell, const Material& about_normal, double dip_rad);
/// Takes all of them away: cells are isotropic means.
template <int D>
void drop_tilted_means(Medium<D>& medium);

/// What the largest speed of a plane wave in such a cell is at most, m/s (fastest_p_speed_at_most()).
template <int D>
double fastest_in_tilted_mean(const Medium<D>& medium, std::size_t cell);

/// What keeps a cell from being a tilted mean; nothing where all is well.
template <int D>
std::optional<AnisotropyFault> fault_of_tilted_mean(const Medium<D>& medium, std::size_t cell);

}  // namespace slipwave
