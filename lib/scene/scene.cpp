// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "build/model_in_cells.hpp"
#include "grid/locate.hpp"
#include "model/split_faces.hpp"
#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/anisotropy_check.hpp"
#include "scene/gauges.hpp"
#include "scene/model_ground.hpp"
#include "scene/plane_wave.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

/// "2 or 4".
std::string alternatives(std::span<const int> numbers) {
  std::string text;
  for (std::size_t n = 0; n < numbers.size(); ++n)
    text += (n == 0 ? "" : n + 1 < numbers.size() ? ", " : " or ") + std::to_string(numbers[n]);
  return text;
}

/// Depth of the first cell in the column of a point that is not void, where there is one.
template <int D>
std::optional<double> surface_there(const Scene<D>& scene, const Point<D>& point) {
  Ground<D> ground(scene.subdomain.whole(scene.model.grid()));
  see(ground, scene.model.medium);
  return ground.surface_m(point);
}

/// `who` names what stands at the point.
template <int D, class Who>
void refuse_void(const Scene<D>& scene, const Point<D>& point, const Who& who) {
  if (!scene.subdomain.owns(scene.model.grid(), point)) return;
  const auto cell = std::size_t(scene.model.grid().flat(cell_of(scene.model.grid(), point)));
  if (!scene.model.medium.is_void(cell)) return;
  std::string place;
  for (std::size_t axis = 0; axis < D; ++axis)
    place += std::string(axis == 0 ? "" : " ") + axis_names<D>()[axis] + "=" + shown(point[axis]);
  const auto surface = surface_there(scene, point);
  const bool above = surface && *surface >= point[D - 1];
  throw Error(who() + " at " + place + " is in void, expected rock or fluid" +
              (above ? ": the surface there is at z=" + shown(*surface) : ""));
}

/// Fluid carries the same normal stress in all directions: any other moment would stay in it for good.
template <int D>
void check_moment_in_fluid(const Scene<D>& scene, const Source<D>& source) {
  const auto* moment = std::get_if<MomentTensor<D>>(&source.mechanism);
  if (!moment || !scene.subdomain.owns(scene.model.grid(), source.position_m)) return;
  const auto cell = std::size_t(scene.model.grid().flat(cell_of(scene.model.grid(), source.position_m)));
  if (!scene.model.medium.is_fluid(cell)) return;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      if (moment->tensor(i, j) != (i == j ? moment->tensor(0, 0) : 0))
        throw Error(
            "the source at " + place_of(scene.model.grid(), std::int64_t(cell)) +
            " is in fluid and its moment differs between directions, expected --kind explosion there");
}

void check_positive(double value, const char* what, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error("found " + std::string(what) + " of " + shown(value) + ' ' + unit + ", expected it above 0",
                ErrorKind::usage);
}

/// What is longer than all of the time would leave its beginning alone.
void check_within(const Recording& recording, const char* what, double interval_s) {
  if (interval_s <= recording.duration_s - recording.before_s) return;
  throw Error("found " + std::string(what) + " of " + shown(interval_s) + " s, expected at most --time, " +
                  shown(recording.duration_s - recording.before_s, 9) + " s",
              ErrorKind::usage);
}

/// They are counted in whole numbers; more would never end.
void check_count(const Recording& recording, const char* what, double interval_s, const char* counted) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  if (recording.duration_s / interval_s < most) return;
  const double before_s = recording.before_s;
  throw Error("found " +
                  (before_s > 0 ? "a delay of a source of " + shown(-before_s)
                                : "--time of " + shown(recording.duration_s)) +
                  " s and " + what + " of " + shown(interval_s) + " s, expected at most " +
                  std::to_string(std::int64_t(most)) + ' ' + counted,
              ErrorKind::usage);
}

/// Both ends of the gauge must be in the model, and in rock or fluid.
template <int D>
void check_fibre(const Scene<D>& scene) {
  const auto& fibre = *scene.recording.fibre;
  const auto grid = scene.subdomain.whole(scene.model.grid());
  each_gauge_point<D>(scene, [&](const Point<D>& point, std::size_t shot, std::size_t number) {
    const auto who = [&] {
      return name_of_receiver(scene.survey, shot, number) + " with an end of its das gauge of " +
             shown(fibre.gauge_m) + " m";
    };
    if (!is_inside<D>(point, grid)) check_inside<D>(who(), point, grid);
    refuse_void(scene, point, who);
  });
}

