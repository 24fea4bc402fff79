// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gather_picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "gather/difference.hpp"
#include "plot/gather_content.hpp"
#include "plot/magnitudes.hpp"
#include "plot/panel.hpp"
#include "plot/ticks.hpp"
#include "plot/wiggle.hpp"

namespace slipwave::plot {
namespace {

/// A gather, or the difference of the two before it.
struct Item {
  NamedGather gather;
  bool is_difference = false;
};

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

/// Gathers of a component beside each other and, where it is wanted, behind each two their difference.
std::vector<Item> items_of(std::vector<NamedGather> gathers, const GatherStyle& style) {
  std::vector<Component> order;
  for (const auto& gather : gathers)
    if (std::find(order.begin(), order.end(), gather.section.component) == order.end())
      order.push_back(gather.section.component);
  std::vector<Item> items;
  for (const auto component : order) {
    const std::size_t first = items.size();
    for (auto& gather : gathers)
      if (gather.section.component == component) items.push_back({std::move(gather)});
    if (!style.difference) continue;
    const std::size_t count = items.size() - first;
    if (count != 2)
      throw Error("--difference: found " + std::to_string(count) + " gather" + (count == 1 ? "" : "s") +
                      ", expected two: FILE less FILE",
                  ErrorKind::usage);
    items.push_back(
        {difference_of(items[first].gather, items[first + 1].gather, style.difference_gain), true});
  }
  return items;
}

/// What a panel is called: its file where there are several, and its component likewise.
std::string title_of(const NamedGather& gather, bool several_files, bool several_components) {
  const std::string component = name_of(gather.section.component);
  if (!several_components) return gather.name;
  return several_files ? gather.name + ": " + component : component;
}

/// Colours and lengths of lines of all panels whose samples have one unit.
struct CommonScale {
  std::string unit;
  std::vector<std::string> names;  // of components
  Magnitudes magnitudes;
  std::optional<ColourBar> bar = {};
  double full = 1;  // of lines

  void add(const GatherContent& content, bool is_difference) {
    const std::string name =
        content.section.component == Component::other ? "amplitude" : name_of(content.section.component);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    if (!is_difference) magnitudes.add(content.section.samples);
  }
  /// A gain is by the number of seconds: the unit stays.
  void finish(double gain_power, const Look& look) {
    const std::string power = gain_power == 1 ? "" : raised(shown(gain_power));
    const std::string gain = gain_power == 0 ? "" : " \u00b7 t" + power;
    full = magnitudes.percentile(look.clip_percent);
    if (full == 0) full = 1;  // silence
    const Limits limits = look.colours.value_or(Limits{-full, full});
    bar = ColourBar{map_of(look, "blue-red"), {joined(names) + gain, unit, limits.low, limits.high}};
    bar->point_beyond(magnitudes.lowest(), magnitudes.highest());
    if (look.colours) full = std::max(std::fabs(limits.low), std::fabs(limits.high));
  }
};

/// Everything of a picture: panels that share a scale stand beside each other.
struct GatherDrawing {
  std::vector<GatherContent> contents;
  std::vector<CommonScale> scales;
  std::vector<std::size_t> scale_of;  // of each content

