// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geology/layers.hpp"
#include "rock/input_units.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// What stands for curves that a log lacks, and how it becomes cells.
struct LogChoice {
  InputUnits units;                              // of curves that name none
  bool vs_from_vp = false, rho_from_vp = false;  // Castagna's line, Gardner's relation (rock/relations.hpp)
  double fluid_vp = 1500;                        // with vs_from_vp: fluid where vp is at most this
  std::optional<double> block_m;                 // thickness of blocks; none: of cells
  MediumLimits limits;                           // of samples
  bool layered = false;                          // means of flat layers (Backus 1962), with their anisotropy
};

/// A log in depth: samples with all of vp, vs and density, from the top down.
struct WellLog {
  std::string name;              // of the file
  std::vector<double> depths_m;  // ascending
  std::vector<Material> materials;
  std::int64_t left_out = 0;  // rows in which some value is missing
  std::string curves;         // what was taken: "vp from dtco (us/ft), vs from dts (us/ft), ..."
};

/// Reads a log: LAS 1.2 or 2.0, or columns with a header line. Curves are known by their names: depth (tvd,
/// depth, dept, md), vp or a sonic (dt, dtc, dtco, ...), vs or a shear sonic, density (rho, rhob, ...), in
/// any unit that udunits knows or logs spell. Throws Error naming file and line, or what is missing or
/// ambiguous.
WellLog read_well_log(const std::string& path, const LogChoice& choice);

/// Makes the blocks of a layer from its log (Layer::log): from the face of cells of `spacing_m` nearest to
/// its first sample on. Each block is at least a cell thick and the mean over the samples in it, each of
/// which stands for what is nearest to it (MaterialMean); below the last sample the last block continues.
void fill_from_log(Layer& layer, double spacing_m);

/// The log as a layer, filled for cells of `spacing_m`. `in_3d`: the layer has gamma, too. Throws Error
/// naming the depths of a block without samples, or where fluid and solid meet, and a usage Error for blocks
/// thinner than cells.
Layer layer_of_log(const WellLog& log, double spacing_m, bool in_3d, const LogChoice& choice);

/// One line: samples, depths, blocks and what they are made of.
std::string report_of_log(const WellLog& log, const Layer& layer, const LogChoice& choice);

}  // namespace slipwave
