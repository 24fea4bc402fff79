// SPDX-License-Identifier: BSD-3-Clause
#include "scene/largest_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "grid/tensor.hpp"
#include "model/split_faces.hpp"

namespace slipwave {
namespace {

/// Factor on the largest velocity that the energy allows, up to which fields count as a wave.
constexpr double to_spare = 100;

template <int D>
double length(const SymmetricTensor<D, double>& tensor) {
  double sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += tensor(i, j) * tensor(i, j);
  return std::sqrt(sum);
}

/// Steps that a run takes after the last sample, which is interpolated between them, at most.
constexpr double steps_beyond = 8;

/// The strength of the wavelet up to some time: its integral, taken positive, in s, and its largest value.
struct Strength {
  double integral_s = 0, largest = 0;
};

Strength strength_of(const Wavelet& wavelet, double duration_s, double dt_s) {
  Strength strength;
  const double last_s = std::min(wavelet.duration_s(), duration_s);
  for (double t_s = 0; t_s <= last_s + dt_s; t_s += dt_s) {
    const double value = std::abs(wavelet(t_s));
    strength.integral_s += value * dt_s;
    strength.largest = std::max(strength.largest, value);
  }
  return strength;
}

}  // namespace

template <int D>
double largest_velocity(const Scene<D>& scene, std::size_t shot, Ranks* ranks) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const double dt_s = time_step_s(scene), cube = std::pow(grid.spacing_m, D);
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (std::size_t cell = 0; cell < std::size_t(grid.size()); ++cell) {
    if (medium.is_void(cell)) continue;
    lightest = std::min(lightest, double(medium.rho[cell]));
    heaviest = std::max(heaviest, double(medium.rho[cell]));
  }
  lightest = smallest_of(ranks, lightest);
  heaviest = largest_of(ranks, heaviest);
  // Velocities that all energy of a kind would give to a cell of the lightest material; they add up at most.
  double sum = 0;
  for (const auto* each : scene.survey.sources_of(shot)) {
    const auto& source = *each;
    const auto injection = point_injection(source);
    // At t = 0 all of the wavelet may already stand in the model as a plane wave.
    const auto strength = strength_of(
        source.wavelet,
        injection ? scene.recording.duration_s + steps_beyond * dt_s : source.wavelet.duration_s(), dt_s);
    if (injection) {
      if (scene.subdomain.owns(grid, source.position_m)) {
        const auto at = cell_of(grid, source.position_m);
        const auto cell = std::size_t(grid.flat(at));
        const double volume = cube * (grid.height(at) / grid.spacing_m);
        const double rho = medium.rho[cell], c = medium.is_solid(cell) ? medium.vs[cell] : medium.vp[cell];
        const double in_cell =
            strength.integral_s / volume *
            (length<D>(injection->force) / rho + length<D>(injection->moment_rate) / (rho * c));
        sum += in_cell * std::sqrt(rho / lightest);
      }
    } else {
      double cells = double(grid.size()), through_edges = 0;
      for (const auto n : grid.shape) through_edges += 2 * cells / double(n);
      const double steps = scene.recording.duration_s / dt_s;
      sum += std::abs(source.amplitude) * strength.largest *
             std::sqrt(2 * heaviest / lightest * (cells + steps * through_edges));
    }
  }
  double energy_over_volume = 0;
  // Of planes on faces the cells beside them have the stress.
  const bool of_faces = scene.with_slip && first_on_faces(scene.model.fracture_sets);
  if ((scene.slips() || of_faces) && !scene.model.prestress_pa.empty())
    for (std::size_t cell = 0; cell < std::size_t(grid.size()); ++cell) {
      if (!of_faces && scene.model.fracture[cell] == 0) continue;
      if (!scene.subdomain.owns(grid, grid.index(std::int64_t(cell))[D - 1])) continue;
      double squares = 0;
      for (const auto& component : scene.model.prestress_pa)
        squares += double(component[cell]) * component[cell];
      energy_over_volume += squares / (double(medium.rho[cell]) * medium.vs[cell] * medium.vs[cell]);
    }
  sum = sum_of(ranks, sum) + std::sqrt(2 * sum_of(ranks, energy_over_volume) / lightest);
  return to_spare * sum;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, largest_velocity);

}  // namespace slipwave
