// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace slipwave {

class NetcdfFile;
class OutputFile;

/// 2 or 3: the axes of a model or of snapshots. 2 for files that are neither.
int dimension_of(const NetcdfFile& file);

/// Reads a model file (docs/formats.md, Model), from standard input for "-". Structure is checked here
/// (names, dimensions, equal steps, sets), values by check(). Throws Error naming file, place, found and
/// expected.
template <int D>
Model<D> read_model(const std::string& path);
template <int D>
Model<D> read_model(const NetcdfFile& file);
/// What it holds of the rows first <= row < last of the last axis (in 3-D planes), and nothing else.
template <int D>
Model<D> read_model_rows(const NetcdfFile& file, std::int64_t first, std::int64_t last);
/// The grid of all of it.
template <int D>
Grid<D> read_model_grid(const NetcdfFile& file);

/// The fracture sets of a model file, and nothing else of it.
template <int D>
std::vector<FractureSet<D>> read_fracture_sets(const NetcdfFile& file);

/// Writes a model file to a path or "-"; it appears whole or not at all.
template <int D>
void write_model(const Model<D>& model, const std::string& path);
/// Writes a model file into an output opened beforehand; commits it.
template <int D>
void write_model(const Model<D>& model, OutputFile& out);

}  // namespace slipwave
