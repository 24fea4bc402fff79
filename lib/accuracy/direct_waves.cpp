// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/direct_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

/// At most so many receivers of a shot and shots of a survey are followed: neighbours have the same way.
constexpr std::size_t receivers_followed = 8, shots_followed = 2;
/// Frequencies that a wavelet is resolved into.
constexpr int frequencies = 16;
/// A ray is sampled so often, and speeds are told apart by this part of themselves.
constexpr int parts_of_a_ray = 64;
constexpr double alike = 0.04;

template <class Act>
void every_few(std::size_t count, std::size_t most, Act&& act) {
  const std::size_t stride = std::max<std::size_t>(1, (count + most - 1) / most);
  for (std::size_t n = stride / 2; n < count; n += stride) act(n);
}

/// vp and vs.
template <int D>
std::array<double, 2> speeds_at(const Medium<D>& medium, const Point<D>& point) {
  const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), point)));
  return {medium.vp[cell], medium.vs[cell]};
}

/// What a source sends out as P and as S along the unit vector n, in energy per width of front and up to a
/// common factor: far field of a force, |u| ~ F c^(-(D+1)/2), and of a moment, |u| ~ M c^(-(D+3)/2).
template <int D>
std::array<double, 2> radiation(const PointInjection<D>& injection, const std::array<double, 2>& speeds,
                                const Point<D>& n) {
  Point<D> pushed{};  // the traction of the moment along n
  double force_p = 0, moment_p = 0, force = 0, moment = 0;
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t j = 0; j < D; ++j) pushed[i] += injection.moment_rate(int(i), int(j)) * n[j];
    force_p += injection.force[i] * n[i];
    moment_p += pushed[i] * n[i];
    force += injection.force[i] * injection.force[i];
    moment += pushed[i] * pushed[i];
  }
  const auto sent = [&](double of_force, double of_moment, double speed) {
    return speed > 0 ? of_force * std::pow(speed, -(D + 1)) + of_moment * std::pow(speed, -(D + 3)) : 0.;
  };
  const double p = force_p * force_p, m = moment_p * moment_p;
  return {sent(p, m, speeds[0]), sent(std::max(0., force - p), std::max(0., moment - m), speeds[1])};
}

template <int D>
double length_of(const Point<D>& way) {
  double sum = 0;
  for (const double part : way) sum += part * part;
  return std::sqrt(sum);
}

/// The way of a plane wave through the model to a point.
template <int D>
double way_in_model_m(const Grid<D>& grid, const Point<D>& to, const Point<D>& direction) {
  double length = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < D; ++axis) {
    if (std::abs(direction[axis]) < 1e-9) continue;
    const double edge = direction[axis] > 0 ? to[axis] - grid.origin_m[axis] : grid.end(int(axis)) - to[axis];
    length = std::min(length, std::max(0., edge) / std::abs(direction[axis]));
  }
  return length;
}

}  // namespace

template <int D>
DirectWaves<D>::DirectWaves(const Scene<D>& scene) {
  const auto& first = scene.survey.sources.front();
  const auto& wavelet = first.wavelet;
  // What lies above carries less than 1e-6 of the energy of smooth wavelets, 1e-4 of those with kinks.
  const double highest = wavelet.highest_frequency_hz(0.01) * 1.3;
  const int power = !point_injection(first) ? 0 : D - 1;
  double sum = 0;
  for (int n = 0; n < frequencies; ++n) {
    const double hz = (n + 0.5) * highest / frequencies;
    band_.push_back({hz, std::pow(wavelet.amplitude_spectrum(hz), 2) * std::pow(hz, power)});
    sum += band_.back().energy;
  }
  for (auto& line : band_) line.energy /= sum;
  const auto rays_of = [&](const Scene<D>& of) {
    every_few(of.survey.sources.size(), shots_followed, [&](std::size_t n) { add_shot(of, n + 1); });
    arrive_ = !rays_.empty();
    if (arrive_) return;
    const auto [vp, vs] = speeds_at(of.model.medium, first.position_m);
    rays_.push_back({vs > 0 ? WaveKind::s : WaveKind::p, 1, 0, {{vp, vs, of.recording.duration_s}}});
  };
  const auto slowest = std::size_t(slowest_wave(scene.model.medium).cell);
  const double vp = scene.model.medium.vp[slowest], vs = scene.model.medium.vs[slowest];
  latest_ = {vs > 0 ? WaveKind::s : WaveKind::p, 1, 0, {{vp, vs, scene.recording.duration_s}}};
  if (anisotropic_cells(scene.model.medium) == 0) {
    rays_of(scene);
  } else {
    auto isotropic = scene;
    isotropic.model.medium = in_slowest_directions(scene.model.medium);
    rays_of(isotropic);
  }
}

