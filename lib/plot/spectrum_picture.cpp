// SPDX-License-Identifier: BSD-3-Clause
#include "plot/spectrum_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "plot/magnitudes.hpp"
#include "plot/panel.hpp"
#include "plot/raster.hpp"

namespace slipwave::plot {
namespace {

/// Lines of one unit, which share a panel.
struct Group {
  std::string unit, quantity;
  struct Member {
    const Spectra* file;
    const Spectra::Line* line;
  };
  std::vector<Member> members;
  double greatest = 0;
};

std::vector<Group> groups_of(const std::vector<Spectra>& files) {
  std::vector<Group> groups;
  for (const auto& file : files) {
    for (const auto& line : file.lines) {
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& one) {
        return one.unit == line.unit && one.quantity == file.quantity;
      });
      if (group == groups.end()) group = groups.insert(groups.end(), {line.unit, file.quantity, {}, 0});
      group->members.push_back({&file, &line});
      for (const double value : line.values) {
        if (std::isfinite(value)) group->greatest = std::max(group->greatest, value);
      }
    }
  }
  return groups;
}

/// What of the greatest value still counts where axes end at the last that does.
constexpr double least_share = 0.01;

/// Frequencies from 0 to the end, or to where nothing is left, or what was asked for.
Axis frequency_axis(const std::vector<Spectra>& files, bool all, const std::optional<Limits>& wanted) {
  Axis axis{"frequency", "Hz", 0, 0};
  double last = 0;
  for (const auto& file : files) {
    axis.high = std::max(axis.high, file.frequencies_hz.back());
    for (const auto& line : file.lines) {
      const double greatest = *std::max_element(line.values.begin(), line.values.end());
      for (std::size_t n = 0; n < line.values.size(); ++n) {
        if (line.values[n] > least_share * greatest) last = std::max(last, file.frequencies_hz[n]);
      }
    }
  }
  if (axis.high == 0) axis.high = 1;
  if (wanted)
    narrow(axis, wanted, "--x");
  else if (last > 0 && !all)
    axis.high = std::min(axis.high, 1.05 * last);
  return axis;
}

Axis value_axis(const Group& group, bool log, const Look& look) {
  const double greatest = group.greatest > 0 ? group.greatest : 1;
  Axis axis{group.quantity, group.unit, 0, 1.05 * greatest};
  if (log) {
    axis.low = greatest * (group.quantity == "amplitude" ? 1e-5 : 1e-10);
    axis.high = 2 * greatest;
    axis.log = true;
  }
  if (look.y) narrow(axis, look.y, "--y");
  return axis;
}

Stroke stroke_of(std::size_t index) {
  return {line_colour(index), 1.1, index < 8 ? std::vector<double>() : std::vector<double>{4, 2}};
}

void draw_group(Canvas& canvas, const Panel& panel, const Group& group, bool log) {
  const double floor = panel.y_scale().value(panel.plot().bottom());
  for (std::size_t n = 0; n < group.members.size(); ++n) {
    const auto& [file, line] = group.members[n];
    std::vector<Spot> spots;
    for (std::size_t k = 0; k < line->values.size(); ++k) {
      const double value = log ? std::max(line->values[k], floor / 10) : line->values[k];
      spots.push_back({panel.x(file->frequencies_hz[k]), panel.y(value)});
    }
    canvas.polyline(spots, stroke_of(n));
  }
}

Picture draw_lines(const std::vector<Spectra>& files, bool log, const Look& look, Page page) {
  const auto groups = groups_of(files);
  if (page.height_pt == 0) {
    page.height_pt = 2 * points_per_cm;
    for (const auto& group : groups)
      page.height_pt += 8 * points_per_cm + 2 * extra_height_pt(group.members.size());
  }
  const double height = page.height_pt / double(groups.size());
  std::vector<PanelSpec> specs;
  double left = 0, right = 0;  // so that the panels' frequencies stand above each other
  for (const auto& group : groups) {
    specs.push_back(
        {specs.empty() ? page.title : "", frequency_axis(files, log, look.x), value_axis(group, log, look)});
    for (std::size_t n = 0; n < group.members.size(); ++n) {
      const auto& member = group.members[n];
      const std::string name =
          files.size() > 1 ? member.file->name + ": " + member.line->name : member.line->name;
      specs.back().legend.push_back({.text = name, .colour = line_colour(n), .line = stroke_of(n)});
    }
    const Panel panel(specs.back(), {0, 0, page.width_pt, height}, page);
    left = std::max(left, panel.plot().x);
    right = std::max(right, page.width_pt - panel.plot().right());
  }
  Canvas canvas(page);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    specs[g].least_left_pt = left;
    specs[g].least_right_pt = right;
    const Panel panel(specs[g], {0, double(g) * height, page.width_pt, height}, page);
    panel.draw_grid(canvas);
    canvas.within(panel.plot(), [&] { draw_group(canvas, panel, groups[g], log); });
    panel.draw(canvas);
  }
  return {canvas.finish(), canvas.words()};
}

