// SPDX-License-Identifier: BSD-3-Clause
#include "segy/geometry.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <set>

#include "base/error.hpp"
#include "segy/extension.hpp"

namespace slipwave::segy {
namespace {

constexpr double foot_m = 0.3048;

/// All lengths that become words of one trace header, but for midpoints.
std::array<double, 8> lengths_of(const TraceHeader& h) {
  return {h.source_m[0],   h.source_m[1],   h.source_m[2],          h.receiver_m[0],
          h.receiver_m[1], h.receiver_m[2], h.water_depth_source_m, h.water_depth_receiver_m};
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// The scalars of the standard that divide: the state of the choice over all lengths.
class ScalarChoice {
 public:
  /// A length, that of a place or of a midpoint, which readers find from the places.
  void see(double length, bool of_place) {
    for (Candidate& candidate : candidates_) {
      const double word = length * std::abs(candidate.scalar);
      const double rounding = std::fabs(word - std::nearbyint(word));
      candidate.rounding = std::max(candidate.rounding, rounding);
      if (of_place) candidate.of_places = std::max(candidate.of_places, rounding);
      candidate.fits = candidate.fits && std::fabs(word) < std::numeric_limits<std::int32_t>::max();
    }
  }
  /// The coarsest that rounds nothing, else the finest whose words fit.
  void choose(SurveyLayout& layout) const {
    for (const Candidate& candidate : candidates_) {
      if (!candidate.fits) break;
      layout.coordinate_scalar = candidate.scalar;
      layout.rounding_m = candidate.of_places / std::abs(candidate.scalar);
      if (candidate.rounding < 1e-6) break;
    }
  }

 private:
  struct Candidate {
    int scalar;
    double rounding = 0, of_places = 0;  // units
    bool fits = true;
  };
  std::array<Candidate, 5> candidates_ = {{{1}, {-10}, {-100}, {-1000}, {-10000}}};
};

/// This class finds lines of receivers that run along one axis: it holds where they lie along the other.
class Lines {
 public:
  /// Receivers that follow each other belong to a line where nothing but the place along it differs.
  void see(double along_before, double along, double across_before, double across) {
    if (along != along_before && across == across_before) places_.insert(across);
  }
  /// Half the smallest distance between two lines, at most `widest`. Rounding of coordinates is no distance.
  double bin(double widest) const {
    double least = 2 * widest;
    for (auto at = places_.begin(); at != places_.end(); ++at) {
      const auto next = std::next(at);
      if (next != places_.end() && *next - *at >= coordinate_step_m) least = std::min(least, *next - *at);
    }
    return least / 2;
  }

 private:
  static constexpr double coordinate_step_m = 1e-4;
  std::set<double> places_;
};

/// Whole metres, negative where the receiver lies before the source.
std::int64_t offset_word(const TraceHeader& header) {
  const auto &source = header.source_m, &receiver = header.receiver_m;
  const double along = receiver[0] != source[0] ? receiver[0] - source[0] : receiver[1] - source[1];
  return std::llround(std::copysign(distance(source, receiver), along));
}

std::int64_t line_of(const TraceHeader& header, const SurveyLayout& layout) {
  return bin_of((header.source_m[1] + header.receiver_m[1]) / 2, layout.bin_y_m);
}

Numbering numbering_of(std::span<const TraceHeader> headers, const SurveyLayout& layout) {
  if (headers.empty()) return Numbering::bins;
  bool one_offset = true, channels = false;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    if (line_of(headers[i], layout) != line_of(headers.front(), layout)) return Numbering::bins;
    one_offset = one_offset && offset_word(headers[i]) == offset_word(headers.front());
    channels = channels || (i > 0 && headers[i].shot == headers[i - 1].shot &&
                            headers[i].component == headers[i - 1].component);
  }
  return one_offset && channels ? Numbering::channels : Numbering::shots;
}

void set_lines(TraceWords& words, const TraceHeader& header, const SurveyLayout& layout) {
  const auto component = code_of(header.component);
  switch (layout.numbering) {
    case Numbering::bins:
      words.set("iline", line_of(header, layout));
      words.set("xline", words.get("cdp"));
      break;
    case Numbering::shots:
      words.set("iline", header.shot);
      words.set("xline", component);
      break;
    case Numbering::channels:
      words.set("iline", component);
      words.set("xline", header.channel);
      break;
  }
}

std::int64_t unit_code(Component component) {
  const std::string unit = unit_of(component);
  if (unit == "Pa") return 1;
  if (unit == "m") return 5;
  if (unit == "m/s2") return 7;
  return unit == "m/s" ? 6 : -1;
}

}  // namespace

std::int64_t code_of(Component component) { return row_of(component).trace_code; }

Component component_of_code(std::int64_t code) {
  for (const auto& row : component_rows())
    if (row.trace_code == code) return row.component;
  return Component::other;
}

SurveyLayout layout_of(std::span<const TraceHeader> headers) {
  SurveyLayout layout;
  layout.traces = static_cast<std::int64_t>(headers.size());
  ScalarChoice choice;
  double spacing = 0, closest = 0;
  Lines along_x, along_y;
  std::int64_t in_shot = 0;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    for (const double length : lengths_of(headers[i])) {
      if (!(std::fabs(length) < std::numeric_limits<std::int32_t>::max()))
        throw Error("trace " + std::to_string(i + 1) + ": coordinate " + shown(length) +
                    " m, SEG-Y holds whole numbers of 32 bits");
      choice.see(length, true);
    }
    for (const std::size_t axis : {0, 1})
      choice.see((headers[i].source_m[axis] + headers[i].receiver_m[axis]) / 2, false);
    const double offset = distance(headers[i].source_m, headers[i].receiver_m);
    if (offset > 0 && (closest == 0 || offset < closest)) closest = offset;
    const bool same_shot = i > 0 && headers[i].shot == headers[i - 1].shot;
    in_shot = same_shot ? in_shot + 1 : 1;
    layout.traces_per_shot = std::max(layout.traces_per_shot, in_shot);
    if (!same_shot || headers[i].component != headers[i - 1].component) continue;
    const auto &receiver = headers[i].receiver_m, &before = headers[i - 1].receiver_m;
    along_x.see(before[0], receiver[0], before[1], receiver[1]);
    along_y.see(before[1], receiver[1], before[0], receiver[0]);
    const double step = distance(receiver, before);
    if (step > 0 && (spacing == 0 || step < spacing)) spacing = step;
  }
  choice.choose(layout);
  layout.closest_m = spacing > 0 && spacing < closest ? spacing : closest;
  if (spacing > 0) {
    layout.bin_m = along_y.bin(spacing / 2);
    layout.bin_y_m = along_x.bin(spacing / 2);
  }
  layout.numbering = numbering_of(headers, layout);
  return layout;
}

