// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "geology/marmousi_province.hpp"

namespace slipwave::marmousi {

/// The place of a point in the pile.
struct Place {
  Unit unit = Unit::clastics;
  double depth_m = 0;  // below the sea floor, today
  double pile_m = 0;   // depth in the unit's pile before it was tilted, faulted or folded
  int block = 0;       // clastics: how many growth faults lie to the left of it
};

/// The structure under one point of the sea floor: all that does not depend on depth, computed once.
class Section {
 public:
  Section(std::uint64_t seed, double x_m);
  Place at(double depth_m) const;
  /// Is this depth in the pile of the clastics within one of the hard beds that run through all of them?
  bool is_marker(double pile_m) const;
  const Province& province() const { return province_; }
  double x_m() const { return x_m_; }
  double offset_m() const { return offset_m_; }

 private:
  Province province_;
  double x_m_ = 0, offset_m_ = 0;                                           // from the province's centre
  double rise_m_ = 0, undulation_m_ = 0;                                    // of the clastics
  double base_of_clastics_m_ = 0, top_of_dome_m_ = 0, unconformity_m_ = 0;  // depths
  struct Marker {
    double top_m = 0, bottom_m = 0;
  };
  std::array<Marker, 2> markers_;
  double dome_m_ = 0, evaporite_m_ = 0, fold_m_ = 0, drape_m_ = 0;
};

}  // namespace slipwave::marmousi