/// Values as colours show them, a trace or wavenumber each.
struct Shown {
  std::vector<std::vector<float>> traces;
  Axis quantity;
};

constexpr double floor_db = -60;

/// Returns the decibels of a power of ten.
double decibels(const Spectra& spectra) { return spectra.quantity == "amplitude" ? 20 : 10; }

/// In dB of the greatest value.
Shown in_decibels(const Spectra& spectra) {
  double greatest = 0;
  for (const auto& line : spectra.lines)
    for (const double value : line.values) greatest = std::max(greatest, value);
  const double factor = decibels(spectra);
  Shown shown{{}, {spectra.quantity + " of " + spectra.lines[0].name, "dB", floor_db, 0}};
  for (const auto& line : spectra.lines) {
    shown.traces.emplace_back();
    for (const double value : line.values)
      shown.traces.back().push_back(
          float(value > 0 ? std::max(factor * std::log10(value / greatest), floor_db) : floor_db));
  }
  return shown;
}

/// Colours are full at a percentile of what the axes show: beyond the band of the data there is next to
/// nothing.
Shown as_they_are(const Spectra& spectra, const Look& look, const Axis& places, const Axis& frequencies) {
  Shown shown{{}, {spectra.quantity + " of " + spectra.lines[0].name, spectra.lines[0].unit, 0, 1}};
  Magnitudes magnitudes;
  const auto& all = spectra.frequencies_hz;
  const auto first = std::size_t(std::lower_bound(all.begin(), all.end(), frequencies.low) - all.begin());
  const auto end = std::size_t(std::upper_bound(all.begin(), all.end(), frequencies.high) - all.begin());
  for (std::size_t n = 0; n < spectra.lines.size(); ++n) {
    const auto& values = spectra.lines[n].values;
    shown.traces.emplace_back(values.begin(), values.end());
    if (spectra.places[n] >= places.low && spectra.places[n] <= places.high)
      magnitudes.add(std::span(shown.traces.back()).subspan(first, end - first));
  }
  const double full = magnitudes.percentile(look.clip_percent);
  if (full > 0) shown.quantity.high = full;
  return shown;
}

/// The places and frequencies beyond which nothing of the least share that counts is left, of energy of its
/// square.
struct Band {
  double first_place = 0, last_place = 0, last_hz = 0;
};

Band band_of(const Spectra& spectra) {
  const double share = spectra.quantity == "amplitude" ? least_share : least_share * least_share;
  double greatest = 0;
  for (const auto& line : spectra.lines)
    for (const double value : line.values) greatest = std::max(greatest, value);
  Band band{spectra.places.back(), spectra.places.front(), 0};
  for (std::size_t k = 0; k < spectra.lines.size(); ++k) {
    for (std::size_t n = 0; n < spectra.frequencies_hz.size(); ++n) {
      if (!(spectra.lines[k].values[n] > share * greatest)) continue;
      band.first_place = std::min(band.first_place, spectra.places[k]);
      band.last_place = std::max(band.last_place, spectra.places[k]);
      band.last_hz = std::max(band.last_hz, spectra.frequencies_hz[n]);
    }
  }
  return band;
}

/// Returns the axis of places: of traces all; of wavenumbers those of the band, as far to both sides.
Axis place_axis(const Spectra& spectra, const std::vector<double>& edges, const Band& band) {
  if (spectra.place == Spectra::Place::phase_velocity)
    return {"phase velocity", "m/s", edges.front(), edges.back()};
  if (spectra.place == Spectra::Place::receiver_x) return {"receiver x", "m", edges.front(), edges.back()};
  if (spectra.place == Spectra::Place::trace_number)
    return {"trace", "", edges.front(), edges.back(), false, true};
  Axis axis{"wavenumber", "1/m", edges.front(), edges.back()};
  const double reach = 1.1 * std::max(std::fabs(band.first_place), std::fabs(band.last_place));
  if (reach > 0) axis.low = std::max(axis.low, -reach), axis.high = std::min(axis.high, reach);
  return axis;
}

