// SPDX-License-Identifier: BSD-3-Clause
#include "planning/computed_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "acquisition/fibre.hpp"
#include "base/instantiate.hpp"
#include "base/last_found.hpp"
#include "grid/locate.hpp"
#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "scene/gauges.hpp"
#include "scene/splitting.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/record/recorder.hpp"

namespace slipwave {
namespace {

/// Cells of the coarse grid along its longest side, at most.
template <int D>
constexpr std::int64_t finest = D == 2 ? 128 : 48;
/// The head start is how far numbers that are not zero are ahead of waves: by head_start n/(n + half) cells
/// when these have gone over n cells (measured: ComputedShare.IsAsExpected, CubeComputedShare.IsAsExpected).
/// In 3-D waves weaken faster.
template <int D>
constexpr double head_start = D == 2 ? 65 : 60;
template <int D>
constexpr double half = D == 2 ? 24 : 40;

/// The share of the waves' time to a place that many cells away after which it is no longer zero.
template <int D>
double part_of_arrival(double cells) {
  const double rest = cells - head_start<D> - half<D>;
  return cells > 0 ? (rest + std::sqrt(rest * rest + 4 * cells * half<D>)) / 2 / cells : 0;
}

/// First arrivals by fast sweeping (Zhao 2005, first order) on blocks of cells, s from the source on. In a
/// fitted grid places are row coordinates, and blocks along z as high as their rows on the whole.
template <int D>
class Arrivals {
 public:
  /// On the computed grid: the medium of its zones is that of the model's cells beside them.
  Arrivals(const Medium<D>& medium, const Grid<D>& grid) {
    blocks_.origin_m = grid.origin_m;
    const auto longest = *std::max_element(grid.shape.begin(), grid.shape.end());
    const std::int64_t block = (longest + finest<D> - 1) / finest<D>;
    blocks_.spacing_m = double(block) * grid.spacing_m;
    for (std::size_t axis = 0; axis < D; ++axis) blocks_.shape[axis] = (grid.shape[axis] + block - 1) / block;
    slowness_.assign(std::size_t(blocks_.size()), infinity);
    // The mean of its cells, over their width.
    heights_.assign(slowness_.size(), 0);
    std::vector<int> rows(slowness_.size(), 0);
    LastFound<Material, double> fastest;  // a search over all directions
    Index<D> zone{};
    for (std::size_t axis = 0; axis < D; ++axis)
      zone[axis] = std::llround((medium.grid().origin_m[axis] - grid.origin_m[axis]) / grid.spacing_m);
    const bool plain = !has_elastic_options(medium);
    const std::int64_t nx = grid.shape[0];
    Index<D> at{}, in_model{};
    std::int64_t of_blocks = 0, of_model = 0;  // the first of a line
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const auto x = n % nx;
      if (x == 0) {
        at = in_model = grid.index(n);
        for (std::size_t axis = 0; axis < D; ++axis) {
          in_model[axis] = std::clamp<std::int64_t>(at[axis] - zone[axis], 0, medium.grid().shape[axis] - 1);
          at[axis] /= block;
        }
        of_blocks = blocks_.flat(at), of_model = medium.grid().flat(in_model);
      }
      in_model[0] = std::clamp<std::int64_t>(x - zone[0], 0, medium.grid().shape[0] - 1);
      const auto cell = std::size_t(of_model + in_model[0]);
      if (medium.is_void(cell)) continue;
      const auto number = std::size_t(of_blocks + x / block);
      auto& slowest = slowness_[number];
      if (plain) {
        slowest = std::min(slowest, 1 / double(medium.vp[cell]));
      } else {
        const auto material = material_of(medium, cell);
        const bool searched = (D == 3 && material.orthorhombic) || material.constants;
        const double speed = searched ? fastest(material, fastest_p_speed<D>) : fastest_p_speed<2>(material);
        slowest = std::min(slowest, 1 / speed);
      }
      heights_[number] += medium.grid().height(in_model) / grid.spacing_m;
      ++rows[number];
    }
    for (std::size_t n = 0; n < rows.size(); ++n) heights_[n] = rows[n] > 0 ? heights_[n] / rows[n] : 1;
  }
  void start_at(const Point<D>& source) {
    time_s_.assign(slowness_.size(), infinity);
    time_s_[std::size_t(blocks_.flat(cell_of(blocks_, source)))] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (unsigned way = 0; way < 1U << D; ++way) changed |= sweep(way);
    }
  }
  const Grid<D>& blocks() const { return blocks_; }
  double at(std::int64_t block) const { return time_s_[std::size_t(block)]; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Goes over all blocks once, backwards along the axes whose bit is set.
  bool sweep(unsigned way) {
    bool changed = false;
    for (std::int64_t n = 0; n < blocks_.size(); ++n) {
      auto at = blocks_.index(n);
      for (std::size_t axis = 0; axis < D; ++axis)
        if (way >> axis & 1U) at[axis] = blocks_.shape[axis] - 1 - at[axis];
      changed |= improve(at);
    }
    return changed;
  }
  bool improve(const Index<D>& at) {
    const std::int64_t n = blocks_.flat(at);
    struct Neighbour {
      double time, step;
    };
    std::array<Neighbour, D> before{};  // the earlier of both along each axis, and the time across the block
    std::int64_t pitch = 1;
    for (std::size_t axis = 0; axis < D; pitch *= blocks_.shape[axis++]) {
      const double low = at[axis] > 0 ? this->at(n - pitch) : infinity;
      const double earlier =
          std::min(low, at[axis] + 1 < blocks_.shape[axis] ? this->at(n + pitch) : infinity);
      const double length = blocks_.spacing_m * (axis == D - 1 ? heights_[std::size_t(n)] : 1);
      before[axis] = {earlier, slowness_[std::size_t(n)] * length};
    }
    std::sort(before.begin(), before.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.time < b.time; });
    double& time = time_s_[std::size_t(n)];
    if (!(before[0].time < time)) return false;
    // A plane wave that comes to as many of the neighbours as are there before it is here:
    // sum ((arrival - time)/step)^2 = 1.
    double arrival = infinity, weights = 0, sum = 0, squares = 0;
    for (std::size_t count = 0; count < D && before[count].time < arrival; ++count) {
      const double late = before[count].time - before[0].time, weight = std::pow(before[count].step, -2);
      weights += weight;
      sum += weight * late;
      squares += weight * late * late;
      arrival = before[0].time + (sum + std::sqrt(sum * sum - weights * (squares - 1))) / weights;
    }
    if (!(arrival < time * (1 - 1e-9))) return false;
    time = arrival;
    return true;
  }
  Grid<D> blocks_;
  std::vector<double> slowness_, heights_, time_s_;
};

