// SPDX-License-Identifier: BSD-3-Clause
#include "planning/expected_slip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/tensor.hpp"
#include "model/slip_regime.hpp"

namespace slipwave {
namespace {

/// Beyond this, either way, planes stick or are dry, however rough the amplitude is.
constexpr double far_from = 30;

/// The largest component of a force or a moment.
template <std::size_t N>
double largest_of(const std::array<double, N>& components) {
  double largest = 0;
  for (const double value : components) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Peak strain rate of the waves of a source in a cell, 1/s: of a plane wave its own, else that of P waves in
/// the far field, of 2-D sources cylindrical and of 3-D ones spherical.
template <int D>
double strain_rate_at(const Scene<D>& scene, const Source<D>& source, std::size_t cell, double hz) {
  const auto& model = scene.model;
  const double vp = double(model.medium.vp[cell]), rho = double(model.medium.rho[cell]);
  const double omega = 2 * std::numbers::pi * hz, k = omega / vp;
  const auto injection = point_injection(source);
  if (!injection) return std::abs(source.amplitude) * k;
  const auto at = model.grid().index(std::int64_t(cell));
  double square = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double there = axis + 1 == D ? model.grid().depth(at) : model.grid().centre(int(axis), at[axis]);
    square += std::pow(there - source.position_m[axis], 2);
  }
  const double distance = std::max(std::sqrt(square), 1 / k);
  const double spreading = D == 2 ? 0.25 * std::sqrt(2 / (std::numbers::pi * k * distance))
                                  : 1 / (4 * std::numbers::pi * distance);
  const double force = largest_of(injection->force), moment_rate = largest_of(injection->moment_rate.values);
  return k * (force * omega + moment_rate * k) * spreading / (rho * vp * vp);
}

/// Returns the direction in which a wave of a source travels in a cell, as a unit vector.
template <int D>
Point<D> direction_at(const Scene<D>& scene, const Source<D>& source, std::size_t cell) {
  if (const auto* plane = std::get_if<PlaneWave<D>>(&source.mechanism)) return plane->direction;
  const auto at = scene.model.grid().index(std::int64_t(cell));
  Point<D> way;
  for (std::size_t axis = 0; axis < D; ++axis)
    way[axis] =
        (axis + 1 == D ? scene.model.grid().depth(at) : scene.model.grid().centre(int(axis), at[axis])) -
        source.position_m[axis];
  const double size = std::max(length<D, double>(way), 1e-9);
  for (auto& part : way) part /= size;
  return way;
}

/// Stress of a wave of that strain, pressing where it presses most. Of S waves, polarized in the vertical
/// plane of travel, the sign is free.
template <int D>
SymmetricTensor<D, double> stress_of_wave(const Point<D>& n, bool shear, double strain, double lambda,
                                          double mu) {
  Point<D> polar = n;
  if (shear) {
    const double level = std::sqrt(std::max(0., 1 - n[D - 1] * n[D - 1]));
    for (std::size_t axis = 0; axis + 1 < D; ++axis)
      polar[axis] = level > 1e-9 ? n[axis] / level * n[D - 1] : axis == 0 ? n[D - 1] : 0;
    polar[D - 1] = -level;
  }
  SymmetricTensor<D, double> stress;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      const auto a = std::size_t(i), b = std::size_t(j);
      stress(i, j) = -strain * ((i == j && !shear ? lambda : 0) + mu * (n[a] * polar[b] + polar[a] * n[b]));
    }
  return stress;
}

/// Planes that slide while they are pressed, and what becomes of the shortest waves along them.
struct Growth {
  double exponent = 0;              // within half a period, in waves of growing_cells cells
  double bounding_viscosity_s = 0;  // with which it is 1 at most in waves of any length
};
/// Waves of so many cells are the shortest that the scheme does not damp.
constexpr double growing_cells = 8;

/// Returns the growth of one system in a cell under a wave; nothing where it does not slide, or viscosity
/// bounds the growth.
template <int D>
Growth growth_of(const Model<D>& model, std::size_t cell, const SlipSystem<D>& system,
                 SymmetricTensor<D, double> stress, double hz, const BandGrowth& shortest) {
  for (std::size_t c = 0; c < model.prestress_pa.size(); ++c)
    stress.values[c] += double(model.prestress_pa[c][cell]);
  Point<D> tau{};
  const double normal = resolve<D, double>(system.normal, stress, tau);
  const double strength = system.friction * std::max(-normal, 0.) + system.strength_pa;
  if (!(normal < 0) || length<D, double>(tau) <= strength) return {};
  const double mu = double(model.medium.rho[cell]) * std::pow(double(model.medium.vs[cell]), 2),
               half_s = 0.5 / hz, relaxation_s = system.viscosity_s * strength / mu;
  const double dry = 2 * std::numbers::pi / (growing_cells * model.grid().spacing_m) * shortest.dry_m_s;
  if (relaxation_s * dry > shortest.relaxing) return {};
  return {dry * half_s, shortest.relaxing * half_s * mu / strength};
}

/// What can be said of one family of planes in one cell.
struct Regime {
  double traction_over_strength, viscosity_over_competing;
  PlanesUnderWave under;
};

std::string sentence(const std::string& name, double viscosity_s, const Regime& of) {
  const std::string set = "fractures '" + name + "' ";
  const std::string remedy = "; slip competes with the waves at a viscosity of about " +
                             shown(of.under.competing_viscosity_s, 2) + " s (sw-fracture --for-frequency)";
  if (of.traction_over_strength < 1 / far_from)
    return set + "cannot slip: the shear traction of the waves, about " + shown(of.under.traction_pa, 2) +
           " Pa, is far below the strength of " + shown(of.under.strength_pa, 2) + " Pa";
  if (of.viscosity_over_competing > far_from)
    return set + "hardly slip: their viscosity of " + shown(viscosity_s, 3) + " s is too large" + remedy;
  if (of.viscosity_over_competing < 1 / far_from)
    return set + "slip like dry friction: their viscosity of " + shown(viscosity_s, 3) +
           " s makes no difference" + remedy;
  return "";
}

}  // namespace

