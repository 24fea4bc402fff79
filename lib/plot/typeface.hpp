// SPDX-License-Identifier: BSD-3-Clause
#pragma once

struct _cairo;  // NOLINT(bugprone-reserved-identifier): the library calls it so

namespace slipwave::plot {

/// Sets the typeface of all pictures, DejaVu Sans, with everything by which machines differ (hinting,
/// subpixels) switched off.
void use_typeface(_cairo* drawing, double size_pt, bool bold);

}  // namespace slipwave::plot
