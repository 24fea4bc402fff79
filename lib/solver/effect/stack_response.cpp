// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/stack_response.hpp"

#include <algorithm>
#include <utility>

#include "base/band_system.hpp"
#include "base/instantiate.hpp"
#include "rock/space_motion.hpp"

namespace slipwave::solver {
namespace {

using Complex = std::complex<double>;

/// Velocity and traction across level faces.
template <int D>
std::size_t velocity(int axis) {
  return std::size_t(FieldRows<D>::velocity(axis));
}
template <int D>
std::size_t traction(int axis) {
  return std::size_t(FieldRows<D>::stress(axis, D - 1));
}

std::vector<LayerWave<2>> waves_of(const Material& rock, const Point<2>& slowness, bool down) {
  return layer_waves(rock, slowness[0], down);
}
std::vector<LayerWave<3>> waves_of(const Material& rock, const Point<3>& slowness, bool down) {
  return layer_waves(rock, {slowness[0], slowness[1]}, down);
}

}  // namespace

template <int D, class Number>
WaveFields<D, Number> fields_of_motion(const Elasticity<D>& stiffness,
                                       const std::array<Number, std::size_t(D)>& slowness,
                                       const std::array<Number, std::size_t(D)>& velocity) {
  using Rows = FieldRows<D>;
  WaveFields<D, Number> fields{};
  const auto stress = stress_of_motion<D, Number>(stiffness, slowness, velocity);
  for (int i = 0; i < D; ++i) {
    fields[std::size_t(Rows::velocity(i))] = velocity[std::size_t(i)];
    for (int j = i; j < D; ++j) fields[std::size_t(Rows::stress(i, j))] = stress[Elasticity<D>::pair(i, j)];
  }
  return fields;
}
template WaveFields<2> fields_of_motion(const Elasticity<2>&, const Point<2>&, const Point<2>&);
template WaveFields<3> fields_of_motion(const Elasticity<3>&, const Point<3>&, const Point<3>&);

template <int D>
StackResponse<D>::StackResponse(LayerStack<D> stack) : stack_(std::move(stack)) {
  const auto& rocks = stack_.layers.rocks;
  const auto& p = stack_.slowness;
  const auto add = [&](std::size_t layer, bool down, Complex q,
                       const std::array<Complex, std::size_t(D)>& motion) {
    std::array<Complex, std::size_t(D)> slowness;
    std::copy(p.begin(), p.end(), slowness.begin());
    slowness.back() = q;
    waves_.push_back({{layer, reference_of(layer, down), q},
                      fields_of_motion<D, Complex>(elasticity_of<D>(rocks[layer]), slowness, motion)});
  };
  for (std::size_t layer = 0; layer < rocks.size(); ++layer) {
    first_wave_.push_back(waves_.size());
    for (const bool down : {true, false}) {
      if (comes_from_outside(layer, down)) continue;
      for (const auto& wave : waves_of(rocks[layer], p, down)) add(layer, down, wave.down, wave.motion);
    }
  }
  first_wave_.push_back(waves_.size());
  std::array<Complex, std::size_t(D)> motion;
  std::copy(stack_.motion.begin(), stack_.motion.end(), motion.begin());
  add(stack_.from_top ? 0 : rocks.size() - 1, stack_.from_top, p.back(), motion);
}

template <int D>
bool StackResponse<D>::comes_from_outside(std::size_t layer, bool down) const {
  if (down) return layer == 0 && stack_.ends[0] == EdgeLaw::absorbing;
  return layer + 1 == stack_.layers.rocks.size() && stack_.ends[1] == EdgeLaw::absorbing;
}

/// Returns the depth at which the amplitude of a wave is 1, in m: at the face that it leaves, in half-spaces
/// at their face.
template <int D>
double StackResponse<D>::reference_of(std::size_t layer, bool down) const {
  const double top = stack_.layers.depths_m[layer], bottom = stack_.layers.depths_m[layer + 1];
  if (comes_from_outside(layer, true)) return bottom;
  if (comes_from_outside(layer, false)) return top;
  return down ? top : bottom;
}

template <int D>
std::vector<Complex> StackResponse<D>::solve(Complex omega) const {
  // Equations of a face hold the waves of both its layers.
  BandSystem<std::size_t(4 * D)> equations(waves_.size() - 1);
  const auto& first = stack_.layers.rocks.front();
  const double unit = first.rho * first.vp;
  std::size_t row = 0;
  const auto value = [&](const Wave& wave, std::size_t field, double z) {
    const auto decay = std::exp(Complex(0, -1) * omega * wave.slowness * (z - wave.reference_m));
    return wave.fields[field] * decay / (field < std::size_t(D) ? 1 : unit);
  };
  const auto add_of_layer = [&](std::size_t field, double z, std::size_t layer, double sign) {
    for (auto n = first_wave_[layer]; n < first_wave_[layer + 1]; ++n)
      equations.at(row, n) += sign * value(waves_[n], field, z);
    if (waves_.back().layer == layer) equations.right(row) -= sign * value(waves_.back(), field, z);
  };
  const auto vanishes = [&](std::size_t field, double z, std::size_t layer) {
    add_of_layer(field, z, layer, 1);
    ++row;
  };
  const auto end = [&](std::size_t layer, EdgeLaw law, double z) {
    if (law == EdgeLaw::absorbing) return;
    vanishes(law == EdgeLaw::free ? traction<D>(D - 1) : velocity<D>(D - 1), z, layer);
    for (int axis = 0; axis < D - 1 && solid(layer); ++axis)
      vanishes(law == EdgeLaw::rigid ? velocity<D>(axis) : traction<D>(axis), z, layer);
  };
  const auto face = [&](std::size_t above, double z) {
    const bool welded = solid(above) && solid(above + 1);
    for (int axis = D - 1; axis >= 0; --axis) {
      for (const auto field : {velocity<D>(axis), traction<D>(axis)}) {
        if (axis < D - 1 && !welded) continue;
        add_of_layer(field, z, above, 1);
        add_of_layer(field, z, above + 1, -1);
        ++row;
      }
      for (const auto layer : {above, above + 1})
        if (axis < D - 1 && !welded && solid(layer)) vanishes(traction<D>(axis), z, layer);
    }
  };
  const auto& depths = stack_.layers.depths_m;
  end(0, stack_.ends[0], depths.front());
  for (std::size_t n = 0; n + 1 < stack_.layers.rocks.size(); ++n) face(n, depths[n + 1]);
  end(stack_.layers.rocks.size() - 1, stack_.ends[1], depths.back());
  auto amplitudes = equations.solve();
  amplitudes.emplace_back(1);
  return amplitudes;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class StackResponse);

}  // namespace slipwave::solver