template <int D>
std::vector<std::string> expected_slip(const Scene<D>& scene) {
  std::vector<std::string> sentences;
  if (!scene.slips() || scene.survey.sources.empty()) return sentences;
  const auto& source = scene.survey.sources.front();
  const double hz = source.wavelet.nominal_hz();
  for (std::size_t code = 1; code <= scene.model.fracture_sets.size(); ++code) {
    const auto& set = scene.model.fracture_sets[code - 1];
    // The cell where slip is most likely speaks for the set.
    std::optional<Regime> most;
    double viscosity_s = 0;
    for (std::size_t cell = 0; cell < scene.model.fracture.size(); ++cell) {
      if (scene.model.fracture[cell] != code) continue;
      const WaveOnPlanes wave = {hz, strain_rate_at(scene, source, cell, hz)};
      for (const auto& system : set.systems) {
        if (!system.slides()) continue;
        const auto under = planes_under(scene.model, cell, system, wave);
        if (!(under.strength_pa > 0)) continue;
        const Regime here = {under.traction_pa / under.strength_pa,
                             system.viscosity_s / under.competing_viscosity_s, under};
        if (most && most->traction_over_strength / std::max(most->viscosity_over_competing, 1.) >=
                        here.traction_over_strength / std::max(here.viscosity_over_competing, 1.))
          continue;
        most = here;
        viscosity_s = system.viscosity_s;
      }
    }
    const auto text = most ? sentence(set.name, viscosity_s, *most) : "";
    if (!text.empty()) sentences.push_back(text);
  }
  return sentences;
}

template <int D>
std::vector<std::string> cell_dependence(const Scene<D>& scene) {
  std::vector<std::string> sentences;
  if (!scene.slips() || scene.survey.sources.empty()) return sentences;
  const auto& model = scene.model;
  const auto& source = scene.survey.sources.front();
  const auto* plane = std::get_if<PlaneWave<D>>(&source.mechanism);
  const double hz = source.wavelet.nominal_hz();
  for (std::size_t code = 1; code <= model.fracture_sets.size(); ++code) {
    Growth most;
    const SlipSystem<D>* fastest = nullptr;
    std::map<std::array<double, 3>, BandGrowth> known;
    for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
      if (model.fracture[cell] != code) continue;
      const double vp = double(model.medium.vp[cell]), vs = double(model.medium.vs[cell]),
                   mu = double(model.medium.rho[cell]) * vs * vs,
                   lambda = double(model.medium.rho[cell]) * vp * vp - 2 * mu;
      const double strain = strain_rate_at(scene, source, cell, hz) / (2 * std::numbers::pi * hz);
      const auto stress =
          stress_of_wave<D>(direction_at(scene, source, cell), plane && plane->shear, strain, lambda, mu);
      for (const auto& system : model.fracture_sets[code - 1].systems) {
        if (!system.slides() || !(system.friction > 0)) continue;
        const auto [shortest, is_new] = known.try_emplace({system.friction, vp, vs});
        if (is_new) shortest->second = band_growth(system.friction, vp, vs);
        const auto growth = growth_of(model, cell, system, stress, hz, shortest->second);
        if (growth.exponent > most.exponent) most = growth, fastest = &system;
      }
    }
    if (most.exponent < 1) continue;
    sentences.push_back("fractures '" + model.fracture_sets[code - 1].name +
                        "' slide under the pressure of the waves, and their viscosity of " +
                        shown(fastest->viscosity_s, 3) + " s does not bound how short waves then grow: in " +
                        shown(growing_cells) + " cells by a factor of exp(" + shown(most.exponent, 2) +
                        ") within half a period, in smaller cells more; a viscosity of " +
                        shown(most.bounding_viscosity_s, 2) + " s would");
  }
  return sentences;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, cell_dependence);
SLIPWAVE_INSTANTIATE_D(FUNCTION, expected_slip);

}  // namespace slipwave