template <int D>
void check_source(const Scene<D>& scene, const Source<D>& source, const std::function<std::string()>& who) {
  const auto* wave = std::get_if<PlaneWave<D>>(&source.mechanism);
  if (wave && source.delay_s != 0)
    throw Error(who() + ": found a delay of " + shown(source.delay_s) +
                " s of a plane wave, expected none; move its --source back instead");
  if (!(source.delay_s >= 0 && std::isfinite(source.delay_s)))
    throw Error(who() + ": found a delay of " + shown(source.delay_s) + " s, expected 0 or more");
  if (wave)
    way_of_plane_wave(scene, source);
  else
    placing(scene.survey, [&] { refuse_void<D>(scene, source.position_m, who); });
  check_moment_in_fluid(scene, source);
  if (!std::isfinite(source.amplitude) || source.amplitude == 0)
    throw Error("found --amplitude " + shown(source.amplitude) + ", expected a finite number other than 0",
                ErrorKind::usage);
}

template <int D>
void check_sources(const Scene<D>& scene, std::size_t shot) {
  const auto sources = scene.survey.sources_of(shot);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto who = [&] { return scene.survey.name_of_source(shot, n); };
    check_source(scene, *sources[n], who);
    if (sources.size() > 1 && std::holds_alternative<PlaneWave<D>>(sources[n]->mechanism))
      throw Error(who() + ": found a plane wave in a blended shot, expected point sources");
  }
}

template <int D>
void check_components(const Recording& recording) {
  const auto& components = recording.components;
  for (const Component component : components) {
    if (std::count(components.begin(), components.end(), component) > 1)
      throw Error("found component " + std::string(name_of(component)) + " more than once, expected it once",
                  ErrorKind::usage);
    if (!row_of(component).in(D))
      throw Error("found component " + std::string(name_of(component)) + " in " + std::to_string(D) +
                      "-D, expected " + joined(component_names(D), " or "),
                  ErrorKind::usage);
    if (component == Component::das && !recording.fibre)
      throw Error("found das without a fibre, expected das:ANGLE:GAUGE", ErrorKind::usage);
  }
}

}  // namespace

std::int64_t Recording::samples() const {
  // A duration of 0.3 s at 1 ms must not lose its last sample to the last bit of a quotient.
  return std::int64_t(std::floor(duration_s / interval_s * (1 + 1e-12) + 1e-9)) + 1;
}

const char* name_of(SlipCorrection correction) {
  return correction == SlipCorrection::first     ? "first order"
         : correction == SlipCorrection::second  ? "second order"
         : correction == SlipCorrection::centred ? "centred"
                                                 : "exponential";
}

template <int D>
bool Scene<D>::slips() const {
  return with_slip &&
         std::any_of(model.fracture.begin(), model.fracture.end(), [](auto code) { return code != 0; });
}

template <int D>
bool Scene<D>::attenuates() const {
  return attenuation && attenuating_cells(model.medium) > 0;
}

template <int D>
Scene<D> with_model(const Scene<D>& scene, Model<D> model) {
  Scene<D> changed{std::move(model), scene.subdomain,  scene.survey,           scene.edges,
                   scene.numerics,   scene.recording,  scene.snapshot_every_s, scene.with_slip,
                   scene.slip_diary, scene.attenuation};
  if (scene.subdomain.is_whole()) changed.subdomain.fastest = changed.subdomain.fastest_across_cells = 0;
  return changed;
}

template <int D>
Scene<D> in_cells_of(const Scene<D>& scene, const ModelInCells<D>& models, double spacing_m) {
  auto changed = with_model(scene, models.of(spacing_m));
  if (auto& step_s = changed.numerics.time_step_s) *step_s *= spacing_m / scene.model.grid().spacing_m;
  return changed;
}

template <int D>
std::vector<std::string> set_attenuation(Scene<D>& scene, const AttenuationChoice& choice) {
  double peak_hz = 0;
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    for (const auto* source : scene.survey.sources_of(shot))
      peak_hz = std::max(peak_hz, source->wavelet.nominal_hz());
  if (!(peak_hz > 0)) return {};
  const double reference_hz = choice.reference_hz.value_or(peak_hz);
  if (!(reference_hz > 0) || !std::isfinite(reference_hz))
    throw Error("--q-frequency: found " + shown(reference_hz) + " Hz, expected it above 0", ErrorKind::usage);
  const auto band_hz = choice.band_hz.value_or(std::array{peak_hz / 5, 2.5 * peak_hz});
  const Mechanisms mechanisms = in_place(choice.band_hz ? "--q-band, --q-mechanisms" : "--q-mechanisms", [&] {
    return Mechanisms(choice.mechanisms, band_hz[0], band_hz[1]);
  });
  if (attenuating_cells(scene.model.medium) == 0) return {};
  scene.attenuation.emplace(Attenuation{mechanisms, reference_hz});
  // What has relaxed is twice as much memory as the fields: longer tiles bring it through the caches less
  // often. Processes that share a shot have chosen how much they exchange before.
  auto& tiling = scene.numerics.tiling;
  if (D == 2 && tiling.steps == 0 && scene.subdomain.is_whole()) tiling.steps = 6;
  const auto lowered = unrelax(scene.model.medium, *scene.attenuation);
  if (lowered.empty()) return {};
  return {lowered};
}

