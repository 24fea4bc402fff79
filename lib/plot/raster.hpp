// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "plot/axis.hpp"
#include "plot/canvas.hpp"

namespace slipwave::plot {

/// Cells [first, last) that a pixel shows; empty where it lies outside.
struct Cells {
  std::int64_t first = 0, last = 0;
};

/// Which cells each of `pixels` equal pixels from begin_pt to end_pt shows: those whose middles lie in it,
/// else the one its own middle lies in. Cell n runs from edges[n] to edges[n + 1]; edges ascend.
std::vector<Cells> cells_of_pixels(const Scale& scale, double begin_pt, double end_pt, int pixels,
                                   const std::vector<double>& edges);

/// What a pixel takes where values between cells are wanted: some cells, as above, or, of one that is wider
/// than a pixel and its neighbour, the second with this share.
struct Mix {
  Cells cells;
  std::optional<double> share = {};
};
/// Returns what each of these pixels takes of cells whose values stand at `middles`.
std::vector<Mix> mixes_of_pixels(const Scale& scale, double begin_pt, double end_pt, int pixels,
                                 const std::vector<double>& edges, const std::vector<double>& middles);
/// Middles of cells between these edges.
std::vector<double> middles_of(const std::vector<double>& edges);

/// count + 1 edges of equal cells.
std::vector<double> even_edges(double low, double step, std::int64_t count);

/// Cells round ascending places, half way to their neighbours; but where a neighbour is farther than one and
/// a half times what is usual there, half the usual distance: what lies between was not recorded, and is a
/// cell without a place.
struct PlaceCells {
  static constexpr std::int64_t gap = -1;
  std::vector<double> edges;        // one more than there are cells
  std::vector<double> middles;      // the place, or the middle of a gap
  std::vector<std::int64_t> place;  // index of the place, or gap
  bool is_gap(std::int64_t cell) const { return place[std::size_t(cell)] == gap; }
};
PlaceCells cells_round(const std::vector<double>& places);

/// The distance of places to their next ones that is usual round each: the lower median of nine of them.
std::vector<double> usual_distances(const std::vector<double>& places);

/// What a pixel takes of its cells: the value farthest from zero (nothing of a wave is lost), the mean, or
/// the greatest (codes). NaN does not count.
enum class Take { extreme, mean, greatest };

/// What one pixel takes of its cells, added one by one.
class Reduction {
 public:
  explicit Reduction(Take take = Take::mean) : take_(take) {}
  void add(float value);
  /// NaN where nothing was added.
  float value() const;

 private:
  Take take_;
  float chosen_ = std::numeric_limits<float>::quiet_NaN();
  double sum_ = 0;
  std::int64_t count_ = 0;
};

/// Values of pixels, the first row first; NaN where there is none.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> values;
  float at(int column, int row) const {
    return values[std::size_t(row) * std::size_t(width) + std::size_t(column)];
  }
};

/// Reduces rows of `Value`s, row(k) being the k-th, to pixels.
template <class Value>
Raster reduced(const std::function<const Value*(std::int64_t)>& row, const std::vector<Cells>& columns,
               const std::vector<Cells>& rows, Take take);

/// What a pixel takes of values: its mix of two, where the nearer one decides whether there is a value, else
/// `take` of its cells.
float mixed(const std::function<float(std::int64_t)>& value, const Mix& mix, Take take);
/// Rows of values interpolated to pixels, linearly in both directions.
Raster interpolated(const std::function<const float*(std::int64_t)>& row, const std::vector<Mix>& columns,
                    const std::vector<Mix>& rows, Take take);

/// Pixels along a length on the page; 1 at least.
int pixels_along(double length_pt, const Page& page);

}  // namespace slipwave::plot
