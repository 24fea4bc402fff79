// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// How a field continues past the last usable cell: not known, or as its mirror image about that cell's far
/// face, with the same sign (even) or the opposite one (odd). At a free surface velocities are even and the
/// tractions on it odd.
enum class Beyond { unknown, even, odd };

/// The cells low .. high of an axis in which a field is smooth round a point: up to an interface or
/// the end of the grid.
struct AxisCells {
  std::int64_t low = 0, high = 0;
  Beyond below = Beyond::unknown, above = Beyond::unknown;
};

struct CellWeight {
  std::int64_t cell = 0;
  double weight = 0;
};

template <int D>
struct PointWeight {
  Index<D> cell{};
  double weight = 0;
};

/// Widest stencil along an axis.
inline constexpr int widest_stencil = 8;
/// Cells that sources and receivers take where they are beyond the last centre of an axis, next to an
/// interface: a parabola. Each further cell would double what the scheme leaves there of waves of two cells.
inline constexpr int widest_beyond = 3;
/// In cells: a point as near as this to a face is on it, since depths of fitted rows are found by iteration.
inline constexpr double on_face = 1e-6;
/// Whether something of the moment of a source stays behind its wavelet.
enum class Moment : std::uint8_t { passing, lasting };
/// Cells along an axis that a source is spread over smoothly, and those beside an interface, where it needs
/// as many.
constexpr int widest_spread(Moment moment) { return moment == Moment::lasting ? 24 : 14; }
inline constexpr int narrowest_spread = 8;

/// Weights for the value of a field at `position` from its values at cell centres, along one axis (theory.md
/// (A1)-(A3)). position is in cells: the centre of cell i is at i. Taken are up to `most_cells` (2 .. 8)
/// usable cells nearest to the point; weights are those that reproduce polynomials up to the third degree (as
/// far as the number of cells allows) and beyond that have the least error over all waves down to 5.7 cells a
/// wavelength. A point on a usable cell's centre gets that cell with weight 1. The same weights, divided by
/// the cell's length, spread a point source (delta function). The largest error of a wave of unit amplitude,
/// by cells per wavelength (measured in the tests):
///   cells taken                         20    10    8     6     5     4
///   4 on both sides                     7e-6  4e-5  7e-6  6e-6  1e-3  1e-2
///   8, point between cells 1 and 2      2e-5  9e-5  2e-5  2e-5  3e-3  3e-2
///   8, point between cells 0 and 1      9e-5  4e-4  1e-4  8e-5  1e-2  0.1
///   8, point beyond the last centre     9e-4  4e-3  1e-3  9e-4  0.1   1
/// position must lie in cells low .. high, faces included: low - 1/2 <= position <= high + 1/2.
std::vector<CellWeight> axis_weights(double position, const AxisCells& usable,
                                     int most_cells = widest_stencil);

/// Weights for the derivative of a field along an axis, per cell, with the same least error over waves: of
/// eight cells where there are four on both sides, of fewer, down to five, towards the last usable ones,
/// where more would magnify what alternates from cell to cell. Empty where there is but one cell. Error of
/// the derivative of a wave, relative to it, by cells per wavelength:
///   point                               20    16    10    8     6     5
///   with four cells on both sides       8e-5  1e-4  2e-4  3e-5  2e-5  3e-3
///   on the centre of the last cell      4e-3  8e-3  5e-2  0.1   0.3   0.5
///   half a cell beyond it               1e-2  3e-2  0.1   0.3   0.8   1.4
/// position as for axis_weights().
std::vector<CellWeight> axis_slopes(double position, const AxisCells& usable);

/// The weights for a value at a point in space: products of the axes' weights, at most 8^D of them. The
/// weights of a receiver as they stand; a point source of strength Q puts Q weight/h^D into each cell. Usable
/// cells are given per axis: where they differ from line to line, give those common to all.
template <int D>
std::vector<PointWeight<D>> point_weights(const Grid<D>& grid, const Point<D>& point_m,
                                          const std::array<AxisCells, std::size_t(D)>& usable,
                                          int most_cells = widest_stencil);

/// Weights that spread a point source smoothly (theory.md (A8)): over up to widest_spread() usable cells, on
/// a cell's centre too. They suppress waves shorter than three cells, which sweeps cannot hold in balance,
/// and reproduce polynomials up to the fifth degree. Where these cells do not surround the point evenly, it
/// is narrowest_spread and the third degree. The largest error of a wave of unit amplitude, by cells per
/// wavelength, and what is left of short ones (measured in the tests):
///   cells per wavelength   24    15    12    10    8     6     | 3     2.8   2.4   2
///   7 on both sides        5e-5  6e-4  2e-3  4e-3  6e-3  3e-2  | 4e-2  8e-3  7e-3  9e-3
/// Those of a moment that lasts suppress waves shorter than five cells (A8a): over 24 cells to 2 %, where
/// fewer surround the point evenly over as many as do, 14 at least.
/// position and usable cells as for axis_weights(), narrowest_spread of them or more.
std::vector<CellWeight> spread_weights(double position, const AxisCells& usable,
                                       Moment moment = Moment::passing);

/// Returns the weights that spread_weights() gives at a point in 2-D or 3-D: products of the axes' weights.
template <int D>
std::vector<PointWeight<D>> spread_point_weights(const Grid<D>& grid, const Point<D>& point_m,
                                                 const std::array<AxisCells, std::size_t(D)>& usable,
                                                 Moment moment);

/// Weights for a value between time steps: Lagrange polynomials through `count` samples number first, first +
/// 1, ...
struct TimeWeights {
  std::int64_t first = 0;
  int count = 0;
  std::array<double, 8> weights{};
};

/// Order 8 (eight samples, four on each side) where low .. high, the samples there are, allow it; nearer
/// their ends the eight are not centred, with fewer than eight samples all are taken. position is in samples,
/// low <= position <= high; on a sample that one alone has weight, 1.
TimeWeights time_weights(double position, std::int64_t low, std::int64_t high);

/// These return the weights for the derivative at `position`, per sample, and for the integral over from ..
/// to, in samples, where no sample lies between them: both of the polynomials of time_weights().
TimeWeights time_slopes(double position, std::int64_t low, std::int64_t high);
TimeWeights time_integrals(double from, double to, std::int64_t low, std::int64_t high);

}  // namespace slipwave
