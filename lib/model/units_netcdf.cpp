// SPDX-License-Identifier: BSD-3-Clause
#include "model/units_netcdf.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {

double unit_factor(const NetcdfFile& file, const std::string& variable, const std::vector<std::string>& small,
                   const std::vector<std::string>& large) {
  const auto unit = file.text_attribute(variable, "units");
  if (!unit || unit->empty()) return 1;
  if (std::find(small.begin(), small.end(), *unit) != small.end()) return 1;
  if (std::find(large.begin(), large.end(), *unit) != large.end()) return 1000;
  throw Error(file.shown_name() + ": " + variable + ": found the unit '" + *unit + "', expected " +
              small.front() + (large.empty() ? "" : " or " + large.front()));
}

double length_factor(const NetcdfFile& file, const std::string& variable) {
  return unit_factor(file, variable, {"m", "meter", "metre", "meters", "metres"}, {"km"});
}

}  // namespace slipwave
