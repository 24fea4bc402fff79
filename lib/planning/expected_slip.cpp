#include "planning/expected_slip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
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
    return set + "can not slip: the shear traction of the waves, about " + shown(of.under.traction_pa, 2) +
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

template std::vector<std::string> expected_slip(const Scene<2>&);
template std::vector<std::string> expected_slip(const Scene<3>&);

}  // namespace slipwave
