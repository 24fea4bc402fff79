// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geology/region.hpp"
#include "model/single_fracture.hpp"

namespace slipwave {

/// More would take minutes and be smaller than cells.
constexpr int most_fractures = 1'000'000;

/// Straight single fractures, in 3-D discs, drawn from a seed.
struct FractureNetwork {
  int count = 0;                        // how many; 0: by intensity
  double intensity_per_m = 0;           // P21: metres in a square metre; P32: square metres in a cubic one
  double least_m = 0, most_m = 0;       // lengths, in 3-D radii
  double exponent = 2;                  // the density of lengths falls as length^-exponent
  double dip_deg = 0;                   // the middle of the dips
  std::optional<double> concentration;  // von Mises, of twice the angle; without it all have that dip
  std::uint64_t seed = 1;
  // In 3-D that planes dip towards; poles have a Fisher distribution about that of dip and azimuth.
  double azimuth_deg = 0;
};

/// Throws a usage Error that names the option where a value is out of range.
template <int D>
void check_network(const FractureNetwork& network);

/// A length for a share from 0 to 1 of all fractures that are shorter (theory.md (S31)).
double drawn_length(const FractureNetwork& network, double share);
/// How far the dip of a fracture is from the middle, degrees, for the same of dips.
double drawn_turn(double concentration, double share);
/// The cosine of the angle of its pole from the mean one, for the same of poles that are farther away.
double drawn_cosine(double concentration, double share);

/// Fractures whose centres are drawn evenly from a region, cut off at the border of the model; the first ones
/// of a seed are the same for any count. By intensity, as many as come nearest to it, of the part of the
/// region that is in the model. Throws a usage Error where an intensity means none or more than
/// most_fractures, an Error when hardly any point of the bounds is in the region.
std::vector<FractureTrace<2>> drawn_fractures(const Grid<2>& grid, const Region& region,
                                              const FractureNetwork& network);
/// Returns discs that are drawn in this way; in a fitted grid they are cut off at the box of the model.
std::vector<FractureTrace<3>> drawn_fractures(const Grid<3>& grid, const RegionIn<3>& region,
                                              const FractureNetwork& network);

}  // namespace slipwave
