// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geology/fit.hpp"
#include "geology/horizon.hpp"
#include "model/model.hpp"

namespace slipwave {

/// Horizons that rows of an imported section shall follow.
struct ImportedHorizons {
  std::optional<Horizon> surface, floor;
  bool find_floor = false;  // from the cells
  double sampled_m = 0;     // the cells that the floor was sampled with
};

struct ImportFit {
  Model<2> model;
  std::string summary;                // Fit::summary
  std::vector<std::string> warnings;  // where a horizon is not where cells have it
};

/// A horizon of an option: as Horizon::parse(), and the name of a file alone is a smooth curve through its
/// points.
Horizon parse_imported_horizon(const std::string& text);

/// The smoothest depths (least squares of second differences) within `half_m` of those of a staircase, given
/// at equal distances.
std::vector<double> smoothed(const std::vector<double>& stairs_m, double half_m);

/// A section on a regular grid, on one whose rows follow its surface and its sea floor. The floor of a column
/// of cells is the top of its first solid one. `find_floor` finds it so, to half a cell, and makes it smooth
/// within that (smoothed()). A cell above (below) the floor takes the mean over old cells of its column above
/// (below) their floor at its true depth, or the nearest of them. Throws a usage Error for a section with
/// fractures, columns without fluid or rock where there shall be some, horizons that do not reach all columns
/// or cannot be followed.
ImportFit fit_imported(const Model<2>& model, const ImportedHorizons& horizons);

}  // namespace slipwave
