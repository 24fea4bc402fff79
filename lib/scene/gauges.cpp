// SPDX-License-Identifier: BSD-3-Clause
#include "scene/gauges.hpp"

#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
std::vector<std::vector<GaugePoint<D>>> gauges_of(const Scene<D>& scene, std::size_t shot) {
  std::vector<Point<D>> receivers;
  for (const auto& receiver : scene.survey.receivers_of(shot)) receivers.push_back(receiver.point_m);
  std::vector<std::vector<GaugePoint<D>>> gauges;
  for (std::size_t n = 0; n < receivers.size(); ++n)
    gauges.push_back(gauge_points<D>(*scene.recording.fibre, receivers, n));
  return gauges;
}

template <int D>
void each_gauge_point(const Scene<D>& scene,
                      const std::function<void(const Point<D>&, std::size_t, std::size_t)>& see) {
  const auto& fibre = *scene.recording.fibre;
  if (!fibre.along_path)
    return each_receiver<D>(scene.survey,
                            [&](const Point<D>& receiver, std::size_t shot, std::size_t number) {
                              for (const auto& point : gauge_points<D>(fibre, {&receiver, 1}, 0))
                                see(point.at_m, shot, number);
                            });
  const std::size_t shots = scene.survey.spreads ? scene.survey.sources.size() : 1;
  for (std::size_t shot = 1; shot <= shots; ++shot) {
    const auto gauges = gauges_of(scene, shot);
    for (std::size_t n = 0; n < gauges.size(); ++n)
      for (const auto& point : gauges[n]) see(point.at_m, shot, n + 1);
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, gauges_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, each_gauge_point);

}  // namespace slipwave
