// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "cube_shot.hpp"
#include "stack_scene.hpp"

namespace slipwave::solver {

/// A scene whose traces are known in closed form.
template <int D>
struct ClosedForm {
  std::string name;
  bool quick = false;  // some seconds
  std::function<Scene<D>()> scene;
  std::function<std::vector<Gather>()> exact;
};

inline ClosedForm<2> closed_form(StackScene stack, bool quick = false) {
  return {stack.name, quick, [stack] { return stack.scene(); }, [stack] { return stack.exact(); }};
}

/// Receivers at equal distances along a line across or along the layers.
inline std::vector<LayerStack::Receiver> along_layers(double from, double to, double step, double b) {
  std::vector<LayerStack::Receiver> line;
  for (double a = from; a <= to; a += step) line.push_back({a, b});
  return line;
}

/// One of each kind that the program knows.
inline std::vector<ClosedForm<2>> closed_forms() {
  static constexpr Rock rock{3000, 1700, 2200}, hard{4500, 2250, 2500}, soft{2000, 1000, 2000},
      water{1500, 0, 1000};
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto with = [](StackScene stack, const auto& change) {
    change(stack);
    return stack;
  };
  StackScene space{"full space, force", {hard}};
  space.force = Point<2>{0, 1};
  space.receivers = {{0, 300}, {200, 250}, {320, 0}, {250, -200}};
  space.spacing_m = 10;
  StackScene floor{"sea floor, level, fitted", {water, rock}, {0}};
  floor.source_b = -60;
  floor.receivers = along_layers(-250, 250, 100, -90);
  floor.spacing_m = 6;
  floor.shift = 0.4;
  for (const auto& at : along_layers(-200, 200, 100, 60)) floor.receivers.push_back(at);
  StackScene ground{"ground, level, hammer", {rock}, {0}, true};
  ground.source_b = 4;
  ground.force = Point<2>{0, 1};
  ground.receivers = along_layers(60, 260, 40, 8);
  ground.spacing_m = 5;
  StackScene upright{"upright free surface beside void", {rock}, {0}, true, 90};
  upright.source_b = 60;
  upright.receivers = along_layers(-200, 200, 80, 25);
  upright.spacing_m = 5;
  const auto near_floor = with(floor, [](StackScene& s) {
    s.name = "receivers 2 m below a floor of 15 degrees";
    s.dip_deg = 15;
    s.receivers = along_layers(-220, 220, 55, 2);
  });
  StackScene bed{"bed of a tenth of a wavelength", {rock, soft, hard}, {0, 13}};
  bed.source_b = -80;
  bed.receivers = along_layers(-200, 200, 80, -40);
  bed.spacing_m = 2.5;
  StackScene slot{"4 m of water in rock, upright", {rock, water, rock}, {0, 4}, false, 90};
  slot.source_b = -70;
  slot.force = Point<2>{1, 0};
  slot.receivers = along_layers(-150, 150, 60, 60);
  slot.spacing_m = 1;
  slot.duration_s = 0.4;
  StackScene lossy{"attenuating rock under attenuating rock", {soft, rock}, {0}};
  lossy.source_b = -100;
  lossy.receivers = along_layers(-250, 250, 100, 50);
  lossy.qualities = {{30, 20}, {80, 50}};
  lossy.spacing_m = 6;
  // At smaller Courant numbers they send back so little (theory.md (E14d)) that larger cells, in which they
  // have fewer, promise several times as much.
  StackScene grazing{"edges that waves graze, Courant number 1", {hard}};
  grazing.cfl = 1;
  grazing.receivers = along_layers(400, 1600, 200, 0);
  grazing.margin_m = 80;
  grazing.spacing_m = 10;
  grazing.duration_s = 0.7;
  return {
      closed_form(space, true),
      closed_form(with(space,
                       [](StackScene& s) {
                         s.name = "full space, explosion, order 7, near field";
                         s.spacing_m = 5;
                         s.force.reset();
                         s.order = 7;
                         s.receivers.push_back({30, 25});
                       })),
      closed_form(with(space,
                       [](StackScene& s) {
                         s.name = "full space, order 11 and 4 in time";
                         s.order = 11;
                         s.time_order = 4;
                         s.cfl = 1.9;
                         s.spacing_m = 12;
                       })),
      closed_form(floor, true),
      closed_form(with(floor,
                       [](StackScene& s) {
                         s.name = "sea floor, level, means";
                         s.spacing_m = 3;
                         s.fitted = false;
                       })),
      closed_form(with(floor,
                       [](StackScene& s) {
                         s.name = "sea floor of 20 degrees, fitted";
                         s.dip_deg = 20;
                       })),
      closed_form(near_floor),
      closed_form(with(near_floor,
                       [](StackScene& s) {
                         s.name = "the same, 30 degrees";
                         s.spacing_m = 3;
                         s.dip_deg = 30;
                       })),
      closed_form(with(floor,
                       [](StackScene& s) {
                         s.name = "receivers on an interface of rocks";
                         s.spacing_m = 3;
                         s.rocks = {soft, hard};
                         s.shift = 0;
                         s.fitted = false;
                         s.receivers = along_layers(-220, 220, 55, 0);
                       })),
      closed_form(ground, true),
      closed_form(with(ground,
                       [](StackScene& s) {
                         s.name = "ground that dips by 15 degrees, fitted";
                         s.dip_deg = 15;
                         s.source_b = 50;
                         s.receivers = along_layers(60, 260, 40, 60);
                       })),
      closed_form(with(ground,
                       [](StackScene& s) {
                         s.name = "ground roll, 10 m of 400/220 over rock";
                         s.rocks = {{400, 220, 1700}, {2000, 1000, 2000}};
                         s.faces_m = {0, 10};
                         s.spacing_m = 0.5;
                         s.peak_hz = 20;
                         s.source_b = 1.5;
                         s.margin_m = 25;
                         s.receivers = along_layers(20, 80, 20, 0.75);
                         s.duration_s = 0.5;
                       })),
      closed_form(upright),
      closed_form(with(upright,
                       [](StackScene& s) {
                         s.name = "upright free edge of the model";
                         s.ends = true;
                       })),
      closed_form(slot),
      closed_form(bed),
      closed_form(with(bed,
                       [](StackScene& s) {
                         s.name = "the same, means";
                         s.fitted = false;
                         s.shift = 0.3;
                       })),
      closed_form(lossy),
      closed_form(with(lossy,
                       [](StackScene& s) {
                         s.name = "water over attenuating rock";
                         s.rocks = {water, soft};
                         s.qualities = {{none, none}, {30, 20}};
                       })),
      closed_form(grazing),
      closed_form(with(ground,
                       [](StackScene& s) {
                         s.name = "shallow water over rock under a free surface";
                         s.rocks = {water, rock};
                         s.faces_m = {0, 45};
                         s.force.reset();
                         s.source_b = 10;
                         s.shift = 0;
                       })),
  };
}

/// The same in 3-D: an explosion in water, on mirrors that make it the whole space.
inline std::vector<ClosedForm<3>> closed_forms_in_3d() {
  static constexpr Rock water{1500, 0, 1000};
  static constexpr double interval_s = 0.001, h = 5;
  static const Point<3> receivers[] = {{120, 90, 150}, {40, 30, 190}, {200, 100, 60}, {160, 10, 5}};
  const auto scene = [] {
    auto edges = edges_all_3d(EdgeLaw::mirror);
    for (int axis = 0; axis < 3; ++axis) edges[axis][1] = EdgeLaw::absorbing;
    const auto n = std::int64_t(220 / h);
    auto made = scene_of(uniform_cube({n, n, n}, h, water), edges, {0, 0, 0}, "explosion", "ricker:30",
                         {std::begin(receivers), std::end(receivers)},
                         {Component::vx, Component::vy, Component::vz}, 0.25, interval_s);
    check(made);
    return made;
  };
  const auto exact = [] {
    const RickerForm wavelet{30};
    Gather gather;
    gather.axis = {251, interval_s, 0};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const auto& r : receivers) {
        Trace trace;
        trace.header.component = std::array{Component::vx, Component::vy, Component::vz}[axis];
        const double distance = std::hypot(r[0], r[1], r[2]);
        for (std::int64_t n = 0; n < gather.axis.count; ++n) {
          const double delayed = double(n) * interval_s - distance / water.vp;
          // Eight images make one source.
          trace.samples.push_back(
              8 * 1e9 * r[axis] / distance / (4 * std::numbers::pi * water.rho * water.vp * water.vp) *
              (wavelet(delayed) / (distance * distance) + wavelet.slope(delayed) / (water.vp * distance)));
        }
        gather.traces.push_back(std::move(trace));
      }
    return std::vector<Gather>{gather};
  };
  return {{"in 3-D, an explosion in water", true, scene, exact}};
}

/// Of scenes drawn: another where the environment says so.
inline std::uint64_t first_seed() {
  const char* seed = std::getenv("SLIPWAVE_SEED");
  return seed ? std::strtoull(seed, nullptr, 10) : 20261126;
}

}  // namespace slipwave::solver
