// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/report.hpp"
#include "model/model.hpp"

namespace slipwave {

class NetcdfFile;

/// What is in a model: grid, ranges, kinds of cells, fractures, provenance.
template <int D>
Report report_of(const Model<D>& model);

/// What is in any other netCDF file, snapshots among them: grid and times where it has them, then every
/// variable with its dimensions, unit and range (NaN left out). Reads the values of each variable, one step
/// of the first dimension at a time.
Report report_of(const NetcdfFile& file);

/// "model" (it has all properties that every model has), "snapshots" (it has time and a grid) or "netCDF".
std::string kind_of(const NetcdfFile& file);

}  // namespace slipwave
