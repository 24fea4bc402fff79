// SPDX-License-Identifier: BSD-3-Clause
#include "scene/empty_gather.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "grid/locate.hpp"

namespace slipwave {
namespace {

template <int D>
std::array<double, 3> in_3d(const Point<D>& point) {
  if constexpr (D == 2)
    return {point[0], 0, point[1]};
  else
    return point;
}

/// Depths of the fluid above the first rock below these points of the model, m; 0 where the column begins
/// with rock. Collective.
template <int D>
std::vector<double> water_depths_m(const Medium<D>& medium, const Subdomain& part,
                                   const std::vector<Point<D>>& points_m, Ranks* ranks) {
  const auto& grid = medium.grid();
  // Of each point: cells of fluid down to the first rock, and whether there is one.
  std::vector<std::int64_t> found;
  for (const auto& point : points_m) {
    Index<D> at = cell_of(grid, point);
    std::int64_t fluid = 0, rock = 0;
    for (at[D - 1] = 0; at[D - 1] < grid.shape[D - 1] && rock == 0; ++at[D - 1]) {
      const auto cell = std::size_t(grid.flat(at));
      if (!part.owns(grid, at[D - 1])) continue;
      if (medium.is_solid(cell)) rock = 1;
      fluid += medium.is_fluid(cell);
    }
    found.insert(found.end(), {fluid, rock});
  }
  found = allgather(ranks, found);
  std::vector<double> depths;
  for (std::size_t n = 0; n < points_m.size(); ++n) {
    std::int64_t fluid = 0;
    bool rock = false;
    for (auto of_part = 2 * n; of_part < found.size() && !rock; of_part += 2 * points_m.size()) {
      fluid += found[of_part];
      rock = found[of_part + 1] != 0;
    }
    if (!grid.rows) {
      depths.push_back(double(fluid) * grid.spacing_m);
      continue;
    }
    auto at = grid.in_cells(points_m[n]);
    at[D - 1] = 0;
    const double surface = grid.rows->depth(at);
    at[D - 1] = double(fluid);
    depths.push_back(fluid == 0 ? 0 : grid.rows->depth(at) - surface);
  }
  return depths;
}

}  // namespace

template <int D>
Gather empty_gather(const Scene<D>& scene, std::size_t shot, Ranks* ranks) {
  const auto& source = scene.survey.sources[shot - 1];
  Gather gather;
  gather.axis = {scene.recording.samples(), scene.recording.interval_s, 0};
  TraceHeader header;
  header.shot = scene.survey.number_of(shot);
  header.source_m =
      scene.survey.spreads ? scene.survey.spreads->map_source_of(shot) : in_3d<D>(source.position_m);
  const auto receivers = scene.survey.receivers_of(shot);
  std::vector<Point<D>> points = {source.position_m};
  for (const auto& receiver : receivers) points.push_back(receiver.point_m);
  const auto depths = water_depths_m(scene.model.medium, scene.subdomain, points, ranks);
  header.water_depth_source_m = depths.front();
  for (const Component component : scene.recording.components) {
    header.component = component;
    for (std::size_t n = 0; n < receivers.size(); ++n) {
      header.channel = receivers[n].channel;
      header.bin = receivers[n].bin;
      header.receiver_m = receivers[n].map_m;
      header.water_depth_receiver_m = depths[n + 1];
      gather.traces.push_back({header, {}});
      gather.traces.back().samples.reserve(std::size_t(gather.axis.count));
    }
  }
  return gather;
}

Gather in_record(Gather gather, const Recording& recording) {
  const auto before = recording.samples_before();
  if (before == 0) return gather;
  gather.axis.count -= before;
  for (auto& trace : gather.traces) {
    const auto gone = std::min(trace.samples.size(), std::size_t(before));
    trace.samples.erase(trace.samples.begin(), trace.samples.begin() + std::ptrdiff_t(gone));
  }
  return gather;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, empty_gather);

}  // namespace slipwave
