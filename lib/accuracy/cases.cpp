// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/cases.hpp"

#include <cmath>
#include <numbers>

#include "accuracy/full_space.hpp"

namespace slipwave {
namespace {

constexpr UniformMedium rock{4500, 2250, 2500};
constexpr double side_m = 4980, spacing_m = 5, peak_hz = 30, duration_s = 0.76, interval_s = 0.001;
/// Lines of receivers: 10 and 20 dominant S wavelengths, 0 to 67.5 degrees from the vertical.
constexpr double distances_m[] = {750, 1500};
constexpr int azimuths = 4;

}  // namespace

Scene<2> full_space_case() {
  Scene<2> scene;
  const auto count = std::int64_t(side_m / spacing_m);
  const Grid<2> grid{{count, count}, spacing_m, {0, 0}};
  scene.model.medium = {Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)),
                        Field<2>(grid, float(rock.rho))};
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  const Point<2> centre = {side_m / 2, side_m / 2};
  scene.survey.sources = {{centre, PointForce<2>{{0, 1}}, parse_wavelet("ricker:30"), 1}};
  for (const double r : distances_m)
    for (int n = 0; n < azimuths; ++n) {
      const double angle = n * std::numbers::pi / 8;
      scene.survey.receivers_m.push_back({centre[0] + r * std::sin(angle), centre[1] + r * std::cos(angle)});
    }
  // Nothing comes back from the edges before the traces end: the shortest way by an edge has 3480 m.
  for (const int axis : {0, 1}) scene.edges[axis] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.recording = {{Component::vx, Component::vz}, duration_s, interval_s};
  return scene;
}

Gather full_space_traces() {
  const auto scene = full_space_case();
  const auto& source = scene.survey.sources.front().position_m;
  Gather gather;
  gather.axis = {scene.recording.samples(), interval_s, 0};
  for (const int row : {0, 1})
    for (const auto& receiver : scene.survey.receivers_m) {
      Trace trace;
      trace.header.component = scene.recording.components[std::size_t(row)];
      trace.header.receiver_m = {receiver[0], 0, receiver[1]};
      trace.samples = ricker_response(peak_hz, interval_s, gather.axis.count, [&](double omega) {
        return force_motion(rock, omega, receiver[0] - source[0], receiver[1] - source[1], 1);
      })[std::size_t(row)];
      gather.traces.push_back(std::move(trace));
    }
  return gather;
}

}  // namespace slipwave
