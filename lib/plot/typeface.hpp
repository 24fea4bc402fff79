// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

struct _cairo;  // NOLINT(bugprone-reserved-identifier): the library calls it so

namespace slipwave::plot {

/// The typeface of all pictures; scripts that it lacks take another one of the system.
inline constexpr const char* typeface_name = "DejaVu Sans";

/// Throws std::bad_alloc where there is little memory left: cairo, Pango and the font libraries under them do
/// not always look whether they got any, and crash.
void expect_room();

/// Draws a line of text in it from the current point on along the baseline, with everything by which machines
/// differ (hinting, subpixels) switched off.
void draw_text(_cairo* drawing, const std::string& text, double size_pt, bool bold);

}  // namespace slipwave::plot
