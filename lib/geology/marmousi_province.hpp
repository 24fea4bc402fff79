// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace slipwave::marmousi {

/// The units from the top down. Between each and the next one time is missing.
enum class Unit {
  clastics,    // tilted, cut by growth faults that end at its base
  fill,        // flat layers that lap onto the dome
  dome,        // layers over the rise, parallel to its top
  evaporites,  // lenses on the angular unconformity
  folded       // the old series, folded and eroded flat
};

/// A fault that flattens with depth.
struct GrowthFault {
  double at_sea_floor_m = 0;
  double cotangent = 0, flattening_per_m = 0;  // of the dip at the sea floor, and what it gains a metre
  double throw_m = 0;                          // of beds that were there before it moved

  double position(double depth_m) const {
    return at_sea_floor_m + (cotangent + flattening_per_m * depth_m / 2) * depth_m;
  }
};

/// A short straight fault that ends up and down within the clastics.
struct SmallFault {
  double middle_m = 0, depth_m = 0;  // where its throw is largest
  double cotangent = 0, throw_m = 0;
  double reach_m = 0;  // up and down
};

/// A bed of sand that holds oil and gas above contacts that are flat today.
struct Trap {
  Unit unit = Unit::clastics;
  double pile_m = 0, thickness_m = 0;
  double middle_m = 0, half_width_m = 0;  // of the bed, which thins to both sides
  int block = -1;                         // the block that holds the fluids; -1: any
  double gas_above_m = 0, oil_above_m = 0;
};

/// One rise and all that goes with it. Provinces follow each other every 16 km, each of its own shape,
/// without an end to either side; what they do to the rocks fades before the next one begins.
struct Province {
  double centre_m = 0;
  int side = 1;  // -1: mirrored
  double dome_m = 0, dome_crest_m = 0, dome_left_m = 0, dome_right_m = 0;
  double fold_slope_left = 0, fold_slope_right = 0, fold_width_m = 0, fold_crest_m = 0;
  double evaporite_left_m = 0, evaporite_right_m = 0;
  std::vector<GrowthFault> faults;  // left to right
  std::vector<SmallFault> small_faults;
  std::vector<Trap> traps;

  /// Positions are counted from the centre, and mirrored as the province is.
  double offset_of(double x_m) const { return side * (x_m - centre_m); }
  double x_of(double offset_m) const { return centre_m + side * offset_m; }
  /// How far old clastics have been lifted towards the right, before faults let them down again: gently at
  /// first, steeply where blocks have turned. In the end they are as deep as before.
  double rise_at(double offset_m) const;
  /// Depth in the pile of the clastics, and the block, of what lies at a depth below the sea floor now,
  /// having been lifted by `lift_m` in all. Movements act in part on what was deposited while they went on:
  /// that part grows down to 1500 m.
  double pile_of_clastics(double offset_m, double depth_m, double lift_m, int& block) const;
};

/// Province number `number` of a seed; 0 has its centre near x = 6.2 km.
Province province_of(std::uint64_t seed, std::int64_t number);
/// How far the beds of the clastics undulate where nothing else has moved them, m.
double undulation_of(std::uint64_t seed, double x_m);
/// The number of the province whose centre is nearest.
std::int64_t province_at(std::uint64_t seed, double x_m);

}  // namespace slipwave::marmousi