std::int64_t bin_of(double midpoint_m, double bin_m) {
  // Midpoints a bin apart get numbers one apart also where they lie between two centres, up to rounding.
  constexpr double rounding = 1e-6;
  const std::int64_t steps = std::llround(midpoint_m / bin_m + rounding);
  return steps >= 0 ? steps + 1 : steps;
}

TraceWords words_from_si(const TraceHeader& header, const SurveyLayout& layout) {
  const auto word = [&](double metres) { return std::llround(metres * std::abs(layout.coordinate_scalar)); };
  const auto& [sx, sy, sz] = header.source_m;
  const auto& [gx, gy, gz] = header.receiver_m;
  const double mid_x = (sx + gx) / 2;
  const double mid_y = (sy + gy) / 2;
  TraceWords words;
  words.set("fldr", header.shot);
  words.set("tracf", header.channel);
  words.set("ep", header.shot);
  const auto bin = header.bin != 0 ? header.bin : bin_of(mid_x, layout.bin_m);
  words.set("cdp", bin);
  words.set("trid", code_of(header.component));
  words.set("nvs", 1);
  words.set("nhs", 1);
  words.set("duse", 1);
  words.set("offset", offset_word(header));
  words.set("gelev", word(-gz));
  words.set("sdepth", word(sz));
  words.set("swdep", word(header.water_depth_source_m));
  words.set("gwdep", word(header.water_depth_receiver_m));
  words.set("scalel", layout.coordinate_scalar);
  words.set("scalco", layout.coordinate_scalar);
  words.set("sx", word(sx));
  words.set("sy", word(sy));
  words.set("gx", word(gx));
  words.set("gy", word(gy));
  words.set("counit", 1);
  words.set("cdpx", word(mid_x));
  words.set("cdpy", word(mid_y));
  set_lines(words, header, layout);
  words.set("sp", header.shot);
  words.set("spscal", 1);
  words.set("unit", unit_code(header.component));
  words.set("tscal", 1);
  return words;
}

double scaled(std::int64_t value, std::int64_t scalar) {
  const auto number = static_cast<double>(value);
  if (scalar == 0) return number;
  return scalar > 0 ? number * static_cast<double>(scalar) : number / -static_cast<double>(scalar);
}

