// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gather_picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "plot/magnitudes.hpp"
#include "plot/panel.hpp"
#include "plot/raster.hpp"
#include "plot/ticks.hpp"
#include "plot/wiggle.hpp"

namespace slipwave::plot {
namespace {

/// What one panel shows.
struct Content {
  std::string title;
  GatherSection section;
  TracePlaces traces;
  std::vector<double> edges;  // between the places

  /// In the order of the axis, gained.
  Content(std::string name, GatherSection of, const GatherStyle& style)
      : title(std::move(name)),
        section(std::move(of)),
        traces(order_traces(section, style.axis)),
        edges(edges_between(traces.places)) {
    apply_gain(section, style.gain_power);
  }
};

Axis axis_of(const Content& content) {
  Axis axis;
  switch (content.traces.axis) {
    case TraceAxis::x:
      axis = {"receiver x", "m"};
      break;
    case TraceAxis::y:
      axis = {"receiver y", "m"};
      break;
    case TraceAxis::midpoint:
      axis = {"midpoint x", "m"};
      break;
    case TraceAxis::offset:
      axis = {"offset", "m"};
      break;
    case TraceAxis::depth:
      axis = {"receiver depth", "m"};
      break;
    default:
      axis = {"trace", "", 0, 1, false, true};
      break;
  }
  axis.low = content.edges.front();
  axis.high = content.edges.back();
  return axis;
}

/// What colours stand for. A gain of t^2 turns m/s into m/s s^2.
Axis value_axis(const GatherSection& section, double gain_power) {
  const std::string name = section.component == Component::other ? "amplitude" : name_of(section.component);
  const std::string unit = typeset_unit(unit_of(section.component));
  if (gain_power == 0) return {name, unit};
  const std::string power = gain_power == 1 ? "" : raised(shown(gain_power));
  return {name + " t" + power, unit.empty() ? "s" + power : unit + " s" + power};
}

Bands bands_of(const Content& content) {
  Bands bands{content.traces.run_name, {}, {}, {}};
  for (const auto& run : content.traces.runs) {
    bands.edges.push_back(content.edges[run.first]);
    bands.labels.push_back(run.label);
  }
  if (!bands.edges.empty()) bands.edges.push_back(content.edges.back());
  for (const auto first : content.traces.line_starts) bands.minor.push_back(content.edges[first]);
  return bands;
}

Raster density_raster(const Content& content, const Panel& panel, const Page& page, const Look& look) {
  const auto& section = content.section;
  const Rect& plot = panel.plot();
  const int width = pixels_along(plot.width, page), height = pixels_along(plot.height, page);
  const auto times = even_edges(section.axis.start_s - section.axis.interval_s / 2, section.axis.interval_s,
                                section.axis.count);
  // Samples of a trace lie side by side: the raster is made lying on its side.
  const auto trace = [&](std::int64_t n) { return section.trace(std::size_t(n)); };
  if (!look.interpolate) {
    const auto columns = cells_of_pixels(panel.x_scale(), plot.x, plot.right(), width, content.edges);
    const auto rows = cells_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height, times);
    return reduced<float>(trace, rows, columns, Take::extreme);
  }
  auto columns =
      mixes_of_pixels(panel.x_scale(), plot.x, plot.right(), width, content.edges, content.traces.places);
  for (auto& mix : columns) {  // nothing is mixed across shots or lines
    const auto begins = [&](std::size_t first) { return std::int64_t(first) == mix.cells.first + 1; };
    const auto& [runs, starts] = std::tie(content.traces.runs, content.traces.line_starts);
    if (!mix.share || (std::none_of(runs.begin(), runs.end(), [&](auto& run) { return begins(run.first); }) &&
                       std::none_of(starts.begin(), starts.end(), begins)))
      continue;
    const auto nearest = mix.cells.first + (*mix.share < 0.5 ? 0 : 1);
    mix = {{nearest, nearest + 1}, {}};
  }
  const auto rows = mixes_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height, times, middles_of(times));
  return interpolated(trace, rows, columns, Take::extreme);
}

void draw_density(Canvas& canvas, const Panel& panel, const Content& content, const ColourBar& bar,
                  const Look& look) {
  const auto raster = density_raster(content, panel, canvas.page(), look);
  Image image(raster.height, raster.width);
  const double low = bar.axis.low, span = bar.axis.high - bar.axis.low;
  for (int column = 0; column < image.width; ++column) {
    for (int row = 0; row < image.height; ++row) {
      const double value = double(raster.at(row, column));
      if (!std::isnan(value)) image.at(column, row) = bar.map.pixel((value - low) / span);
    }
  }
  canvas.image(image, panel.plot());
}

