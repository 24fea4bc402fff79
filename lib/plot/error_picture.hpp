// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "accuracy/table.hpp"
#include "plot/look.hpp"
#include "plot/page.hpp"
#include "plot/picture.hpp"

namespace slipwave::plot {

/// Error in percent against processor time, both on log axes: a line for each order (of space, time, slip)
/// and Courant number over the cell sizes that stand beside its points; what was predicted hollow and dashed;
/// a line at the error that was wanted; the chosen setting in a ring. Several tables stand side by side on
/// equal axes, each under its title, or with `overlay` in one panel. Throws Error when no row has both error
/// and time.
Picture draw_error(const std::vector<AccuracyTable>& tables, bool overlay, const Look& look, Page page);

}  // namespace slipwave::plot
