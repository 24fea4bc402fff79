// SPDX-License-Identifier: BSD-3-Clause
#include "plot/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave::plot {
namespace {

/// A colour by lightness, chroma and hue, as Oklab has them (Ottosson 2020).
struct Shade {
  double lightness, chroma, hue_deg;
};

struct Lab {
  double l, a, b;
};

Lab lab_of(const Shade& shade) {
  const double angle = shade.hue_deg * std::numbers::pi / 180;
  return {shade.lightness, shade.chroma * std::cos(angle), shade.chroma * std::sin(angle)};
}

double companded(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

Colour colour_of(const Lab& lab) {
  const double l = std::pow(lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {companded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          companded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          companded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// Part `t` of the way from b to c, smooth with what is before and after (Catmull and Rom).
double smooth(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// A path through colours, 0 to 1, smooth through the points given; walked at equal speed by `even`.
class Path {
 public:
  explicit Path(std::span<const Shade> points) : points_(points.begin(), points.end()) {
    double length = 0;
    Lab last = lab_of(at(0));
    length_.push_back(0);
    for (int n = 1; n <= pieces; ++n) {
      const Lab next = lab_of(at(double(n) / pieces));
      length += std::hypot(next.l - last.l, next.a - last.a, next.b - last.b);
      length_.push_back(length);
      last = next;
    }
  }

  Colour even(double part) const {
    const double wanted = part * length_.back();
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
    const auto n = std::size_t(above - length_.begin());
    const double within = (wanted - length_[n - 1]) / (length_[n] - length_[n - 1]);
    return colour_of(lab_of(at((double(n - 1) + within) / pieces)));
  }

 private:
  static constexpr int pieces = 2000;

  Shade at(double part) const {
    const double scaled = part * double(points_.size() - 1);
    const auto n = std::min(std::size_t(scaled), points_.size() - 2);
    const double t = scaled - double(n);
    const Shade& before = points_[n == 0 ? 0 : n - 1];
    const Shade& from = points_[n];
    const Shade& to = points_[n + 1];
    const Shade& after = points_[std::min(n + 2, points_.size() - 1)];
    return {smooth(before.lightness, from.lightness, to.lightness, after.lightness, t),
            smooth(before.chroma, from.chroma, to.chroma, after.chroma, t),
            smooth(before.hue_deg, from.hue_deg, to.hue_deg, after.hue_deg, t)};
  }

  std::vector<Shade> points_;
  std::vector<double> length_;
};

constexpr Shade uniform[] = {{0.25, 0.12, 290}, {0.40, 0.115, 265}, {0.54, 0.095, 225},
                             {0.67, 0.11, 170}, {0.80, 0.145, 130}, {0.94, 0.19, 106}};
constexpr Shade blue[] = {{1.0, 0.0, 255}, {0.80, 0.105, 250}, {0.56, 0.165, 258}, {0.36, 0.125, 262}};
constexpr Shade red[] = {{1.0, 0.0, 30}, {0.80, 0.115, 35}, {0.56, 0.19, 27}, {0.36, 0.135, 25}};
constexpr Shade grey[] = {{0.0, 0, 0}, {1.0, 0, 0}};

constexpr Colour of_hex(std::uint32_t rgb) {
  return {double(rgb >> 16 & 0xff) / 255, double(rgb >> 8 & 0xff) / 255, double(rgb & 0xff) / 255};
}

/// Colours at equal distances that others have published, as screens take them, and a way through them.
struct Published {
  std::span<const std::uint32_t> hex;
  bool curved;  // else straight from one to the next
  Colour at(double part) const {
    const double scaled = part * double(hex.size() - 1);
    const auto n = std::min(std::size_t(scaled), hex.size() - 2);
    const Colour before = of_hex(hex[n == 0 ? 0 : n - 1]), from = of_hex(hex[n]), to = of_hex(hex[n + 1]);
    const Colour after = of_hex(hex[std::min(n + 2, hex.size() - 1)]);
    const double t = scaled - double(n);
    if (!curved) return blend(from, to, t);
    return {smooth(before.red, from.red, to.red, after.red, t),
            smooth(before.green, from.green, to.green, after.green, t),
            smooth(before.blue, from.blue, to.blue, after.blue, t)};
  }
};

// Smith and van der Walt 2015, at tenths.
constexpr std::uint32_t viridis[] = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                     0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
constexpr std::uint32_t seismic[] = {0x00004d, 0x0000ff, 0xffffff, 0xff0000, 0x800000};

/// A map by its name; `colour(part)` of one without a middle, else of (-1 .. 1).
struct MapRow {
  const char* name;
  bool diverging;
  Colour (*colour)(double part);
};

template <const auto& shades>
Colour along(double part) {
  static const Path path(shades);
  return path.even(part);
}

template <const auto& below, const auto& above>
Colour from_middle(double part) {
  return part < 0 ? along<below>(-part) : along<above>(part);
}

constexpr MapRow maps[] = {
    {"uniform", false, along<uniform>},
    {"viridis", false,
     [](double part) {
       return Published{viridis, true}.at(part);
     }},
    {"grey", false, along<grey>},
    {"white-black", false, [](double part) { return along<grey>(1 - part); }},
    {"blue-red", true, from_middle<blue, red>},
    {"red-blue", true, from_middle<red, blue>},
    {"seismic", true,
     [](double part) {
       return Published{seismic, false}.at((1 + part) / 2);
     }},
};

const MapRow& row_named(const std::string& name) {
  std::vector<std::string> known;
  for (const auto& row : maps) {
    if (name == row.name) return row;
    known.emplace_back(row.name);
  }
  for (const char* uneven : {"jet", "rainbow", "hsv"})
    if (name == uneven)
      throw Error("the map '" + name +
                      "' is refused: its lightness rises and falls, which draws edges that are not in the "
                      "data and hides others; use viridis or uniform, for waves seismic or blue-red",
                  ErrorKind::usage);
  throw Error("found the map '" + name + "', expected one of " + joined(known), ErrorKind::usage);
}

}  // namespace

std::vector<std::string> ColourMap::names() {
  std::vector<std::string> all;
  for (const auto& row : maps) all.emplace_back(row.name);
  return all;
}

ColourMap::ColourMap(const std::string& name) {
  const auto& row = row_named(name);
  diverging_ = row.diverging;
  for (int n = 0; n < steps; ++n) {
    const double part = double(n) / (steps - 1);
    // The two colours beside the middle are white both, so that zero is.
    const double off = std::max(0.0, (std::abs(2 * part - 1) * (steps - 1) - 1) / (steps - 2));
    colours_[std::size_t(n)] = row.colour(!diverging_ ? part : part < 0.5 ? -off : off);
  }
}

Colour ColourMap::at(double number) const {
  if (std::isnan(number)) return no_data;
  return colours_[std::size_t(std::lround(std::clamp(number, 0.0, 1.0) * (steps - 1)))];
}

std::uint32_t pixel_of(const Colour& colour) {
  const auto byte = [](double part) { return std::uint32_t(std::lround(std::clamp(part, 0.0, 1.0) * 255)); };
  return 0xff000000u | byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

std::uint32_t ColourMap::pixel(double number) const { return pixel_of(at(number)); }

Colour line_colour(std::size_t index) {
  static const std::array<Colour, 8> colours = [] {
    const std::array<Shade, 8> shades = {{{0.50, 0.15, 255},
                                          {0.66, 0.17, 50},
                                          {0.60, 0.13, 160},
                                          {0.48, 0.18, 25},
                                          {0.62, 0.17, 315},
                                          {0.40, 0.06, 60},
                                          {0.74, 0.13, 90},
                                          {0.55, 0.0, 0}}};
    std::array<Colour, 8> made;
    for (std::size_t n = 0; n < made.size(); ++n) made[n] = colour_of(lab_of(shades[n]));
    return made;
  }();
  return colours[index % colours.size()];
}

}  // namespace slipwave::plot
