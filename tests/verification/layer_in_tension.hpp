// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>

#include "slip_layer.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

// A plane P wave straight through a layer of planes at 45 degrees whose strength is friction under the wave's
// own pressure: none while the wave pulls.
namespace slipwave::solver::tension {

inline constexpr double depth_m = 1500, wave_at_m = 300, layer_at_m = 600, thickness_m = 50, end_s = 0.2;
inline constexpr double friction = 0.1,
                        viscosity = 450;  // s: relaxes within 2.6 ms under the peak of 1 MPa
inline const double z_p = rock.rho * rock.vp, lambda_share = 1 - 2 * mu / modulus_p;

/// Stress of the waves that leave the layer at its faces, and when.
struct Outgoing {
  std::vector<double> times_s, through, back;
  double earlier_s = 0;  // those back than times_s say
};

/// The spectrum from 5 to 60 Hz.
inline std::vector<std::complex<double>> spectrum(const std::vector<double>& times_s,
                                                  const std::vector<double>& values) {
  std::vector<std::complex<double>> all;
  const double dt_s = times_s[1] - times_s[0];
  for (double hz = 5; hz <= 60; hz += 1) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < values.size(); ++n)
      sum += values[n] * std::polar(dt_s, -2 * std::numbers::pi * hz * times_s[n]);
    all.push_back(sum);
  }
  return all;
}

/// Relative L2 error of a spectrum, in percent.
inline double error_of(const std::vector<std::complex<double>>& found,
                       const std::vector<std::complex<double>>& exact) {
  double wrong = 0, all = 0;
  for (std::size_t n = 0; n < exact.size(); ++n)
    wrong += std::norm(found[n] - exact[n]), all += std::norm(exact[n]);
  return 100 * std::sqrt(wrong / all);
}

/// Waves carried from node to node exactly in one step of time, between two of which the traction on the
/// planes relaxes without them (S3). Where the planes have no strength that is of first order in the step: it
/// wants many nodes, and knows nothing of the rules of a step.
inline Outgoing reference(int nodes, double viscosity = tension::viscosity) {
  const double dt_s = thickness_m / rock.vp / nodes, start_s = (layer_at_m - wave_at_m) / rock.vp;
  struct Node {
    double down = 0, up = 0, sxx = 0;
  };
  std::vector<Node> all(std::size_t(nodes), Node{});
  const auto relax = [&](Node& node) {
    const double szz = node.down + node.up, tau = (node.sxx - szz) / 2;
    const double strength = friction * std::max(-(node.sxx + szz) / 2, 0.);
    const double excess = std::max(std::abs(tau) - strength, 0.);
    const double left = strength > 0 ? std::exp(-mu * dt_s / 2 / (viscosity * strength)) : 0;
    const double change = -std::copysign(excess * (1 - left), tau);
    node.sxx += change;
    node.down -= change / 2;
    node.up -= change / 2;
  };
  Outgoing waves;
  for (double t = -0.06; t < end_s - start_s; t += dt_s) {
    for (auto& node : all) relax(node);
    waves.times_s.push_back(t + dt_s / 2 + start_s);
    waves.through.push_back(all.back().down);
    waves.back.push_back(all.front().up);
    double down = incident(t + dt_s / 2);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const double was = all[n].down + all[n].up;
      std::swap(down, all[n].down);
      all[n].up = n + 1 < all.size() ? all[n + 1].up : 0;
      all[n].sxx += lambda_share * (all[n].down + all[n].up - was);
    }
    for (auto& node : all) relax(node);
  }
  return waves;
}

/// How a layer lies among cells of h metres.
struct Cells {
  double h;
  double offset = 0;    // of its upper face behind a face between cells, in cells, below 1
  bool shared = false;  // whether cells that its faces cut slip by shares; else those with their middle in it
  double viscosity = tension::viscosity;
};

/// The same by the solver; times are when the waves were at the faces.
inline Outgoing solved(SlipCorrection correction, const Cells& of, double courant) {
  const double h = of.h;
  Scene<2> scene;
  const auto cells = std::int64_t(depth_m / h);
  scene.model.medium = uniform_medium(2, cells, h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  const auto first = std::int64_t(layer_at_m / h), last = first + std::int64_t(thickness_m / h) - 1;
  const bool behind = of.offset > 0 && (of.shared || of.offset > 0.5);
  if (of.shared) scene.model.fracture_share = Field<2>(scene.model.grid(), 1);
  for (std::int64_t k = first; k <= last + 1; ++k)
    for (const std::int64_t i : {0, 1}) {
      const bool whole = of.shared || !behind ? k <= last : k > first;
      scene.model.fracture({i, k}) = whole || (behind && k == last + 1);
      if (of.shared && k == first) scene.model.fracture_share({i, k}) = float(1 - of.offset);
      if (of.shared && behind && k == last + 1) scene.model.fracture_share({i, k}) = float(of.offset);
    }
  const double half = std::sqrt(0.5);
  scene.model.fracture_sets = {{"bed", {{{half, half}, friction, of.viscosity, 0}}}};
  scene.numerics.correction = correction;
  const double dt_s = courant * h / rock.vp;
  using L = Lab<double>;
  L lab(scene.model.medium, edges_all(EdgeLaw::rigid), 7, dt_s);
  const auto slip = std::make_unique<Slip<2, double>>(lab.state(), lab.domain(), scene, dt_s);
  for (std::int64_t k = 0; k < cells; ++k)
    for (const std::int64_t i : {0, 1}) {
      const double szz = incident((wave_at_m - lab.grid().centre(1, k)) / rock.vp);
      lab(L::szz, i, k) = szz;
      lab(L::sxx, i, k) = lambda_share * szz;
      lab(L::vz, i, k) = -szz / z_p;
    }
  const auto away = std::int64_t(20 / h);
  const double way_s = (double(away) - 0.5) * h / rock.vp;
  Outgoing waves;
  waves.earlier_s = 2 * of.offset * h / rock.vp;
  for (std::int64_t n = 0; double(n + 1) * dt_s < end_s; ++n) {
    lab.sweep(1, 1);
    run_everywhere(*slip, {n, dt_s}, lab.state());
    const auto wave = [&](std::int64_t k, double direction) {
      return (lab(L::szz, 1, k) - direction * z_p * lab(L::vz, 1, k)) / 2;
    };
    waves.times_s.push_back(double(n + 1) * dt_s - way_s);
    waves.through.push_back(wave(last + away, 1));
    waves.back.push_back(wave(first - away, -1));
    run_after_everywhere(*slip, {n, dt_s}, lab.state());
  }
  return waves;
}

/// Errors of the reflected wave and of what slip changes in the transmitted one.
inline Errors errors_below_60_hz(const Outgoing& found, const Outgoing& exact) {
  auto back_s = found.times_s;
  for (double& time : back_s) time -= found.earlier_s;
  return {error_of(spectrum(found.times_s, found.through), spectrum(exact.times_s, exact.through)),
          error_of(spectrum(back_s, found.back), spectrum(exact.times_s, exact.back))};
}

}  // namespace slipwave::solver::tension
