// SPDX-License-Identifier: BSD-3-Clause
#include "scene/timing.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

/// Returns when a wavelet of samples begins, in s: before its first sample other than 0 nothing is radiated.
double onset_s(const Wavelet& wavelet) {
  const auto* sampled = std::get_if<shape::Sampled>(&wavelet.shape());
  if (!sampled) return 0;
  const auto& values = sampled->values();
  const auto first = std::find_if(values.begin(), values.end(), [](double value) { return value != 0; });
  const auto before = std::max<std::ptrdiff_t>(0, first - values.begin() - 1);
  return sampled->times_s()[std::size_t(before)];
}

/// How many traces of the survey no wave can reach by the end of the record, and when the last could be.
struct Unreached {
  std::int64_t traces = 0, of = 0;
  double needed_s = 0;
};

template <int D>
Unreached unreached_traces(const Scene<D>& scene) {
  const double fastest = fastest_speed(scene.model.medium, scene.subdomain);
  Unreached unreached;
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot) {
    const auto sources = scene.survey.sources_of(shot);
    const bool plane = std::holds_alternative<PlaneWave<D>>(sources.front()->mechanism);
    for (const auto& receiver : scene.survey.receivers_of(shot)) {
      ++unreached.of;
      if (plane) continue;
      double earliest_s = std::numeric_limits<double>::infinity();
      for (const auto* source : sources) {
        const double away_m = distance_m<D>(receiver.point_m, source->position_m);
        earliest_s = std::min(earliest_s, source->delay_s + onset_s(source->wavelet) + away_m / fastest);
      }
      if (earliest_s <= scene.recording.duration_s) continue;
      ++unreached.traces;
      unreached.needed_s = std::max(unreached.needed_s, earliest_s);
    }
  }
  return unreached;
}

}  // namespace

template <int D>
std::vector<std::string> timing_warnings(const Scene<D>& scene) {
  const auto unreached = unreached_traces(scene);
  if (unreached.traces == 0) return {};
  return {"no wave can have reached " + std::to_string(unreached.traces) + " of " +
          std::to_string(unreached.of) + " receivers by the end of the record (--time " +
          shown(scene.recording.duration_s - scene.recording.before_s, 9) +
          "); the farthest needs at least " + shown(unreached.needed_s - scene.recording.before_s, 3) + " s"};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, timing_warnings);

}  // namespace slipwave
