// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "io/output_file.hpp"
#include "plot/derived_property.hpp"
#include "plot/file_picture.hpp"
#include "rock/property.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

/// Options as they are written.
struct Texts {
  TraceInput traces;
  std::string map = "auto", slice, range, x, y, component, axis = "auto", style = "density", at;
  bool interpolate = false, nearest = false;
};

void declare(cli::Options& options, plot::PlotOptions& settings, Texts& texts) {
  options.positional(settings.files, "FILE");
  options.add("output,o", settings.output, "FILE",
              "the picture: .png, .pdf or .svg; - is a PNG on standard output");
  options.add("size", settings.page.size, "SIZE", "size of the picture, 16x10cm or 1200x800px");
  options.add("dpi", settings.page.dpi, "N", "pixels per inch");
  options.add("title", settings.page.title, "TEXT", "title above the picture");
  options.add("map", texts.map, "NAME", "colours: " + joined(plot::ColourMap::names()));
  options.add("clip", settings.look.clip_percent, "PERCENT",
              "colours saturate at this percentile of amplitude");
  options.add("range", texts.range, "LOW:HIGH", "colours saturate at these values instead");
  options.add("x", texts.x, "LOW:HIGH", "part of the horizontal axis");
  options.add("y", texts.y, "LOW:HIGH", "part of the vertical axis");
  options.add("component", texts.component, "NAME", "gather, spectra: vx, vz, p, ...; vx,vz; all");
  options.add("shot", settings.shot, "N", "gather: this shot only");
  options.add_choice("axis", texts.axis, plot::trace_axis_names(), "gather: position of the traces");
  options.add_choice("style", texts.style, {"density", "wiggle", "both"}, "gather: colours, lines or both");
  options.add("gain-power", settings.gather.gain_power, "P", "gather: samples times time to this power");
  auto drawn = property_names();
  for (const auto& derived : plot::derived_properties()) drawn.emplace_back(derived.name);
  drawn.push_back("fractures");
  options.add_choice("property", settings.property, drawn, "model: property to draw");
  options.add("slice", texts.slice, "AXIS=AT",
              "model, snapshot in 3-D: the section on this plane, y=500, or three through X,Y,Z");
  options.add("at", texts.at, "X,Z",
              "model: instead, speeds over angle of the rock there, and Q over frequency");
  options.add("q-frequency", settings.reference_hz, "F",
              "with --at, qp, qs: frequency of the model's speeds, Hz");
  options.add("survey", settings.survey, "GATHER", "model, snapshot: mark the survey of this gather");
  options.add("field", settings.field, "NAME", "snapshot: vz, p, div, ... (the first)");
  options.add("time", settings.time_s, "T", "snapshot: the one nearest to T (the last)");
  options.add("over", settings.over, "MODEL", "snapshot: over this model");
  options.add("minus", settings.minus, "FILE", "snapshot: subtract that of this file at the same time");
  options.add("movie", settings.movie, "snapshots: all, as NAME.mp4 or, numbered, NAME.png");
  options.add("fps", settings.frames_per_s, "N", "movie: frames per second");
  options.add("log", settings.log, "spectrum: amplitudes on a log axis, colours in dB");
  options.add("overlay", settings.overlay, "gathers, errors: several in one panel, as lines");
  options.add("difference", settings.gather.difference, "gathers: of two, also the first less the second");
  options.add("difference-gain", settings.gather.difference_gain, "G", "gathers: multiply the difference");
  options.add("interpolate", texts.interpolate, "linearly between cells wider than pixels");
  options.add("nearest", texts.nearest, "gather: no interpolation between traces");
  options.excludes("range", {"clip"});
  options.excludes("interpolate", {"nearest"});
  options.excludes("movie", {"time"}, "a movie has all times");
  options.excludes("at", {"property", "x", "y"}, "it draws all angles and frequencies of the rock there");
  options.needs("q-frequency", {"at"});
  options.needs("fps", {"movie"});
  options.needs("difference-gain", {"difference"});
  texts.traces.declare(options);
}

void run(plot::PlotOptions& settings, const Texts& texts, const cli::Context& context) {
  if (texts.map != "auto") settings.look.map = texts.map;
  in_place("--map", [&] { plot::map_of(settings.look, "grey"); });
  in_place("--clip", [&] { plot::check_clip(settings.look); });
  const auto limits = [](const std::string& option, const std::string& text,
                         std::optional<plot::Limits>& to) {
    if (!text.empty()) to = in_place(option, [&] { return plot::parse_limits(text); });
  };
  limits("--range", texts.range, settings.look.colours);
  limits("--x", texts.x, settings.look.x);
  limits("--y", texts.y, settings.look.y);
  if (!texts.at.empty()) settings.at = in_place("--at", [&] { return parse_numbers(texts.at, ','); });
  if (texts.slice.find(',') != std::string::npos)
    settings.through = in_place("--slice", [&] { return parse_point<3>(texts.slice); });
  else if (!texts.slice.empty())
    settings.slice = in_place("--slice", [&] { return parse_slice(texts.slice); });
  if (!texts.component.empty())
    settings.of = in_place("--component", [&] { return plot::parse_components(texts.component); });
  if (settings.shot && (*settings.shot != std::floor(*settings.shot) || std::fabs(*settings.shot) > 1e15))
    throw Error("--shot: found " + shown(*settings.shot) + ", expected a whole number", ErrorKind::usage);
  if (texts.interpolate || texts.nearest) settings.look.interpolate = texts.interpolate;
  settings.gather.axis = plot::trace_axis_named(texts.axis);
  if (settings.overlay && texts.style == "both")
    throw Error("--overlay draws lines only, expected --style wiggle", ErrorKind::usage);
  if (settings.gather.difference_gain == 0)
    throw Error("--difference-gain: found 0, expected a number other than 0", ErrorKind::usage);
  settings.gather.density = texts.style != "wiggle";
  settings.gather.wiggle = texts.style != "density";
  settings.page.history = context.command_line;
  settings.traces = texts.traces;
  if (settings.movie) {
    plot::take_movie_name(settings);
    for (const auto& note : plot::draw_movie(settings, context.progress("movie", "frames")))
      context.warn(note);
    return;
  }

  const auto page = plot::page_of(settings);
  OutputFile out(settings.output, OutputFile::Content::binary);
  const auto picture = plot::picture_of(settings, page);
  for (const auto& note : picture.notes) context.warn(note);
  out.write(picture.bytes.data(), picture.bytes.size());
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  plot::PlotOptions settings;
  Texts texts;
  return cli::run_tool(
      argc, argv,
      {"sw-plot", "Draws models, gathers, snapshots, spectra, and error against time.",
       "[options] [FILE...] [-o PICTURE]", "sw-plot response.sgy --component vz --clip 98 -o response.png"},
      [&](cli::Options& options) { declare(options, settings, texts); },
      [&](const cli::Context& context) { run(settings, texts, context); });
}