template <int D>
void DirectWaves<D>::add_shot(const Scene<D>& scene, std::size_t shot) {
  const auto& medium = scene.model.medium;
  const auto& source = scene.survey.sources[shot - 1];
  const auto injection = point_injection(source);
  const auto receivers = scene.survey.receivers_of(shot);
  every_few(receivers.size(), receivers_followed, [&](std::size_t n) {
    const auto& to = receivers[n].point_m;
    if (const auto* wave = std::get_if<PlaneWave<D>>(&source.mechanism)) {
      const double length = way_in_model_m(medium.grid(), to, wave->direction);
      auto from = to;
      for (std::size_t axis = 0; axis < D; ++axis) from[axis] -= length * wave->direction[axis];
      const double angle = std::acos(std::clamp(wave->direction[D - 1], -1., 1.));
      add_ray(medium, from, to, {wave->shear ? WaveKind::s : WaveKind::p, 1, angle, {}},
              scene.recording.duration_s);
      return;
    }
    Point<D> way{};
    for (std::size_t axis = 0; axis < D; ++axis) way[axis] = to[axis] - source.position_m[axis];
    const double r = std::max(length_of<D>(way), 1e-3);
    for (auto& part : way) part /= r;
    const auto sent = radiation(*injection, speeds_at(medium, source.position_m), way);
    const double angle = std::acos(std::clamp(way[D - 1], -1., 1.)), spread = std::pow(r, D - 1);
    // Less than this of both is rounding: explosions send no S waves.
    const double least = 1e-12 * (sent[0] + sent[1]);
    for (const auto& [kind, energy] : {std::pair{WaveKind::p, sent[0]}, {WaveKind::s, sent[1]}})
      if (energy > least)
        add_ray(medium, source.position_m, to, {kind, energy / spread, angle, {}},
                scene.recording.duration_s);
  });
}

/// Nothing of waves that do not pass everywhere, or arrive after the traces end.
template <int D>
void DirectWaves<D>::add_ray(const Medium<D>& medium, const Point<D>& from, const Point<D>& to, Ray ray,
                             double last_s) {
  Point<D> way{};
  for (std::size_t axis = 0; axis < D; ++axis) way[axis] = to[axis] - from[axis];
  const double length = length_of<D>(way);
  double time_s = 0;
  for (int n = 0; n < parts_of_a_ray; ++n) {
    auto at = from;
    for (std::size_t axis = 0; axis < D; ++axis) at[axis] += (n + 0.5) / parts_of_a_ray * way[axis];
    const auto [vp, vs] = speeds_at(medium, at);
    const double speed = ray.kind == WaveKind::p ? vp : vs;
    if (!(speed > 0)) return;
    const double part_s = length / parts_of_a_ray / speed;
    time_s += part_s;
    const auto like = std::find_if(ray.legs.begin(), ray.legs.end(), [&, vp = vp, vs = vs](const Leg& leg) {
      return std::abs(leg.vp - vp) <= alike * vp && std::abs(leg.vs - vs) <= alike * vs;
    });
    if (like == ray.legs.end())
      ray.legs.push_back({vp, vs, part_s});
    else
      like->time_s += part_s;
  }
  if (ray.energy > 0 && time_s <= last_s) rays_.push_back(std::move(ray));
}

template <int D>
double DirectWaves<D>::squared_error(const Discretisation& cells, const Ray& ray) const {
  const double dt = cells.time_step_s, h = cells.spacing_m;
  double error = 0;
  for (const auto& [hz, energy] : band_) {
    std::complex<double> exponent = 0;
    for (const auto& leg : ray.legs) {
      const double wavelength = (ray.kind == WaveKind::p ? leg.vp : leg.vs) / hz / h;
      // Waves shorter than two cells are not on the grid at all.
      if (wavelength <= 2) {
        exponent = -1e3;
        break;
      }
      const UniformScheme scheme{cells.order, leg.vp * dt / h, leg.vs * dt / h, cells.time_order};
      exponent += leg.time_s / dt * step_error(scheme, ray.kind, wavelength, ray.angle);
    }
    error += energy * std::norm(std::exp(exponent) - 1.0);
  }
  return error;
}

template <int D>
typename DirectWaves<D>::Error DirectWaves<D>::error(const Discretisation& cells) const {
  const auto of = [&](WaveKind kind) -> std::optional<double> {
    double energy = 0, wrong = 0;
    for (const auto& ray : rays_) {
      if (ray.kind != kind) continue;
      energy += ray.energy;
      wrong += ray.energy * squared_error(cells, ray);
    }
    if (!(energy > 0) || !arrive_) return std::nullopt;
    return std::sqrt(wrong / energy);
  };
  return {of(WaveKind::p), of(WaveKind::s)};
}

template <int D>
double DirectWaves<D>::together(const Discretisation& cells) const {
  double energy = 0, wrong = 0;
  for (const auto& ray : rays_) {
    energy += ray.energy;
    wrong += ray.energy * squared_error(cells, ray);
  }
  return std::sqrt(wrong / energy);
}

template <int D>
double DirectWaves<D>::latest(const Discretisation& cells) const {
  return std::sqrt(squared_error(cells, latest_));
}

template <int D>
Discretisation discretisation_of(const Scene<D>& scene) {
  return {scene.numerics.order, time_step_s(scene), scene.model.grid().spacing_m, scene.numerics.time_order};
}

SLIPWAVE_INSTANTIATE_D(TYPE, class DirectWaves);
SLIPWAVE_INSTANTIATE_D(FUNCTION, discretisation_of);

}  // namespace slipwave
