// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "grid/slice.hpp"
#include "plot/gather_picture.hpp"
#include "plot/look.hpp"
#include "plot/page.hpp"
#include "plot/picture.hpp"
#include "segy/input_options.hpp"

namespace slipwave::plot {

/// Files to draw and how, as sw-plot is asked for it.
struct PlotOptions {
  std::vector<std::string> files;  // none: standard input
  std::string output = "-";
  PageSettings page;
  Look look;
  segy::InputOptions traces;
  // gathers and spectra
  ComponentChoice of;
  std::optional<double> shot;
  GatherStyle gather;
  // models and snapshots
  std::string property = "vp", survey, field, over, minus;
  std::optional<double> time_s;
  std::optional<Slice> slice;          // of what is in 3-D
  std::optional<Point<3>> through;     // or three of them
  std::vector<double> at;              // of a model, the point whose rock is drawn; empty: none
  std::optional<double> reference_hz;  // for that: where it attenuates, of the model's speeds
  bool movie = false;
  double frames_per_s = 10;
  // spectra and errors
  bool log = false, overlay = false;
};

/// The page of these options, its format by the ending of the output.
Page page_of(const PlotOptions& options);

/// Finds out what kind of files these are and draws them. Throws Error naming the file when it is none that
/// can be drawn, a usage Error for several files of a kind that is drawn one at a time.
Picture picture_of(const PlotOptions& options, const Page& page);

/// Takes the one of the files named that ends as movies do for the output. Throws a usage Error where there
/// is an output already.
void take_movie_name(PlotOptions& options);

/// Draws all times of a snapshot file on one scale: into one movie for -o NAME.mp4 (or .gif), each into a
/// file of its own, NAME-0001.png, for -o NAME.png or where there is no ffmpeg; sentences say the latter.
std::vector<std::string> draw_movie(const PlotOptions& options, const Progress& progress);

}  // namespace slipwave::plot