  const CommonScale& scale(std::size_t content) const { return scales[scale_of[content]]; }
  /// Is it the last one of its scale, which has the bar?
  bool has_bar(std::size_t content) const {
    return content + 1 == contents.size() || scale_of[content] != scale_of[content + 1];
  }
};

GatherDrawing drawing_of(std::vector<NamedGather> gathers, const GatherStyle& style, const Look& look) {
  std::set<std::string> files;
  std::set<Component> components;
  for (const auto& gather : gathers) {
    files.insert(gather.name);
    components.insert(gather.section.component);
  }
  auto items = items_of(std::move(gathers), style);
  const auto unit = [](const Item& item) { return typeset_unit(unit_of(item.gather.section.component)); };
  GatherDrawing drawing;
  for (const auto& item : items)
    if (std::none_of(drawing.scales.begin(), drawing.scales.end(),
                     [&](const CommonScale& scale) { return scale.unit == unit(item); }))
      drawing.scales.push_back({unit(item), {}, {}});
  for (std::size_t n = 0; n < drawing.scales.size(); ++n) {
    auto& scale = drawing.scales[n];
    for (auto& item : items) {
      if (unit(item) != scale.unit) continue;
      const std::string title = title_of(item.gather, files.size() > 1, components.size() > 1);
      drawing.contents.emplace_back(title, std::move(item.gather.section), style.axis, style.gain_power);
      drawing.scale_of.push_back(n);
      scale.add(drawing.contents.back(), item.is_difference);
    }
    scale.finish(style.gain_power, look);
  }
  return drawing;
}

void note_thinning(Picture& picture, std::size_t every) {
  if (every > 1)
    picture.notes.push_back("lines would touch each other: one in " + std::to_string(every) +
                            " traces is drawn (--style density draws all)");
}

/// The data of a panel; gives of how many traces one line is drawn.
std::size_t draw_content(Canvas& canvas, const Panel& panel, const GatherContent& content,
                         const CommonScale& scale, const GatherStyle& style, const Look& look) {
  std::size_t every = 1;
  canvas.within(panel.plot(), [&] {
    if (style.density) draw_density(canvas, panel, content, *scale.bar, look);
    if (style.wiggle)
      every = draw_wiggles(canvas, panel, content, {.full = scale.full, .fill = !style.density});
  });
  return every;
}

/// The rooms of panels whose data are equally wide; some have a colour bar.
std::vector<Rect> rooms_of(const std::vector<PanelSpec>& specs, const Rect& all, const Page& page) {
  std::vector<double> bars_pt;
  double free = all.width;
  for (const auto& spec : specs) {
    PanelSpec without = spec;
    without.bar.reset();
    bars_pt.push_back(!spec.bar || specs.size() == 1
                          ? 0
                          : Panel(without, all, page).plot().width - Panel(spec, all, page).plot().width);
    free -= bars_pt.back();
  }
  std::vector<Rect> rooms;
  double x = all.x;
  for (const double bar_pt : bars_pt) {
    rooms.push_back({x, all.y, free / double(specs.size()) + bar_pt, all.height});
    x = rooms.back().right();
  }
  return rooms;
}

Picture draw_side_by_side(const GatherDrawing& drawing, const GatherStyle& style, const Look& look,
                          Page page) {
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
  for (std::size_t n = 0; n < count; ++n) {
    specs.push_back(spec_of(drawing.contents[n], look));
    if (count == 1) specs.back().title = page.title;
    if (style.density && drawing.has_bar(n)) specs.back().bar = drawing.scale(n).bar;
  }
  const auto rooms = rooms_of(specs, {0, top_pt, page.width_pt, page.height_pt - top_pt}, page);
  double tallest = 0;  // some have bands above the data
  for (std::size_t n = 0; n < count; ++n)
    tallest = std::max(tallest, Panel(specs[n], rooms[n], page).plot().y - rooms[n].y);
  std::size_t every = 1;
  for (std::size_t n = 0; n < count; ++n) {
    specs[n].least_top_pt = tallest;
    const Panel panel(specs[n], rooms[n], page);
    every = std::max(every, draw_content(canvas, panel, drawing.contents[n], drawing.scale(n), style, look));
    panel.draw(canvas);
  }
  note_thinning(picture, every);
  picture.bytes = canvas.finish();
  picture.words = canvas.words();
  return picture;
}

/// Refuses what has no common axes.
void check_overlaid(const GatherDrawing& drawing) {
  if (drawing.scales.size() > 1)
    throw Error("--overlay: found components in " + drawing.scales[0].unit + " and in " +
                    drawing.scales[1].unit + ", expected one unit; choose a --component",
                ErrorKind::usage);
  const auto& first = drawing.contents.front();
  for (const auto& content : drawing.contents)
    if (content.traces.axis != first.traces.axis)
      throw Error(content.title + ": its traces stand along another axis than those of " + first.title +
                  "; choose an --axis");
}

/// Lines of all gathers in one panel, a colour each.
Picture draw_overlaid(const GatherDrawing& drawing, const Look& look, Page page) {
  check_overlaid(drawing);
  Picture picture;
  if (page.height_pt == 0) page.height_pt = 13 * points_per_cm;
  PanelSpec spec = spec_of(drawing.contents.front(), look);
  spec.title = page.title;
  for (std::size_t n = 0; n < drawing.contents.size(); ++n) {
    const auto& content = drawing.contents[n];
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
    for (std::size_t n = 0; n < drawing.contents.size(); ++n)
      every = std::max(
          every, draw_wiggles(canvas, panel, drawing.contents[n],
                              {.full = drawing.scale(n).full, .fill = false, .colour = line_colour(n)}));
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