/// Several gathers must show the same quantity.
void check_components(const std::vector<NamedGather>& gathers) {
  for (const auto& other : gathers) {
    const auto& first = gathers.front();
    if (other.section.component != first.section.component)
      throw Error(other.name + ": is " + name_of(other.section.component) + ", " + first.name + " is " +
                  name_of(first.section.component) + "; choose a --component that both have");
  }
}

NamedGather difference_of(const NamedGather& a, const NamedGather& b, double gain) {
  const auto refuse = [&](std::string differs, std::size_t trace) {
    if (differs.empty()) return;
    if (trace > 0) differs.insert(0, "trace " + std::to_string(trace) + " of those drawn: ");
    throw Error(b.name + ": " + differs + " as in " + a.name);
  };
  refuse(sampling_difference(b.section.axis, a.section.axis), 0);
  if (a.section.traces() != b.section.traces())
    refuse("has " + std::to_string(b.section.traces()) + " traces to draw, expected " +
               std::to_string(a.section.traces()),
           0);
  for (std::size_t n = 0; n < a.section.traces(); ++n)
    refuse(geometry_difference(b.section.headers[n], a.section.headers[n]), n + 1);
  NamedGather less{"difference" + (gain == 1 ? std::string() : ", \u00d7 " + shown(gain)), a.section};
  for (std::size_t n = 0; n < less.section.samples.size(); ++n)
    less.section.samples[n] = float(gain * (double(a.section.samples[n]) - double(b.section.samples[n])));
  return less;
}

void add_difference(std::vector<NamedGather>& gathers, const GatherStyle& style) {
  if (gathers.size() != 2)
    throw Error("--difference: found " + std::to_string(gathers.size()) + " gather" +
                    (gathers.size() == 1 ? "" : "s") + ", expected two: FILE less FILE",
                ErrorKind::usage);
  gathers.push_back(difference_of(gathers[0], gathers[1], style.difference_gain));
}

/// Everything of a picture that its panels share.
struct Drawing {
  std::vector<Content> contents;
  PanelSpec spec;  // axes of the first
  ColourBar bar;
  double full = 1;  // of lines
};

Drawing drawing_of(std::vector<NamedGather> gathers, const GatherStyle& style, const Look& look) {
  Drawing drawing{{}, {}, {map_of(look, "blue-red"), value_axis(gathers.front().section, style.gain_power)}};
  Magnitudes magnitudes;
  const std::size_t given = gathers.size() - (style.difference ? 1 : 0);
  for (auto& gather : gathers) {
    drawing.contents.emplace_back(gather.name, std::move(gather.section), style);
    if (drawing.contents.size() <= given) magnitudes.add(drawing.contents.back().section.samples);
  }
  drawing.full = magnitudes.percentile(look.clip_percent);
  if (drawing.full == 0) drawing.full = 1;  // silence
  auto& bar = drawing.bar;
  bar.axis.low = look.colours ? look.colours->low : -drawing.full;
  bar.axis.high = look.colours ? look.colours->high : drawing.full;
  bar.point_beyond(magnitudes.lowest(), magnitudes.highest());
  if (look.colours) drawing.full = std::max(std::fabs(bar.axis.low), std::fabs(bar.axis.high));
  return drawing;
}

PanelSpec spec_of(const Content& content, const Look& look) {
  const auto& axis = content.section.axis;
  PanelSpec spec{content.title, axis_of(content), {"time", "s"}, {}, {}};
  spec.y.low = axis.start_s;
  spec.y.high = axis.start_s + double(axis.count - 1) * axis.interval_s;
  spec.y.upwards = false;
  if (axis.count == 1) widen(spec.y, 0);
  narrow(spec.x, look.x, "--x");
  narrow(spec.y, look.y, "--y");
  spec.bands = bands_of(content);
  return spec;
}

void note_thinning(Picture& picture, std::size_t every) {
  if (every > 1)
    picture.notes.push_back("lines would touch each other: one in " + std::to_string(every) +
                            " traces is drawn (--style density draws all)");
}

/// The data of a panel; gives of how many traces one line is drawn.
std::size_t draw_content(Canvas& canvas, const Panel& panel, const Content& content, const Drawing& drawing,
                         const GatherStyle& style, const Look& look) {
  std::size_t every = 1;
  canvas.within(panel.plot(), [&] {
    if (style.density) draw_density(canvas, panel, content, drawing.bar, look);
    if (style.wiggle)
      every = draw_wiggles(canvas, panel, content.section, content.traces.places,
                           {.full = drawing.full, .fill = !style.density});
  });
  return every;
}

