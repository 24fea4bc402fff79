// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// How many times wider cells of a band may be than those of the band beside it (theory.md (B1)).
inline constexpr int widest_step_of_bands = 4;

/// How many times wider cells of a band may be than those of the band beside it where the face lies in one
/// rock: with more, the energy of random fields at order 5 and 7 rose for some steps by up to 0.2 %
/// (theory/bands.md).
inline constexpr int widest_step_in_rock = 2;

/// Rows of a neighbour beyond a face between bands that a band holds: as many as decide how it sweeps its own
/// rows and the first beyond them.
constexpr std::int64_t rows_beside_band(int order) { return std::int64_t(3) * nearness_of(order); }

/// Whether sweeps along an axis take the face between two cells for a strong interface.
template <int D>
bool strong_interface(const Medium<D>& medium, std::size_t one, std::size_t other, int axis = D - 1) {
  const auto apart = [&](Wave wave) {
    return strong_interface_between(wave_impedance(medium, one, axis, wave),
                                    wave_impedance(medium, other, axis, wave));
  };
  return apart(wave_p) || apart(wave_s);
}

/// Bands as an option gives them, "0:0.6,30:2.4": where each begins, m, and the size of its cells, m; empty
/// for "none" and "auto". Throws a usage Error.
std::vector<Band> parse_bands(const std::string& text);

/// "0.6 m, from z=30 m on 2.4 m": the cells of bands as messages show them, to so many digits or all.
std::string shown(const std::vector<Band>& bands, int digits = 0);

/// The largest cells of bands, m; 0 without bands.
double largest_cell_m(const std::vector<Band>& bands);

/// Returns the bands in cells some `ratio` times as large.
std::vector<Band> resized(std::vector<Band> bands, double ratio);

/// The bands that a scene calls for, at the same cells per wavelength everywhere: wherever all waves below
/// are twice as fast or more, and rows of both cells begin, cells become 2 to 4 times as large. None where
/// less than half of the cells and steps would be saved.
struct ChosenBands {
  std::vector<Band> bands;
  double share = 1;  // of cells times steps, over those of the model's own cells
};
template <int D>
ChosenBands bands_for(const Scene<D>& scene);

/// One scene for each band of cells (Numerics::bands) of a checked scene of a whole model. Its model is the
/// rows of the band and some of its neighbours beyond, in columns of its own; its subdomain is the rows of
/// the band; its time step is that of all. Throws a usage Error where a face between bands is not on a face
/// of level rows of both, where cells of one do not divide those of another, where a band has too few rows,
/// and on what bands do not go with.
template <int D>
std::vector<Scene<D>> scenes_of_bands(const Scene<D>& scene);

}  // namespace slipwave
