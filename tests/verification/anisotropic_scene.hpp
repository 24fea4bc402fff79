// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "anisotropic_rocks.hpp"
#include "anisotropic_stack.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {

constexpr double peak_hz = 20;

inline AnisotropicStack::Layer layer_of(const Material& material) {
  return {elasticity_of<2>(material), material.rho};
}

/// The stiffness of rock that attenuates, by frequency: c11 and c33 as Qp says, c55 as Qs, and c13 between
/// both (theory.md (Q9)), turned with its beds. Speeds hold at the peak.
inline std::function<AnisotropicStack::ComplexPlane(Complex omega)> relaxed(const Material& rock,
                                                                            const Qualities& quality) {
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto p = standard_linear(mechanisms, quality.p, peak_hz),
             s = standard_linear(mechanisms, quality.s, peak_hz);
  const auto about_axis = upright_elasticity<2>(rock);
  const double dip = rock.tilt * std::numbers::pi / 180;
  return [=](Complex omega) -> AnisotropicStack::ComplexPlane {
    const auto hz = omega / (2 * std::numbers::pi);
    const double along = std::sqrt(about_axis(1, 1) / about_axis(3, 3)),
                 twice_shear = about_axis(3, 3) - about_axis(1, 3) / along;
    const Complex of_p = p(hz), of_s = s(hz), c11 = about_axis(1, 1) * of_p, c33 = about_axis(3, 3) * of_p,
                  c55 = about_axis(5, 5) * of_s, c13 = along * (c33 - twice_shear * of_s);
    // By Bond's rule, with stresses along and across the beds.
    const double c = std::cos(dip), sn = std::sin(dip);
    const std::array<std::array<double, 3>, 3> to_beds = {
        {{c * c, sn * sn, c * sn}, {sn * sn, c * c, -c * sn}, {-2 * c * sn, 2 * c * sn, c * c - sn * sn}}};
    const std::array<std::array<Complex, 3>, 3> of_beds = {{{c11, c13, 0}, {c13, c33, 0}, {0, 0, c55}}};
    std::array<std::array<Complex, 3>, 3> turned{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t m = 0; m < 3; ++m)
          for (std::size_t n = 0; n < 3; ++n) turned[a][b] += to_beds[m][a] * of_beds[m][n] * to_beds[n][b];
    return {turned[0][0], turned[0][1], turned[0][2], turned[1][1], turned[1][2], turned[2][2]};
  };
}

/// Flat layers in a box that absorbs, or has a free surface; the short form is a smaller one.
struct Stack {
  std::vector<Material> layers;
  std::vector<double> tops_m;
  bool free_surface = false;
  std::string kind = "force:0.6,0.8";
  double source_m = 0;
  std::vector<AnisotropicStack::Receiver> receivers;  // x from the source
  double duration_s = long_form() ? 0.4 : 0.27;
  double cells = 24;  // per wavelength of the slowest wave at the peak
  int order = 5;
  double depth_m = long_form() ? 1000 : 500, width_m = long_form() ? 1200 : 620;
  std::vector<Qualities> qualities;  // of the layers; none: elastic

  double spacing() const {
    double slowest = 1e9;
    for (const auto& layer : layers) {
      const auto speeds = slowest_speeds<2>(layer);
      slowest = std::min(slowest, speeds.s > 0 ? speeds.s : speeds.p);
    }
    // Interfaces lie on faces: a whole number of cells in 20 m.
    return 20 / std::ceil(20 * cells * peak_hz / slowest);
  }
  Scene<2> scene() const {
    const double h = spacing(), x = width_m / 2;
    Scene<2> scene;
    const Grid<2> grid{{std::llround(width_m / h), std::llround(depth_m / h)}, h, {0, 0}};
    const auto layer_of_cell = [&](const Index<2>& at) {
      std::size_t layer = 0;
      for (const double top : tops_m) layer += grid.centre(1, at[1]) > top;
      return layer;
    };
    auto& medium = scene.model.medium;
    medium = medium_of(grid, layers, [&](const Index<2>& at) { return layers[layer_of_cell(at)]; });
    for (const auto property : {Property::qp, Property::qs}) {
      if (!qualities.empty()) medium[property] = Field<2>(grid);
      for (std::int64_t n = 0; n < grid.size() && !qualities.empty(); ++n) {
        const auto& of = qualities[layer_of_cell(grid.index(n))];
        medium[property][std::size_t(n)] = float(property == Property::qp ? of.p : of.s);
      }
    }
    scene.survey.sources = {{{x, source_m}, parse_mechanism<2>(kind), parse_wavelet("ricker:20"), 1e6}};
    for (const auto& at : receivers) scene.survey.receivers_m.push_back({x + at.x, at.z});
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (free_surface) scene.edges[1][0] = EdgeLaw::free;
    scene.numerics.order = order;
    scene.recording = {{Component::vx, Component::vz}, duration_s, 0.001};
    set_attenuation(scene);
    check(scene);
    return scene;
  }
  AnisotropicStack exact() const {
    AnisotropicStack stack;
    for (std::size_t n = 0; n < layers.size(); ++n) {
      stack.layers.push_back(layer_of(layers[n]));
      if (!qualities.empty()) stack.layers[n].relaxed = relaxed(layers[n], qualities[n]);
    }
    stack.tops_m = tops_m, stack.free_surface = free_surface, stack.source_m = source_m;
    if (kind == "explosion") stack.explosion = 1;
    if (kind == "force:0.6,0.8") stack.force = {0.6, 0.8};
    if (kind == "force:0,1") stack.force = {0, 1};
    if (kind == "moment:0,0,1") stack.couple = 1;
    return stack;
  }
  /// Of all traces together.
  double error() const;
};

