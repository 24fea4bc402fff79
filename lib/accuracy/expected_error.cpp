// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/expected_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "accuracy/finer_model.hpp"
#include "accuracy/straight_way.hpp"
#include "model/anisotropy.hpp"
#include "model/parted_faces.hpp"

namespace slipwave {
namespace {

template <int D>
Discretisation discretisation_of(const Scene<D>& scene) {
  return {scene.numerics.order, time_step_s(scene), scene.model.grid().spacing_m, scene.numerics.time_order};
}

/// At most so many receivers of a shot and shots of a survey are followed: neighbours have the same way.
constexpr std::size_t receivers_followed = 48, shots_followed = 4;
/// Directions of travel over which waves of unknown direction are averaged.
constexpr int directions = 6;
/// A Rayleigh wave against the S wave.
constexpr double rayleigh_speed = 0.93;
/// Its decay with depth, over the wave number: that of the slower of its two parts, roughly.
constexpr double rayleigh_decay = 0.8;

template <class Act>
void every_few(std::size_t count, std::size_t most, Act&& act) {
  const std::size_t stride = std::max<std::size_t>(1, (count + most - 1) / most);
  for (std::size_t n = stride / 2; n < count; n += stride) act(n);
}

/// What a source sends out as P and as S in the direction of the unit vector n, in energy per width of front
/// and up to a common factor: far field of a force, |u| ~ F c^(-3/2), and of a moment, |u| ~ M c^(-5/2).
struct Radiation {
  double p = 0, s = 0;
};
Radiation radiation(const PointInjection<2>& injection, const Speeds& speeds, const Point<2>& n) {
  const Point<2> across = {n[1], -n[0]};
  double force_p = 0, force_s = 0, moment_p = 0, moment_s = 0;
  for (int i = 0; i < 2; ++i) {
    const auto a = std::size_t(i);
    force_p += injection.force[a] * n[a];
    force_s += injection.force[a] * across[a];
    for (int j = 0; j < 2; ++j) {
      const double m = injection.moment_rate(i, j) * n[std::size_t(j)];
      moment_p += m * n[a];
      moment_s += m * across[a];
    }
  }
  // One of force and moment is there; their spectra differ by a factor that both waves share.
  return {force_p * force_p * std::pow(speeds.vp, -3) + moment_p * moment_p * std::pow(speeds.vp, -5),
          speeds.vs > 0
              ? force_s * force_s * std::pow(speeds.vs, -3) + moment_s * moment_s * std::pow(speeds.vs, -5)
              : 0};
}

/// Depth of the surface above a point, m.
double surface_m(const Grid<2>& grid, const Point<2>& point) {
  return grid.rows ? grid.depths_at(point)[0] : grid.origin_m[1];
}

/// The part of the energy between two points that goes as a Rayleigh wave along a free surface at the top.
double rayleigh_share(const Scene<2>& scene, const Source<2>& source, const Point<2>& receiver) {
  const auto& medium = scene.model.medium;
  const double top = surface_m(medium.grid(), source.position_m), h = medium.grid().spacing_m;
  const double vs = speeds_at(medium, {source.position_m[0], top + h / 2}).vs;
  if (scene.edges[1][0] != EdgeLaw::free || !(vs > 0)) return 0;
  const double k = 2 * std::numbers::pi * source.wavelet.nominal_hz() / (rayleigh_speed * vs);
  return std::exp(-2 * rayleigh_decay * k *
                  (source.position_m[1] - top + receiver[1] - surface_m(medium.grid(), receiver)));
}

/// How much farther than the source its image in a free surface is from a receiver, m; in water only, whose
/// surface sends all of the wave back.
std::optional<double> detour_of_ghost(const Scene<2>& scene, const Point<2>& from, const Point<2>& receiver) {
  const auto& medium = scene.model.medium;
  const double top = surface_m(medium.grid(), from), x = receiver[0] - from[0];
  if (scene.edges[1][0] != EdgeLaw::free || speeds_at(medium, from).vs > 0 ||
      speeds_at(medium, {from[0], top}).vs > 0)
    return std::nullopt;
  return std::hypot(x, receiver[1] + from[1] - 2 * top) - std::hypot(x, receiver[1] - from[1]);
}

/// A band with the share of energy that is left when the image of the source in a free surface is subtracted,
/// which comes over a way longer by `detour_m`: 4 sin^2(pi f detour/c) at each frequency.
struct GhostedBand {
  WaveBand band;
  double share = 1;
};
GhostedBand with_ghost(WaveBand band, double detour_m, double speed) {
  double sum = 0;
  for (std::size_t n = 0; n < band.hz.size(); ++n) {
    band.energy[n] *= 4 * std::pow(std::sin(std::numbers::pi * band.hz[n] * detour_m / speed), 2);
    sum += band.energy[n];
  }
  if (!(sum > 0)) return {std::move(band), 0};
  for (auto& share : band.energy) share /= sum;
  return {std::move(band), sum};
}

using Trains = std::vector<WaveTrain>;

void add_point_source(const Scene<2>& scene, const Source<2>& source, const Point<2>& receiver,
                      Trains& trains) {
  const auto& medium = scene.model.medium;
  const auto& from = source.position_m;
  const double r = std::max(std::hypot(receiver[0] - from[0], receiver[1] - from[1]), 1e-3);
  const Point<2> n = {(receiver[0] - from[0]) / r, (receiver[1] - from[1]) / r};
  const double angle = std::atan2(n[0], n[1]);
  const auto sent = radiation(*point_injection(source), speeds_at(medium, from), n);
  const double share = rayleigh_share(scene, source, receiver);
  const auto band = band_of(source.wavelet, 1);
  const auto ghost_detour = detour_of_ghost(scene, from, receiver);
  double energy = 0;
  const auto add = [&](double sent_energy, WaveKind kind) {
    const auto way = straight_way(medium, from, receiver, kind);
    if (!(sent_energy > 0) || way.empty() || way.time_s() > scene.recording.duration_s) return;
    const auto left =
        ghost_detour ? with_ghost(band, *ghost_detour, speeds_at(medium, from).vp) : GhostedBand{band};
    trains.push_back({(1 - share) * left.share * sent_energy / r, kind, angle, way, left.band});
    energy += sent_energy / r;
  };
  add(sent.p, WaveKind::p);
  add(sent.s, WaveKind::s);
  if (!(share > 0)) return;
  const auto [vp, vs] = speeds_at(medium, {from[0], surface_m(medium.grid(), from)});
  WayOfWave way;
  way.add(vp, rayleigh_speed * vs, std::abs(receiver[0] - from[0]) / (rayleigh_speed * vs));
  if (way.time_s() > scene.recording.duration_s) return;
  trains.push_back({share * energy, WaveKind::s, std::numbers::pi / 2, way, band_of(source.wavelet, 2)});
}

void add_plane_wave(const Scene<2>& scene, const Source<2>& source, const PlaneWave<2>& wave,
                    const Point<2>& receiver, Trains& trains) {
  const auto kind = wave.shear ? WaveKind::s : WaveKind::p;
  auto way = way_in_of_plane_wave(scene, source, wave, receiver);
  const double angle = std::atan2(wave.direction[0], wave.direction[1]);
  if (!way.empty()) trains.push_back({1, kind, angle, std::move(way), band_of(source.wavelet, 0)});
}

Trains direct_waves(const Scene<2>& scene) {
  Trains trains;
  const auto& survey = scene.survey;
  every_few(survey.sources.size(), shots_followed, [&](std::size_t shot) {
    const auto& source = survey.sources[shot];
    const auto* plane = std::get_if<PlaneWave<2>>(&source.mechanism);
    const auto receivers = survey.receivers_of(shot + 1);
    every_few(receivers.size(), receivers_followed, [&](std::size_t n) {
      if (plane)
        add_plane_wave(scene, source, *plane, receivers[n].point_m, trains);
      else
        add_point_source(scene, source, receivers[n].point_m, trains);
    });
  });
  return trains;
}

/// Waves on their way as long as the traces last, in all directions.
Trains longest_waves(const Scene<2>& scene, WaveKind kind) {
  const auto& medium = scene.model.medium;
  WayOfWave way;
  for (std::size_t n = 0; n < std::size_t(medium.grid().size()); ++n) {
    const double speed = kind == WaveKind::p ? medium.vp[n] : medium.vs[n];
    if (speed > 0) way.add(medium.vp[n], medium.vs[n], 1 / speed);
  }
  if (way.empty()) return {};
  const auto& source = scene.survey.sources.front();
  WayOfWave longest;
  const double scale = scene.recording.duration_s / way.time_s();
  for (const auto& part : way.media()) longest.add(part.vp, part.vs, part.time_s * scale);
  const auto band = band_of(source.wavelet, point_injection(source) ? 1 : 0);
  Trains trains;
  for (int n = 0; n < directions; ++n)
    trains.push_back({1, kind, (n + 0.5) / directions * std::numbers::pi / 2, longest, band});
  return trains;
}

const char* const paths_of_anisotropy = "anisotropy, but for the speeds of its slowest directions";

/// What stands for a scene: an isotropic one, as slow everywhere as its slowest directions.
template <int D>
Scene<D> isotropic(Scene<D> scene) {
  scene.model.medium = in_slowest_directions(scene.model.medium);
  return scene;
}

}  // namespace

WavesOfScene::WavesOfScene(const Scene<2>& scene, bool finer_geometry)
    : WavesOfScene(discretisation_of(scene),
                   anisotropic_cells(scene.model.medium) > 0 ? isotropic(scene) : scene, finer_geometry) {
  anisotropic_ = anisotropic_cells(scene.model.medium) > 0;
  monotone_ = scene.numerics.monotone;
}

WavesOfScene::WavesOfScene(const Discretisation& own, const Scene<2>& scene, bool finer_geometry)
    : own_(own),
      sources_(scene, finer_geometry),
      direct_(direct_waves(scene)),
      longest_p_(longest_waves(scene, WaveKind::p)),
      longest_s_(longest_waves(scene, WaveKind::s)) {}

ExpectedError WavesOfScene::expected(const Discretisation& cells) const {
  const auto of = [&](const Trains& trains) -> std::optional<double> {
    if (trains.empty()) return std::nullopt;
    return std::sqrt(squared_error(cells, trains));
  };
  ExpectedError error{
      of(direct_), of(longest_p_).value_or(0), of(longest_s_), {}, sources_.not_covered(), {}, {}, {}};
  if (anisotropic_) error.not_covered.emplace_back(paths_of_anisotropy);
  if (monotone_) error.not_covered.emplace_back(flattened_extrema);
  error.promise = promised(cells);
  return error;
}

std::optional<PromisedError> WavesOfScene::promised(const Discretisation& cells) const {
  if (!sources_.any()) return std::nullopt;
  return sources_.promised(cells);
}

double WavesOfScene::of_reflections_too(const Discretisation& cells, double most) const {
  // What takes longest comes last.
  double error = sources_.any() ? sources_.without_slip(cells, most) : 0;
  for (const auto* trains : {&longest_p_, &direct_})
    if (error <= most && !trains->empty()) error = std::max(error, std::sqrt(squared_error(cells, *trains)));
  return error;
}

ExpectedError expected_error(const Scene<2>& scene) {
  auto error = WavesOfScene(scene, has_finer_geometry(scene)).expected();
  if (!scene.slips() && !(scene.with_slip && first_on_faces(scene.model.fracture_sets))) return error;
  const FractureResponse response(scene);
  error.response_unknown = response.why_not();
  error.response_leaves_out = response.not_covered();
  if (response.any()) error.response = response.promised(response_setting(scene));
  return error;
}

ExpectedError expected_error(const Scene<3>& scene) {
  const bool anisotropic = anisotropic_cells(scene.model.medium) > 0;
  std::optional<Scene<3>> like;
  if (anisotropic) like = isotropic(scene);
  const ErrorSources sources(like ? *like : scene);
  ExpectedError error;
  error.not_covered = sources.not_covered();
  if (anisotropic) error.not_covered.emplace_back(paths_of_anisotropy);
  if (scene.numerics.monotone) error.not_covered.emplace_back(flattened_extrema);
  if (sources.any()) error.promise = sources.promised(discretisation_of(scene));
  if (scene.slips()) error.response_unknown = "waves of fractures in 3-D are not followed";
  return error;
}

}  // namespace slipwave
