// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "anisotropic_stack.hpp"
#include "lab.hpp"
#include "model/anisotropy.hpp"
#include "solver/simulation.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {

constexpr double peak_hz = 20;

inline AnisotropicStack::Layer layer_of(const Material& material) {
  return {elasticity_of<2>(material), material.rho};
}

/// The stiffness of rock that attenuates, by frequency: c11 and c33 as Qp says, c55 as Qs, and c13 between
/// both (theory.md (Q9)), turned with its beds. Speeds hold at the peak.
inline std::function<AnisotropicStack::ComplexPlane(Complex omega)> relaxed(
    const Material& rock, const std::array<double, 2>& quality) {
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto p = standard_linear(mechanisms, quality[0], peak_hz),
             s = standard_linear(mechanisms, quality[1], peak_hz);
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

/// Flat layers in a box that absorbs, or has a free surface; all in units of cells of the step.
struct Stack {
  std::vector<Material> layers;
  std::vector<double> tops_m;
  bool free_surface = false;
  std::string kind = "force:0.6,0.8";
  double source_m = 0;
  std::vector<AnisotropicStack::Receiver> receivers;  // x from the source
  double duration_s = 0.4;
  double cells = 24;  // per wavelength of the slowest wave at the peak
  int order = 5;
  double cfl = 0.9;
  double depth_m = 1000, width_m = 1200;
  std::vector<std::array<double, 2>> qualities;  // qp and qs of the layers; none: elastic

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
    const double h = spacing();
    Scene<2> scene;
    const Grid<2> grid{{std::llround(width_m / h), std::llround(depth_m / h)}, h, {0, 0}};
    Medium<2> medium(grid);
    medium[Property::epsilon] = medium[Property::delta] = Field<2>(grid);
    if (std::any_of(layers.begin(), layers.end(), [](const Material& layer) { return layer.tilt != 0; }))
      medium[Property::tilt] = Field<2>(grid);
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      std::size_t layer = 0;
      for (const double top : tops_m) layer += grid.centre(1, grid.index(n)[1]) > top;
      put(medium, std::size_t(n), layers[layer]);
      if (qualities.empty()) continue;
      for (const auto property : {Property::qp, Property::qs}) {
        if (!medium.has(property)) medium[property] = Field<2>(grid, float(PropertyRow::infinite));
        medium[property][std::size_t(n)] = float(qualities[layer][property == Property::qs]);
      }
    }
    scene.model.medium = medium;
    const double x = width_m / 2;
    scene.survey.sources = {{{x, source_m}, parse_mechanism<2>(kind), parse_wavelet("ricker:20"), 1e6}};
    for (const auto& at : receivers) scene.survey.receivers_m.push_back({x + at.x, at.z});
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (free_surface) scene.edges[1][0] = EdgeLaw::free;
    scene.numerics.order = order;
    scene.numerics.cfl = cfl;
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
    if (kind == "moment:0,0,1") stack.couple = 1;
    return stack;
  }
  /// Of all traces together.
  double error() const {
    const auto gather = shoot(scene(), 1);
    const auto exact_traces = exact().ricker(peak_hz, 0.001, std::size_t(gather.axis.count), receivers);
    std::vector<double> found, wanted;
    for (std::size_t n = 0; n < gather.traces.size(); ++n) {
      const auto& samples = gather.traces[n].samples;
      const auto& wave = exact_traces[n % receivers.size()][n / receivers.size()];
      found.insert(found.end(), samples.begin(), samples.end());
      for (const double value : wave) wanted.push_back(1e6 * value);
    }
    return relative_error(found, wanted);
  }
};

/// Receivers at a distance in all directions but that along x.
inline std::vector<AnisotropicStack::Receiver> around(double z, double distance_m) {
  std::vector<AnisotropicStack::Receiver> all;
  for (const double degrees : {0., 20., 40., 60., 75., 105., 150.}) {
    const double angle = degrees * std::numbers::pi / 180;
    all.push_back({distance_m * std::sin(angle), z + distance_m * std::cos(angle)});
  }
  return all;
}

/// Two rocks that meet on a face, a source in the upper one.
inline Stack two_rocks(const Material& over, const Material& under) {
  Stack stack;
  stack.layers = {over, under}, stack.tops_m = {560}, stack.source_m = 400 + stack.spacing() / 2;
  stack.receivers = {{250, 300}, {0, 480}, {300, 500}, {200, 640}, {-250, 800}};
  return stack;
}

/// A rock below a free surface.
inline Stack below_surface(const Material& rock) {
  Stack stack;
  stack.layers = {rock}, stack.free_surface = true, stack.source_m = 100, stack.depth_m = 600;
  stack.receivers = {{250, 20}, {-150, 40}, {100, 300}, {300, 60}};
  return stack;
}

/// A rock below water, in which an explosion is.
inline Stack below_water(const Material& rock) {
  Stack stack;
  stack.layers = {{1500, 0, 1000}, rock}, stack.tops_m = {200}, stack.free_surface = true;
  stack.source_m = 100, stack.depth_m = 700, stack.kind = "explosion";
  stack.receivers = {{250, 150}, {-150, 260}, {100, 400}, {300, 240}};
  return stack;
}

/// Order of convergence from 12 to 24 cells, order 7, below a free surface.
inline double order_below_surface(const Material& rock) {
  Stack coarse = below_surface(rock);
  coarse.cells = 12, coarse.order = 7;
  coarse.receivers = {{250, 20}, {-150, 40}, {100, 300}};
  auto fine = coarse;
  fine.cells = 24;
  return std::log(coarse.error() / fine.error()) / std::log(coarse.spacing() / fine.spacing());
}

/// The largest vx of a shot's second half, as a share of that of the first, over so many steps.
inline double late_share(Scene<2> scene, const std::string& wavelet, int steps) {
  scene.survey.sources[0].wavelet = parse_wavelet(wavelet);
  scene.recording.duration_s = steps * time_step_s(scene);
  scene.recording.interval_s = 0.01;
  const auto gather = shoot(scene, 1);
  const auto& vx = gather.traces[0].samples;
  double largest = 0, late = 0;
  for (std::size_t n = 0; n < vx.size(); ++n)
    (n < vx.size() / 2 ? largest : late) = std::max(n < vx.size() / 2 ? largest : late, std::abs(vx[n]));
  return late / largest;
}

/// By what vz of a force along x here and vx of a force along z there, source and receiver exchanged, differ.
inline double error_of_exchange(Scene<2> scene, const Point<2>& one, const Point<2>& other) {
  scene.numerics.double_precision = true;
  scene.recording.components = {Component::vx, Component::vz};
  scene.recording.duration_s = 0.2;
  const auto shot = [&](const Point<2>& from, const Point<2>& to, const std::string& kind) {
    scene.survey.sources[0].position_m = from, scene.survey.sources[0].mechanism = parse_mechanism<2>(kind);
    scene.survey.receivers_m = {to};
    return shoot(scene, 1);
  };
  const auto there = shot(one, other, "force:1,0"), back = shot(other, one, "force:0,1");
  return relative_error(there.traces[1].samples, back.traces[0].samples);
}

}  // namespace slipwave::solver