/// Axes of layers that dip: places and motions along and across them.
struct Dip {
  double cosine, sine;
  explicit Dip(double degrees)
      : cosine(std::cos(degrees * std::numbers::pi / 180)),
        sine(std::sin(degrees * std::numbers::pi / 180)) {}
  Point<2> operator()(double along, double across) const {
    return {cosine * along - sine * across, sine * along + cosine * across};
  }
};

/// The error of all traces of vx and vz against a stack that dips so, of receivers in its frame, at a peak.
inline double error_against(const AnisotropicStack& stack,
                            const std::vector<AnisotropicStack::Receiver>& receivers, const Dip& dip,
                            const Scene<2>& scene, double ricker_hz) {
  const auto gather = shoot(scene, 1);
  const auto exact =
      stack.ricker(ricker_hz, gather.axis.interval_s, std::size_t(gather.axis.count), receivers);
  std::vector<double> found, wanted;
  for (std::size_t r = 0; r < receivers.size(); ++r)
    for (std::size_t n = 0; n < std::size_t(gather.axis.count); ++n) {
      const auto motion = dip(1e6 * exact[r][0][n], 1e6 * exact[r][1][n]);
      for (const std::size_t row : {0, 1}) {
        found.push_back(gather.traces[row * receivers.size() + r].samples[n]);
        wanted.push_back(motion[row]);
      }
    }
  return relative_error(found, wanted);
}
inline double Stack::error() const { return error_against(exact(), receivers, Dip(0), scene(), peak_hz); }

/// One rock around a source, receivers at a distance in all directions but that along x.
inline Stack full_space(const Material& rock, const std::string& kind = "force:0.6,0.8") {
  Stack space;
  space.layers = {rock}, space.kind = kind;
  space.source_m = space.depth_m / 2 + space.spacing() / 2;
  const double distance_m = long_form() ? 350 : 170;
  for (const double degrees : {0., 20., 40., 60., 75., 105., 150.})
    if (long_form() || degrees != 20) {
      const double angle = degrees * std::numbers::pi / 180;
      space.receivers.push_back(
          {distance_m * std::sin(angle), space.source_m + distance_m * std::cos(angle)});
    }
  return space;
}

/// Two rocks that meet on a face, a source in the upper one.
inline Stack two_rocks(const Material& over, const Material& under) {
  Stack stack;
  stack.layers = {over, under};
  stack.tops_m = {560}, stack.source_m = 400 + stack.spacing() / 2;
  stack.receivers = {{250, 300}, {0, 480}, {300, 500}, {200, 640}, {-250, 800}};
  if (long_form()) return stack;
  stack.tops_m = {300}, stack.source_m = 200 + stack.spacing() / 2;
  stack.receivers = {{150, 130}, {0, 250}, {180, 260}, {120, 360}, {-150, 420}};
  return stack;
}

/// A rock below a free surface, or below water, in which an explosion is.
inline Stack below_surface(const Material& rock) {
  Stack stack;
  stack.layers = {rock}, stack.free_surface = true, stack.source_m = 100,
  stack.depth_m = long_form() ? 600 : 360;
  stack.receivers = {{250, 20}, {-150, 40}, {100, 300}, {300, 60}};
  if (!long_form()) stack.receivers = {{170, 20}, {-110, 40}, {80, 220}, {190, 60}};
  return stack;
}
inline Stack below_water(const Material& rock) {
  Stack stack = below_surface(rock);
  stack.layers = {sea, rock}, stack.tops_m = {200}, stack.kind = "explosion",
  stack.depth_m = long_form() ? 700 : 420;
  stack.receivers = {{250, 150}, {-150, 260}, {100, 400}, {300, 240}};
  if (!long_form()) stack.receivers = {{150, 150}, {-90, 260}, {70, 310}, {120, 240}};
  return stack;
}

/// Order of convergence from 12 to 24 cells, order 7, below a free surface.
inline double order_below_surface(const Material& rock) {
  Stack coarse = below_surface(rock);
  coarse.cells = 12, coarse.order = 7;
  coarse.receivers.pop_back();
  auto fine = coarse;
  fine.cells = 24;
  return std::log(coarse.error() / fine.error()) / std::log(coarse.spacing() / fine.spacing());
}

}  // namespace slipwave::solver
