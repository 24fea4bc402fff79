#include "accuracy/reached.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/splitting.hpp"
#include "solver/kernels.hpp"
#include "solver/recorder.hpp"

namespace slipwave {
namespace {

/// Cells of the coarse grid along its longer side, at most.
constexpr std::int64_t finest = 128;
/// When waves have gone over n cells, numbers that are not zero are ahead of them by head_start n/(n + half)
/// cells (measured: ComputedShare.IsAsExpected).
constexpr double head_start = 115, half = 12;

/// The share of the waves' time to a place that many cells away after which it is no longer zero.
double part_of_arrival(double cells) {
  const double rest = cells - head_start - half;
  return cells > 0 ? (rest + std::sqrt(rest * rest + 4 * cells * half)) / 2 / cells : 0;
}

/// First arrivals by fast sweeping (Zhao 2005, first order) on blocks of cells, s from the source on.
class Arrivals {
 public:
  Arrivals(const Medium<2>& medium, const Point<2>& source) {
    const auto& grid = medium.grid();
    origin_m_ = grid.origin_m;
    const auto longest = std::max(grid.shape[0], grid.shape[1]);
    const std::int64_t block = (longest + finest - 1) / finest;
    spacing_m_ = double(block) * grid.spacing_m;
    nx_ = (grid.shape[0] + block - 1) / block;
    nz_ = (grid.shape[1] + block - 1) / block;
    const auto infinity = std::numeric_limits<double>::infinity();
    slowness_.assign(std::size_t(nx_ * nz_), infinity);
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      if (medium.is_void(std::size_t(n))) continue;
      const auto at = grid.index(n);
      auto& slowest = slowness_[std::size_t(at[1] / block * nx_ + at[0] / block)];
      slowest = std::min(slowest, 1 / double(medium.vp[std::size_t(n)]));
    }
    time_s_.assign(slowness_.size(), infinity);
    const auto place = [&](int axis, std::int64_t count) {
      const double cell = (source[std::size_t(axis)] - grid.origin_m[std::size_t(axis)]) / spacing_m_;
      return std::clamp<std::int64_t>(std::int64_t(cell), 0, count - 1);
    };
    time_s_[std::size_t(place(1, nz_) * nx_ + place(0, nx_))] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (const bool down : {true, false})
        for (const bool right : {true, false})
          for (std::int64_t k = 0; k < nz_; ++k)
            for (std::int64_t i = 0; i < nx_; ++i)
              changed |= improve(right ? i : nx_ - 1 - i, down ? k : nz_ - 1 - k);
    }
  }
  std::int64_t nx() const { return nx_; }
  std::int64_t nz() const { return nz_; }
  Point<2> centre(std::int64_t i, std::int64_t k) const {
    return {origin_m_[0] + (double(i) + 0.5) * spacing_m_, origin_m_[1] + (double(k) + 0.5) * spacing_m_};
  }
  double at(std::int64_t i, std::int64_t k) const { return time_s_[std::size_t(k * nx_ + i)]; }

 private:
  double known(std::int64_t i, std::int64_t k) const {
    return i < 0 || k < 0 || i >= nx_ || k >= nz_ ? std::numeric_limits<double>::infinity() : at(i, k);
  }
  bool improve(std::int64_t i, std::int64_t k) {
    const auto cell = std::size_t(k * nx_ + i);
    const double step = slowness_[cell] * spacing_m_;
    const double a = std::min(known(i - 1, k), known(i + 1, k)),
                 b = std::min(known(i, k - 1), known(i, k + 1));
    if (!(std::min(a, b) + step < time_s_[cell])) return false;
    const double difference = std::abs(a - b);
    const double time = difference < step ? (a + b + std::sqrt(2 * step * step - difference * difference)) / 2
                                          : std::min(a, b) + step;
    if (!(time < time_s_[cell] * (1 - 1e-9))) return false;
    time_s_[cell] = time;
    return true;
  }
  std::int64_t nx_ = 0, nz_ = 0;
  double spacing_m_ = 0;
  Point<2> origin_m_{};
  std::vector<double> slowness_, time_s_;
};

}  // namespace

double expected_share(const Scene<2>& scene) {
  const auto& grid = scene.model.grid();
  const double dt_s = time_step_s(scene);
  const double end_s = dt_s * double(solver::Recorder<2, float>::steps_needed(scene.recording, dt_s));
  // Steps from the receivers to a place: as many cells each as the stencils of its sweeps reach.
  const auto way = [&](std::size_t axis, double place_m) {
    double low = std::numeric_limits<double>::infinity(), high = -low, sweeps = 0;
    for (const auto& receiver : scene.survey.receivers_m) {
      low = std::min(low, receiver[axis]);
      high = std::max(high, receiver[axis]);
    }
    for (const auto& part : splitting(2, scene.numerics.time_order)) sweeps += std::size_t(part.axis) == axis;
    const double distance_m = std::max({low - place_m, place_m - high, 0.});
    const double reach = solver::reach_of(scene.numerics.order) + 1;
    return scene.snapshot_every_s ? 0 : distance_m / grid.spacing_m / (sweeps * reach);
  };
  double share = 0;
  for (const auto& source : scene.survey.sources) {
    if (!point_injection(source) || scene.numerics.double_precision) {
      share += 1;
      continue;
    }
    const Arrivals arrivals(scene.model.medium, source.position_m);
    double reached = 0;
    for (std::int64_t k = 0; k < arrivals.nz(); ++k)
      for (std::int64_t i = 0; i < arrivals.nx(); ++i) {
        const auto centre = arrivals.centre(i, k);
        const double unseen_s = dt_s * std::max(way(0, centre[0]), way(1, centre[1]));
        const double cells =
            std::hypot(centre[0] - source.position_m[0], centre[1] - source.position_m[1]) / grid.spacing_m;
        reached += std::max(0., 1 - (part_of_arrival(cells) * arrivals.at(i, k) + unseen_s) / end_s);
      }
    share += reached / double(arrivals.nx() * arrivals.nz());
  }
  return share / double(scene.survey.sources.size());
}

}  // namespace slipwave
