// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace slipwave::plot {

enum class Format { png, pdf, svg };

/// By the ending of a path, upper or lower case; "-" is PNG. Throws a usage Error for any other ending.
Format format_of(const std::string& path);

inline constexpr double points_per_cm = 72 / 2.54;

/// What a user may say about the sheet a picture is drawn on.
struct PageSettings {
  std::string size;           // "16x10cm", "1200x800px" or empty: as the picture needs
  std::optional<double> dpi;  // pixels per inch of a PNG and of images within PDF and SVG
  std::string title;          // empty: none
  std::string history;        // the commands, kept in the file; a line each
};

/// The sheet; lengths are in points of 1/72 inch, x to the right and y down.
struct Page {
  Format format = Format::png;
  double width_pt = 0, height_pt = 0;
  double dpi = 150;
  std::string title, history;
  /// Text of axes; smaller on small sheets.
  double text_pt() const;
  /// Pixels a point.
  double scale() const { return dpi / 72; }
};

/// Reads the settings; without a size the page is 16 cm wide and `height_pt` 0, for the picture to set. dpi:
/// 150 for PNG, else 300. Throws a usage Error for what is no size, below 4 x 3 cm or above 20000 pixels.
Page page_of(Format format, const PageSettings& settings);

/// Returns the page with the history of its input before its own. Bytes that are no text become question
/// marks.
Page with_history(Page page, const std::string& of_input);

/// Throws a usage Error when the page is too large to draw.
void check_size(const Page& page);

}  // namespace slipwave::plot
