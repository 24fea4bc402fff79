// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "grid/slice.hpp"
#include "plot/panel.hpp"
#include "plot/picture.hpp"

namespace slipwave::plot {

/// A volume on one plane: axes, title and colour bar, and what draws the data within the panel.
struct SlicePanel {
  Slice plane;
  PanelSpec spec;
  std::function<void(Canvas&, const Panel&)> draw;
};

/// "y = 500 m"
std::string name_of(const Slice& plane);

/// Three planes across x, y and z, in this order, on one scale: the level one above, the others below it,
/// where each cuts the others a dashed line, one colour bar. `page.height_pt` 0: as high as that needs. A
/// volume so flat or narrow that a panel would be below 1.6 cm is stretched there.
Picture draw_three_slices(std::array<SlicePanel, 3> slices, const std::vector<LegendEntry>& legend,
                          Page page);

}  // namespace slipwave::plot
