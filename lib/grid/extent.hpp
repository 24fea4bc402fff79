// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/parse.hpp"
#include "grid/grid.hpp"

namespace slipwave {

/// The box of a grid: of a fitted one from its highest to its deepest corner.
template <int D>
Box<D> box_of_grid(const Grid<D>& grid);

/// "x=0..1400 z=0..1000": a box in metres as messages show it.
template <int D>
std::string shown_box(const Box<D>& box);

}  // namespace slipwave