Picture draw_each(const Spectra& spectra, bool log, const Look& look, Page page) {
  // Dispersion images have velocities over frequency.
  const bool frequency_along_x = spectra.place == Spectra::Place::phase_velocity;
  const auto cells = cells_round(spectra.places);
  const auto band = band_of(spectra);
  const double nyquist = spectra.frequencies_hz.back();
  auto places = place_axis(spectra, cells.edges, band);
  Axis frequency{"frequency", "Hz", 0, std::max(nyquist, 1.)};
  if (band.last_hz > 0) frequency.high = std::min(frequency.high, 1.1 * band.last_hz);
  const auto& of_places = frequency_along_x ? look.y : look.x;
  const auto& of_frequency = frequency_along_x ? look.x : look.y;
  if (of_places) places.low = cells.edges.front(), places.high = cells.edges.back();
  if (of_frequency && nyquist > 0) frequency.high = nyquist;
  narrow(places, of_places, frequency_along_x ? "--y" : "--x");
  narrow(frequency, of_frequency, frequency_along_x ? "--x" : "--y");
  auto shown = log ? in_decibels(spectra) : as_they_are(spectra, look, places, frequency);
  const auto& traces = shown.traces;
  if (look.colours) {
    shown.quantity.low = look.colours->low;
    shown.quantity.high = look.colours->high;
  }
  const Limits limits{shown.quantity.low, shown.quantity.high};
  PanelSpec spec{page.title,
                 frequency_along_x ? frequency : places,
                 frequency_along_x ? places : frequency,
                 ColourBar{map_of(look, "uniform"), shown.quantity},
                 {}};
  Magnitudes magnitudes;
  for (const auto& trace : traces) magnitudes.add(trace);
  spec.bar->point_beyond(magnitudes.lowest(), magnitudes.highest());
  if (page.height_pt == 0) page.height_pt = 10 * points_per_cm;
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  const Rect& plot = panel.plot();
  const int width = pixels_along(plot.width, page), height = pixels_along(plot.height, page);
  const double step = spectra.frequencies_hz.size() > 1 ? spectra.frequencies_hz[1] : 1;
  const auto along = [&](bool x, const std::vector<double>& edges) {
    return x ? cells_of_pixels(panel.x_scale(), plot.x, plot.right(), width, edges)
             : cells_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height, edges);
  };
  const auto of_bins =
      along(frequency_along_x, even_edges(-step / 2, step, std::int64_t(spectra.frequencies_hz.size())));
  const std::vector<float> nothing(spectra.frequencies_hz.size(), std::numeric_limits<float>::quiet_NaN());
  const auto line = [&](std::int64_t cell) {
    return cells.is_gap(cell) ? nothing.data() : traces[std::size_t(cells.place[std::size_t(cell)])].data();
  };
  const auto raster = reduced<float>(line, of_bins, along(!frequency_along_x, cells.edges),
                                     log ? Take::greatest : Take::extreme);
  Image image(width, height);
  for (int column = 0; column < width; ++column) {
    for (int row = 0; row < height; ++row) {
      const double value = double(frequency_along_x ? raster.at(column, row) : raster.at(row, column));
      image.at(column, row) = spec.bar->map.pixel((value - limits.low) / (limits.high - limits.low));
    }
  }
  Canvas canvas(page);
  canvas.image(image, plot);
  panel.draw(canvas);
  return {canvas.finish(), canvas.words()};
}

}  // namespace

Picture draw_spectra(const std::vector<Spectra>& files, bool log, const Look& look, Page page) {
  const bool each = std::any_of(files.begin(), files.end(), [](const Spectra& one) { return one.each(); });
  if (each && files.size() > 1)
    throw Error(
        "spectra of each trace or wavenumber are drawn from one file, found " + std::to_string(files.size()),
        ErrorKind::usage);
  return each ? draw_each(files[0], log, look, std::move(page))
              : draw_lines(files, log, look, std::move(page));
}

}  // namespace slipwave::plot
