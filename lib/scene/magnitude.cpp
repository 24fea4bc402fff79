// SPDX-License-Identifier: BSD-3-Clause
#include "scene/magnitude.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "scene/largest_velocity.hpp"

namespace slipwave {
namespace {

template <int D>
double largest_impedance(const Medium<D>& medium) {
  double largest = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    largest = std::max(largest, double(medium.rho[cell]) * medium.vp[cell]);
  return largest;
}

}  // namespace

template <int D>
void check_magnitudes(const Scene<D>& scene, Ranks* ranks) {
  using Float = std::numeric_limits<float>;
  const auto& sources = scene.survey.sources;
  const auto weaker = [](const Source<D>& one, const Source<D>& other) {
    return std::abs(one.amplitude) < std::abs(other.amplitude);
  };
  const auto [weakest, strongest] = std::minmax_element(sources.begin(), sources.end(), weaker);
  const double impedance = largest_of(ranks, largest_impedance(scene.model.medium));
  const double least = Float::min() / Float::epsilon(), most = Float::max() / std::max(impedance, 1.);
  for (const auto& source : {weakest, strongest}) {
    const double velocity = largest_velocity(scene, std::size_t(source - sources.begin()) + 1, ranks);
    if (velocity >= least && velocity <= most) continue;
    throw Error("--amplitude: found " + shown(source->amplitude) + ", whose velocities (at most " +
                    shown(velocity, 2) + " m/s) or stresses floats hold no more; expected one that makes " +
                    shown(least, 2) + " to " + shown(most, 2) + " m/s",
                ErrorKind::usage);
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, check_magnitudes);

}  // namespace slipwave