/// The row coordinates that the receivers of a shot lie between.
template <int D>
struct Between {
  Point<D> low, high;
};

template <int D>
Between<D> receivers_between(const Scene<D>& scene, std::size_t shot) {
  Between<D> between;
  between.low.fill(std::numeric_limits<double>::infinity());
  between.high.fill(-std::numeric_limits<double>::infinity());
  const auto add = [&](const Point<D>& place_m) {
    const auto receiver = scene.model.grid().row_coordinates(place_m);
    for (std::size_t axis = 0; axis < D; ++axis) {
      between.low[axis] = std::min(between.low[axis], receiver[axis]);
      between.high[axis] = std::max(between.high[axis], receiver[axis]);
    }
  };
  for (const auto& one : scene.survey.receivers_of(shot)) add(one.point_m);
  if (scene.recording.fibre)
    for (const auto& gauge : gauges_of(scene, shot))
      for (const auto& point : gauge) add(point.at_m);
  return between;
}

/// Steps from the receivers to a place along an axis: as many cells each as the stencils of its sweeps reach.
template <int D>
double steps_to(const Scene<D>& scene, const Between<D>& receivers, std::size_t axis, double place_m) {
  const double low = receivers.low[axis], high = receivers.high[axis];
  double sweeps = 0;
  for (const auto& part : splitting(D, scene.numerics.time_order)) sweeps += std::size_t(part.axis) == axis;
  const double distance_m = std::max({low - place_m, place_m - high, 0.});
  const double reach = reach_of(scene.numerics.order) + 1;
  return distance_m / scene.model.grid().spacing_m / (sweeps * reach);
}

constexpr std::size_t most_shots = 100;

/// What is computed of a shot whose waves arrive so.
template <int D>
double share_of(const Scene<D>& scene, std::size_t shot, const Arrivals<D>& arrivals) {
  const auto& source = scene.survey.sources[shot - 1];
  const auto receivers = receivers_between(scene, shot);
  const double dt_s = time_step_s(scene);
  const double end_s = dt_s * double(solver::Recorder<D, float>::steps_needed(scene.recording, dt_s));
  const auto& blocks = arrivals.blocks();
  const auto source_at = scene.model.grid().row_coordinates(source.position_m);
  // In 2-D a cell is computed or not, in 3-D a line along x as a whole.
  const std::int64_t together = D == 2 ? 1 : blocks.shape[0];
  double reached = 0;
  for (std::int64_t first = 0; first < blocks.size(); first += together) {
    double from_s = std::numeric_limits<double>::infinity(), unseen_s = 0;
    for (std::int64_t n = first; n < first + together; ++n) {
      const auto at = blocks.index(n);
      double square = 0;
      for (int axis = 0; axis < D; ++axis) {
        const double place_m = blocks.centre(axis, at[std::size_t(axis)]);
        square += std::pow(place_m - source_at[std::size_t(axis)], 2);
        if ((D == 2 || axis > 0) && !scene.snapshot_every_s)
          unseen_s = std::max(unseen_s, dt_s * steps_to(scene, receivers, std::size_t(axis), place_m));
      }
      const double cells = std::sqrt(square) / scene.model.grid().spacing_m;
      from_s = std::min(from_s, part_of_arrival<D>(cells) * arrivals.at(n));
    }
    reached += double(together) * std::max(0., 1 - (from_s + unseen_s) / end_s);
  }
  return reached / double(blocks.size());
}

}  // namespace

template <int D>
double expected_share(const Scene<D>& scene, const Grid<D>& computed) {
  Arrivals<D> arrivals(scene.model.medium, computed);
  // Of a long survey some shots stand for all.
  const std::size_t shots = scene.survey.sources.size(), stride = (shots + most_shots - 1) / most_shots;
  double share = 0, seen = 0;
  for (std::size_t shot = 1 + stride / 2; shot <= shots; shot += stride, ++seen) {
    const auto of_shot = scene.survey.sources_of(shot);
    if (!point_injection(*of_shot.front()) || of_shot.size() > 1 || scene.numerics.double_precision) {
      share += 1;
      continue;
    }
    arrivals.start_at(scene.model.grid().row_coordinates(of_shot.front()->position_m));
    share += share_of(scene, shot, arrivals);
  }
  return share / seen;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, expected_share);

}  // namespace slipwave
