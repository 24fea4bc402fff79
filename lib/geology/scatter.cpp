// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/frame.hpp"
#include "geology/noise.hpp"
#include "geology/region.hpp"
#include "grid/tensor.hpp"

namespace slipwave {
namespace {

/// Slabs, sorted into strips of x so that a point is held against few of them.
template <int D>
class Slabs {
 public:
  Slabs(std::vector<Frame<D>> slabs, const Box<D>& bounds)
      : slabs_(std::move(slabs)), low_m_(bounds.low_m[0]) {
    double width = 0;
    for (const auto& slab : slabs_) width += slab.slab_bounds().high_m[0] - slab.slab_bounds().low_m[0];
    strip_m_ = width / double(slabs_.size());
    const double length = bounds.high_m[0] - low_m_;
    strips_.resize(std::size_t(std::clamp(length / strip_m_, 1., 1e5)) + 1);
    strip_m_ = std::max(strip_m_, length / double(strips_.size() - 1));
    for (std::size_t n = 0; n < slabs_.size(); ++n) {
      const auto box = slabs_[n].slab_bounds();
      for (std::size_t k = strip(box.low_m[0]); k <= strip(box.high_m[0]); ++k) strips_[k].push_back(n);
    }
  }
  bool contain(const Point<D>& at) const {
    const auto& near = strips_[strip(at[0])];
    return contain(near, at);
  }
  /// Whether any of these does.
  bool contain(const std::vector<std::size_t>& some, const Point<D>& at) const {
    return std::any_of(some.begin(), some.end(), [&](std::size_t n) { return slabs_[n].in_slab(at); });
  }
  /// Returns the slabs that may reach into a box.
  std::vector<std::size_t> beside(const Box<D>& box) const {
    Point<D> middle{}, half{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      middle[axis] = (box.low_m[axis] + box.high_m[axis]) / 2;
      half[axis] = (box.high_m[axis] - box.low_m[axis]) / 2;
    }
    const double reach = length<D, double>(half);
    std::vector<std::size_t> found;
    for (std::size_t k = strip(box.low_m[0]); k <= strip(box.high_m[0]); ++k)
      for (const auto n : strips_[k]) {
        const auto local = slabs_[n].seen(middle);
        bool near = true;
        for (std::size_t axis = 0; axis < D; ++axis)
          near = near && std::abs(local[axis]) <= slabs_[n].size_m[axis] / 2 + reach;
        if (near && std::find(found.begin(), found.end(), n) == found.end()) found.push_back(n);
      }
    return found;
  }

 private:
  std::size_t strip(double x_m) const {
    return std::size_t(std::clamp((x_m - low_m_) / strip_m_, 0., double(strips_.size() - 1)));
  }

  std::vector<Frame<D>> slabs_;
  double low_m_ = 0, strip_m_ = 1;
  std::vector<std::vector<std::size_t>> strips_;
};

}  // namespace

template <int D>
RegionIn<D> scattered_in(const RegionIn<D>& region, const Scatter& scatter) {
  if (scatter.count < 1) {
    throw Error("found a count of " + std::to_string(scatter.count) + ", expected at least 1",
                ErrorKind::usage);
  }
  if (!(scatter.length_m > 0 && scatter.thickness_m > 0)) {
    throw Error("found slabs of " + shown(scatter.length_m) + " by " + shown(scatter.thickness_m) +
                    " m, expected both above zero",
                ErrorKind::usage);
  }
  const auto& low = region.bounds.low_m;
  const auto& high = region.bounds.high_m;
  std::vector<Frame<D>> slabs;
  constexpr std::int64_t numbers_a_try = D + 2;
  constexpr std::int64_t tries_a_slab = 10000;
  // Each try draws numbers of its own, so that a slab does not depend on how many there are.
  for (std::int64_t n = 0; slabs.size() < std::size_t(scatter.count); n += numbers_a_try) {
    if (n / numbers_a_try > tries_a_slab * (std::int64_t(slabs.size()) + 1)) {
      throw Error("found no place for a slab in the region, expected it to fill more of its bounds");
    }
    Point<D> centre{}, size_m{};
    for (std::size_t axis = 0; axis < D; ++axis)
      centre[axis] = uniform(scatter.seed, n + std::int64_t(axis), low[axis], high[axis]);
    if (!region.contains(centre)) continue;
    size_m.fill(scatter.length_m * uniform(scatter.seed, n + D, 0.5, 1.5));
    size_m.back() = scatter.thickness_m * uniform(scatter.seed, n + D + 1, 0.5, 1.5);
    slabs.emplace_back(centre, size_m, scatter.dip_deg, scatter.azimuth_deg);
  }
  const Slabs<D> all(std::move(slabs), region.bounds);
  // Only cells that a slab may reach into are sampled, for those alone.
  const auto share = [whole = region.contains, all](const Box<D>& cell) {
    const auto near = all.beside(cell);
    const auto contains = [&](const Point<D>& at) { return whole(at) && all.contain(near, at); };
    return near.empty() ? 0. : share_within<D>({cell, contains}, cell);
  };
  return {region.bounds,
          [whole = region.contains, all](const Point<D>& at) { return whole(at) && all.contain(at); }, share};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, scattered_in);

}  // namespace slipwave