/// The rooms of `count` panels whose data are equally wide; the last has the colour bar.
std::vector<Rect> rooms_of(const PanelSpec& spec, const std::optional<ColourBar>& bar, const Rect& all,
                           std::size_t count, const Page& page) {
  double bar_pt = 0;
  if (bar && count > 1) {
    PanelSpec with = spec;
    with.bar = bar;
    bar_pt = Panel(spec, all, page).plot().width - Panel(with, all, page).plot().width;
  }
  std::vector<Rect> rooms;
  const double width = (all.width - bar_pt) / double(count);
  for (std::size_t n = 0; n < count; ++n)
    rooms.push_back({all.x + double(n) * width, all.y, width + (n + 1 == count ? bar_pt : 0), all.height});
  return rooms;
}

Picture draw_side_by_side(const Drawing& drawing, const GatherStyle& style, const Look& look, Page page) {
  Picture picture;
  const auto count = drawing.contents.size();
  if (page.height_pt == 0) {
    page.width_pt = std::min(16 + 7 * (double(count) - 1), 40.0) * points_per_cm;
    page.height_pt = 12 * points_per_cm;
  }
  Canvas canvas(page);
  double top_pt = 0;
  if (count > 1 && !page.title.empty()) top_pt = draw_title(canvas, page.title);
  std::vector<PanelSpec> specs;
  for (const auto& content : drawing.contents) {
    specs.push_back(spec_of(content, look));
    if (count == 1) specs.back().title = page.title;
  }
  const std::optional<ColourBar> bar = style.density ? std::optional(drawing.bar) : std::nullopt;
  const auto rooms =
      rooms_of(specs.front(), bar, {0, top_pt, page.width_pt, page.height_pt - top_pt}, count, page);
  double tallest = 0;  // some have bands above the data
  for (std::size_t n = 0; n < count; ++n) {
    if (n + 1 == count) specs[n].bar = bar;
    tallest = std::max(tallest, Panel(specs[n], rooms[n], page).plot().y - rooms[n].y);
  }
  std::size_t every = 1;
  for (std::size_t n = 0; n < count; ++n) {
    specs[n].least_top_pt = tallest;
    const Panel panel(specs[n], rooms[n], page);
    every = std::max(every, draw_content(canvas, panel, drawing.contents[n], drawing, style, look));
    panel.draw(canvas);
  }
  note_thinning(picture, every);
  picture.bytes = canvas.finish();
  picture.words = canvas.words();
  return picture;
}

/// Lines of all gathers in one panel, a colour each.
Picture draw_overlaid(const Drawing& drawing, const Look& look, Page page) {
  Picture picture;
  if (page.height_pt == 0) page.height_pt = 13 * points_per_cm;
  PanelSpec spec = spec_of(drawing.contents.front(), look);
  spec.title = page.title;
  for (std::size_t n = 0; n < drawing.contents.size(); ++n) {
    const auto& content = drawing.contents[n];
    if (content.traces.axis != drawing.contents.front().traces.axis)
      throw Error(content.title + ": its traces stand along another axis than those of " +
                  drawing.contents.front().title + "; choose an --axis");
    const auto other = spec_of(content, look);
    spec.x.low = std::min(spec.x.low, other.x.low);
    spec.x.high = std::max(spec.x.high, other.x.high);
    spec.y.low = std::min(spec.y.low, other.y.low);
    spec.y.high = std::max(spec.y.high, other.y.high);
    spec.legend.push_back(
        {.text = content.title, .colour = line_colour(n), .line = Stroke{line_colour(n), 1.2}});
  }
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  Canvas canvas(page);
  std::size_t every = 1;
  canvas.within(panel.plot(), [&] {
    for (std::size_t n = 0; n < drawing.contents.size(); ++n) {
      const auto& content = drawing.contents[n];
      every = std::max(every, draw_wiggles(canvas, panel, content.section, content.traces.places,
                                           {.full = drawing.full, .fill = false, .colour = line_colour(n)}));
    }
  });
  panel.draw(canvas);
  note_thinning(picture, every);
  picture.bytes = canvas.finish();
  picture.words = canvas.words();
  return picture;
}

}  // namespace

Picture draw_gathers(std::vector<NamedGather> gathers, const GatherStyle& style, const Look& look,
                     Page page) {
  check_components(gathers);
  if (style.difference) add_difference(gathers, style);
  const auto component = gathers.front().section.component;
  const bool others = std::any_of(gathers.begin(), gathers.end(),
                                  [](const auto& gather) { return gather.section.others_unasked; });
  const auto drawing = drawing_of(std::move(gathers), style, look);
  auto picture = style.overlay ? draw_overlaid(drawing, look, std::move(page))
                               : draw_side_by_side(drawing, style, look, std::move(page));
  if (others)
    picture.notes.push_back("the file holds other components, too; this is " +
                            std::string(name_of(component)) + " (--component chooses)");
  return picture;
}

Picture draw_gather(GatherSection section, const GatherStyle& style, const Look& look, Page page) {
  std::vector<NamedGather> one;
  one.push_back({"", std::move(section)});
  return draw_gathers(std::move(one), style, look, std::move(page));
}

}  // namespace slipwave::plot
