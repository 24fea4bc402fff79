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
#include "trace_input.hpp"

namespace slipwave {

/// What sw-plot was asked for.
struct PlotSettings {
  std::vector<std::string> files;  // none: standard input
  std::string output = "-";
  plot::PageSettings page;
  plot::Look look;
  TraceInput traces;
  // gathers
  std::optional<Component> component;
  std::optional<double> shot;
  plot::GatherStyle gather;
  // models and snapshots
  std::string property = "vp", survey, field, over, minus;
  std::optional<double> time_s;
  std::optional<Slice> slice;  // of what is in 3-D
  bool movie = false;
  // spectra and errors
  bool log = false, overlay = false;
};

/// The page of these settings, its format by the ending of the output.
plot::Page page_of(const PlotSettings& settings);

/// Finds out what kind of files these are and draws them. Throws Error naming the file when it is none that
/// can be drawn, a usage Error for several files of a kind that is drawn one at a time.
plot::Picture picture_of(const PlotSettings& settings, const plot::Page& page);

/// Draws all times of a snapshot file on one scale, each into a file of its own: NAME-0001.png for -o
/// NAME.png.
void draw_movie(const PlotSettings& settings, const Progress& progress);

}  // namespace slipwave
