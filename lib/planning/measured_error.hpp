// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/scene_runs.hpp"

namespace slipwave {

/// A point source is spread over so many cells on either side (theory/sources.md, (A1)): nearer to it,
/// receivers record what it is spread like, and runs in other cells tell nothing of their error. Those that
/// near in the cells of the model are left out of it, unless there are no others.
constexpr int cells_of_a_source = 4;

/// What moves the traces when it alone is changed, whatever the size of the cells.
struct Sensitivity {
  std::string what;    // "edges twice as wide"
  std::string option;  // "--edge-width 40"
  double change = 0;   // relative L2, in cells of
  double spacing_m = 0;
};

/// The error of a setting, measured by runs in cells of other sizes.
struct MeasuredError {
  AccuracySetting setting;
  std::vector<double> others_m;  // the sizes that its own was compared with
  double order = 0;              // of the error in the size of cells, between 1 and 2
  GatherError error;             // of everything that was measured
  double by_cells = 0;           // of that, what smaller cells cure
  double by_edges = 0;           // what wider edges change; NaN where there are none
  std::vector<Sensitivity> sensitivities;
  std::vector<Gather> wrong;      // with the traces, of the shots observed: found less exact
  std::size_t beside_source = 0;  // receivers left out (cells_of_a_source)
  bool extrapolated = false;      // from larger cells alone: the setting itself was not run
  double run_s = 0;               // processor time of the setting itself
  double measuring_s = 0;         // of all other runs
};

/// What is measured beside the size of cells.
struct Measured {
  bool itself = true;   // the setting is run, too
  bool edges = true;    // wider ones
  bool others = false;  // half the time step, the next order, and rows that follow what they can
};

/// Measures the error of a setting: it is run, in cells of one and a half times their size, and of that again
/// (or what the scene holds nearest to that; finer ones where it holds no larger); with error_of_sizes().
/// What edges, which are as wide in all of these, send back is told by one more run in the largest cells with
/// edges twice as wide, and added. Throws an Error where the scene cannot be run in cells of any other size.
template <int D>
MeasuredError measured_error(SceneRuns<D>& runs, const AccuracySetting& setting, const Measured& what = {});

/// The sizes, others than its own, that a setting is measured by, the nearest first.
template <int D>
std::vector<AccuracySetting> other_sizes(const SceneRuns<D>& runs, const AccuracySetting& setting);

/// How near a receiver comes to a source, of those that are not left out.
template <int D>
double nearest_receiver_m(const SceneRuns<D>& runs);

/// Returns the setting with edges twice as wide; nothing where no edge absorbs.
template <int D>
std::optional<AccuracySetting> with_wider_edges(const SceneRuns<D>& runs, AccuracySetting setting);

/// Returns the shots of a survey that are measured: all of few, else the two that are farthest apart and, of
/// many, the one farthest from both; what differs in kind or wavelet is farther than all places.
template <int D>
std::vector<std::size_t> representative_shots(const Survey<D>& survey);

/// "0.82 % of all traces (vx 0.8, vz 0.83; late quarter 1.3; worst 2.1: shot 1, channel 24)".
template <int D>
std::string sentence_of(const MeasuredError& error, const SceneRuns<D>& runs);

}  // namespace slipwave
