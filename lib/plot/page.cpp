// SPDX-License-Identifier: BSD-3-Clause
#include "plot/page.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "plot/canvas.hpp"

namespace slipwave::plot {
namespace {

constexpr double largest_px = 20000;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() &&
         std::equal(end.begin(), end.end(), text.end() - std::ptrdiff_t(end.size()),
                    [](char a, char b) { return a == char(std::tolower(static_cast<unsigned char>(b))); });
}

}  // namespace

Format format_of(const std::string& path) {
  if (path == "-" || ends_with(path, ".png")) return Format::png;
  if (ends_with(path, ".pdf")) return Format::pdf;
  if (ends_with(path, ".svg")) return Format::svg;
  throw Error("found '" + path + "', expected a name that ends with .png, .pdf or .svg", ErrorKind::usage);
}

double Page::text_pt() const { return std::clamp(5.4 + width_pt / 126, 6.5, 9.0); }

Page page_of(Format format, const PageSettings& settings) {
  in_place("--title", [&] { check_text(settings.title); });
  Page page;
  page.format = format;
  page.title = settings.title;
  page.history = legible(settings.history);
  page.dpi = settings.dpi.value_or(format == Format::png ? 150 : 300);
  if (!(page.dpi >= 20 && page.dpi <= 2400))
    throw Error("--dpi: found " + shown(page.dpi) + ", expected 20 to 2400", ErrorKind::usage);
  page.width_pt = 16 * points_per_cm;
  if (settings.size.empty()) return page;
  in_place("--size", [&] {
    const std::string& text = settings.size;
    const bool cm = ends_with(text, "cm");
    if (!cm && !ends_with(text, "px"))
      throw Error("found '" + text + "', expected WIDTHxHEIGHT with cm or px behind it", ErrorKind::usage);
    const auto size = parse_size<2>(text.substr(0, text.size() - 2));
    const double points = cm ? points_per_cm : 72 / page.dpi;
    page.width_pt = size[0] * points;
    page.height_pt = size[1] * points;
    if (page.width_pt < 3.99 * points_per_cm || page.height_pt < 2.99 * points_per_cm)
      throw Error(
          "found " + text + (cm ? "" : " at " + shown(page.dpi) + " dpi") + ", expected at least 4x3cm",
          ErrorKind::usage);
  });
  check_size(page);
  return page;
}

Page with_history(Page page, const std::string& of_input) {
  std::string history;
  for (const auto& line : split(of_input, '\n')) {
    if (!line.empty()) history += legible(line) + "\n";
  }
  page.history = history + page.history;
  return page;
}

void check_size(const Page& page) {
  if (std::max(page.width_pt, page.height_pt) * page.scale() > largest_px)
    throw Error("the picture would be " + std::to_string(std::lround(page.width_pt * page.scale())) + " x " +
                    std::to_string(std::lround(page.height_pt * page.scale())) +
                    " pixels, expected at most 20000 along each side",
                ErrorKind::usage);
}

}  // namespace slipwave::plot