template <int D>
double stable_time_step_s(const Scene<D>& scene) {
  return scene.model.grid().spacing_m / fastest_across_cells(scene.model.medium, scene.subdomain);
}

template <int D>
double time_step_s(const Scene<D>& scene) {
  return scene.numerics.time_step_s ? *scene.numerics.time_step_s
                                    : scene.numerics.cfl * stable_time_step_s(scene);
}

double largest_cfl(const Numerics& numerics) { return numerics.time_order == 4 ? 2 : 1; }

/// Width of the PML of plane waves in wavelengths of the fastest wave at the frequency of the wavelet.
constexpr double plane_zone_wavelengths = 2. / 3;

template <int D>
int zone_cells(const Scene<D>& scene, const Source<D>& source) {
  constexpr int usual = 20;
  if (scene.numerics.zone_cells > 0) return scene.numerics.zone_cells;
  if (!std::holds_alternative<PlaneWave<D>>(source.mechanism)) return usual;
  const double wavelength_m =
      fastest_speed(scene.model.medium, scene.subdomain) / source.wavelet.nominal_hz();
  const double cells = std::ceil(plane_zone_wavelengths * wavelength_m / scene.model.grid().spacing_m);
  // The outermost hold the incident wave.
  return int(std::clamp(cells, double(usual), 10000.)) + reach_of(scene.numerics.order) + 1;
}

/// Sweeps back in time, and waves that turn with their row or cell, have no criterion of monotonicity.
template <int D>
void check_monotone(const Scene<D>& scene) {
  if (scene.numerics.time_order != 2)
    throw Error("found --monotone with --time-order " + std::to_string(scene.numerics.time_order) +
                    ", expected --time-order 2: sweeps back in time have no criterion of monotonicity",
                ErrorKind::usage);
  const auto& rows = scene.model.grid().rows;
  if (const auto curvilinear = rows ? rows->first_curvilinear_row() : std::nullopt)
    throw Error(
        "found --monotone in a model whose row " + std::to_string(*curvilinear) +
            " follows a horizon, expected level rows; build the model with --fit none --average isotropic",
        ErrorKind::usage);
  if (scene.subdomain.tilted_means || tilted_means(scene.model.medium) > 0)
    throw Error(
        "found --monotone in a model with cells that interfaces cut as tilted means, expected isotropic "
        "ones; "
        "use --without anisotropy, or build the model with --average isotropic",
        ErrorKind::usage);
  if (scene.subdomain.tilted || any_tilted_axes(scene.model.medium))
    throw Error(
        "found --monotone in a model with rock whose axes are tilted, expected axes along the grid; use "
        "--without anisotropy",
        ErrorKind::usage);
}

/// What does not go with fractures that part faces.
template <int D>
void check_split(const Scene<D>& scene) {
  const auto* const found = first_on_faces(scene.model.fracture_sets);
  if (!scene.with_slip || !found) return;
  const auto refuse = [&](const std::string& what, const std::string& wanted) {
    throw Error("found " + what + " in a model whose fractures '" + found->name +
                    "' lie on faces, expected " + wanted + "; or leave them out by --without slip",
                ErrorKind::usage);
  };
  if (scene.numerics.monotone) refuse("--monotone", "it without");
  if (scene.numerics.time_order != 2)
    refuse("--time-order " + std::to_string(scene.numerics.time_order), "--time-order 2");
}