TraceHeader si_from_words(const TraceWords& words, const FileHeader& file,
                          const std::optional<ExtensionWords>& extension) {
  using Standard = FieldName<TraceLayout>;
  using Wide = FieldName<ExtensionLayout>;
  const bool geographic = !arc_of(words).empty();
  const double length_m = file.feet ? foot_m : 1;
  const double coordinate_m = geographic ? 1 : length_m;
  const auto coordinate = [&](Standard name, Wide wide) {
    return coordinate_m * real_or(extension, wide, scaled(words.get(name), words.get("scalco")));
  };
  const auto height = [&](Standard name, Wide wide) {
    return length_m * real_or(extension, wide, scaled(words.get(name), words.get("scalel")));
  };
  TraceHeader header;
  header.shot = extension && extension->get("xfldr") != 0 ? extension->get("xfldr") : words.get("fldr");
  header.channel = words.get("tracf");
  header.component = component_of_code(words.get("trid"));
  header.source_m = {coordinate("sx", "xsx"), coordinate("sy", "xsy"),
                     height("sdepth", "xsdepth") - height("selev", "xselev")};
  header.receiver_m = {coordinate("gx", "xgx"), coordinate("gy", "xgy"), 0.0 - height("gelev", "xgelev")};
  header.water_depth_source_m = height("swdep", "xswdep");
  header.water_depth_receiver_m = height("gwdep", "xgwdep");
  return header;
}

bool is_length_scalar(std::int64_t word) {
  const auto size = std::abs(word);
  return size == 0 || size == 1 || size == 10 || size == 100 || size == 1000 || size == 10000;
}

std::string arc_of(const TraceWords& words) {
  switch (words.get("counit")) {
    case 2:
      return "seconds of arc";
    case 3:
      return "degrees";
    case 4:
      return "degrees, minutes and seconds (DDDMMSS.ss)";
    default:
      return "";
  }
}

PlaceWords place_words(const TraceWords& words, const FileHeader& file,
                       const std::optional<ExtensionWords>& extension) {
  PlaceWords place;
  place.unit_m = file.feet ? foot_m : 1;
  place.offset_m = place.unit_m * real_or(extension, "xoffset", static_cast<double>(words.get("offset")));
  if (file.su || file.major < 1) return place;
  const double length_m = words.get("counit") <= 1 ? place.unit_m : 1;
  place.midpoint_m = {length_m * scaled(words.get("cdpx"), words.get("scalco")),
                      length_m * scaled(words.get("cdpy"), words.get("scalco"))};
  return place;
}

PositionsGiven positions_given(const TraceHeader& header, const PlaceWords& place) {
  const auto at_0 = [](const auto& point) { return point[0] == 0 && point[1] == 0; };
  const bool no_source = at_0(header.source_m), no_receiver = at_0(header.receiver_m);
  const double apart = distance(header.source_m, header.receiver_m), said = std::fabs(place.offset_m);
  if (no_source && no_receiver && !at_0(place.midpoint_m)) return {false, false};
  if (no_source && no_receiver && place.offset_m == 0) return {true, true, false};
  // Byte 37 is rounded, or cut, to whole units.
  if (apart == 0 ? said == 0 : std::fabs(apart - said) < place.unit_m) return {};
  return {!no_source || said == 0, !no_receiver};
}

void place_missing(TraceHeader& header, const PositionsGiven& given, const PlaceWords& place) {
  auto &source = header.source_m, &receiver = header.receiver_m;
  const auto& midpoint = place.midpoint_m;
  if (!given.source && !given.receiver && (midpoint[0] != 0 || midpoint[1] != 0)) {
    source[0] = midpoint[0] - place.offset_m / 2;
    source[1] = midpoint[1];
  }
  if (!given.receiver) {
    receiver[0] = source[0] + place.offset_m;
    receiver[1] = source[1];
  } else if (!given.source) {
    source[0] = receiver[0] - place.offset_m;
    source[1] = receiver[1];
  }
}

double start_s(const TraceWords& words, const FileHeader& file) {
  const bool has_scalar = !file.su && file.major >= 1;
  return 1e-3 * scaled(words.get("delrt"), has_scalar ? words.get("tscal") : 1);
}

void fill_revision_1(TraceWords& words) {
  words.set("cdpx", (words.get("sx") + words.get("gx")) / 2);
  words.set("cdpy", (words.get("sy") + words.get("gy")) / 2);
  words.set("iline", 1);
  words.set("xline", words.get("cdp"));
  words.set("sp", words.get("ep"));
  words.set("spscal", 1);
  words.set("unit", unit_code(component_of_code(words.get("trid"))));
  words.set("tscal", 1);
}

}  // namespace slipwave::segy
