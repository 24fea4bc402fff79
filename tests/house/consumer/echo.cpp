// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geology/layers.hpp"
#include "scene/scene.hpp"
#include "solver/simulation.hpp"

// A shot in water above rock: prints by how much, in s, the echo of the sea floor comes behind the direct
// wave.
int main() {
  using namespace slipwave;
  Scene<2> scene;
  scene.model.medium = layered_medium<2>(grid_of_size<2>({1000, 400}, 5),
                                         {Layer(0, 1500, 0, 1000), Layer(300, 3000, 1600, 2300)});
  scene.survey.sources = {{{500, 50}, Explosion{}, parse_wavelet("ricker:30"), 1.0}};
  scene.survey.receivers_m = {{500, 150}};
  for (int axis = 0; axis < 2; ++axis) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.recording.components = {Component::p};
  scene.recording.duration_s = 0.5;
  scene.recording.interval_s = 0.001;
  check(scene);
  const auto samples = shoot(scene, 1).traces.at(0).samples;
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto between = samples.begin() + 200;
  const auto direct = std::max_element(samples.begin(), between, smaller);
  const auto echo = std::max_element(between, samples.end(), smaller);
  std::printf("%.3f\n", double(echo - direct) * scene.recording.interval_s);
}