template <int D>
void check(const Scene<D>& scene) {
  const auto& medium = scene.model.medium;
  bool any = false;
  for (std::size_t cell = 0; cell < medium.vp.size() && !any; ++cell) any = !medium.is_void(cell);
  if (!any && scene.subdomain.is_whole())
    throw Error("every cell of the model is void, expected rock or fluid");
  check_anisotropy(scene);
  if (scene.survey.sources.empty())
    throw Error(std::string("found no source, expected --source ") + (D == 2 ? "X,Z" : "X,Y,Z"),
                ErrorKind::usage);
  check(scene.survey, scene.subdomain.whole(scene.model.grid()));
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot) check_sources(scene, shot);
  placing(scene.survey, [&] {
    each_receiver<D>(scene.survey, [&](const Point<D>& receiver, std::size_t shot, std::size_t number) {
      refuse_void<D>(scene, receiver, [&] { return name_of_receiver(scene.survey, shot, number); });
    });
  });
  check_components<D>(scene.recording);
  if (scene.recording.fibre) placing(scene.survey, [&] { check_fibre(scene); });
  check_positive(scene.recording.duration_s, "--time", "s");
  check_positive(scene.recording.interval_s, "--dt", "s");
  check_count(scene.recording, "--dt", scene.recording.interval_s, "samples");
  check_within(scene.recording, "--dt", scene.recording.interval_s);
  if (scene.snapshot_every_s) {
    check_positive(*scene.snapshot_every_s, "--every", "s");
    check_count(scene.recording, "--every", *scene.snapshot_every_s, "snapshots");
    check_within(scene.recording, "--every", *scene.snapshot_every_s);
  }
  const auto& numerics = scene.numerics;
  if (!holds(orders, numerics.order))
    throw Error("found order " + std::to_string(numerics.order) + ", expected " + alternatives(orders),
                ErrorKind::usage);
  if (numerics.zone_cells < 0 || numerics.zone_cells > 10000)
    throw Error("found --edge-width " + std::to_string(numerics.zone_cells) + ", expected 0 to 10000 cells",
                ErrorKind::usage);
  if (!holds(time_orders, numerics.time_order))
    throw Error(
        "found time order " + std::to_string(numerics.time_order) + ", expected " + alternatives(time_orders),
        ErrorKind::usage);
  if (numerics.monotone) check_monotone(scene);
  check_split(scene);
  const double limit = stable_time_step_s(scene), largest = largest_cfl(numerics);
  if (numerics.time_step_s) {
    check_positive(*numerics.time_step_s, "--time-step", "s");
    if (*numerics.time_step_s > largest * limit * (1 + 1e-12))
      throw Error("found a time step of " + shown(*numerics.time_step_s) + " s, expected at most " +
                      (largest == 1 ? "" : shown(largest) + " ") + "h/vp_max = " + shown(largest * limit) +
                      " s",
                  ErrorKind::usage);
  } else if (!(numerics.cfl > 0) || numerics.cfl > largest) {
    throw Error("found --cfl " + shown(numerics.cfl) + ", expected above 0 and at most " + shown(largest) +
                    ": h/vp_max is " + shown(limit) + " s",
                ErrorKind::usage);
  }
  check_count(scene.recording, "a time step", time_step_s(scene), "steps");
}

template <int D>
SlowestWave slowest_wave(const Medium<D>& medium) {
  SlowestWave slowest;
  if (anisotropic_cells(medium) > 0) return slowest_wave(in_slowest_directions(medium));
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (medium.is_void(cell)) continue;
    const double speed = medium.is_fluid(cell) ? medium.vp[cell] : medium.vs[cell];
    if (slowest.speed == 0 || speed < slowest.speed) slowest = {speed, std::int64_t(cell)};
  }
  return slowest;
}

template <int D>
double highest_frequency_hz(const Survey<D>& survey) {
  double highest = 0;
  for (const auto& source : survey.sources)
    highest = std::max(highest, source.wavelet.highest_frequency_hz(0.1));
  return highest;
}

SLIPWAVE_INSTANTIATE_D(TYPE, struct Scene);
SLIPWAVE_INSTANTIATE_D(FUNCTION, with_model);
template Scene<2> in_cells_of(const Scene<2>&, const ModelInCells<2>&, double);
template Scene<3> in_cells_of(const Scene<3>&, const ModelInCells<3>&, double);
SLIPWAVE_INSTANTIATE_D(FUNCTION, set_attenuation);
SLIPWAVE_INSTANTIATE_D(FUNCTION, stable_time_step_s);
SLIPWAVE_INSTANTIATE_D(FUNCTION, time_step_s);
SLIPWAVE_INSTANTIATE_D(FUNCTION, zone_cells);
template void check(const Scene<2>&);
template void check(const Scene<3>&);
SLIPWAVE_INSTANTIATE_D(FUNCTION, slowest_wave);
SLIPWAVE_INSTANTIATE_D(FUNCTION, highest_frequency_hz);

}  // namespace slipwave
