// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/space_stack.hpp"

#include <utility>

#include "base/band_system.hpp"

namespace slipwave::solver {
namespace {

using Rows = FieldRows<3>;
using Complex = std::complex<double>;

/// Equations of a face hold the waves of both its layers.
using SpaceEquations = BandSystem<12>;

/// Velocity and traction across level faces, along x, y and z.
std::size_t velocity(int axis) { return std::size_t(Rows::velocity(axis)); }
std::size_t traction(int axis) {
  return std::size_t(axis == 2 ? Rows::normal_stress(2) : Rows::shear_stress(axis, 2));
}

template <class Number>
std::array<Number, std::size_t(Rows::count)> nine_fields(const Elasticity<3>& stiffness,
                                                         const std::array<Number, 3>& slowness,
                                                         const std::array<Number, 3>& motion) {
  std::array<Number, std::size_t(Rows::count)> fields{};
  const auto stress = stress_of_motion<Number>(stiffness, slowness, motion);
  for (int i = 0; i < 3; ++i) {
    fields[velocity(i)] = motion[std::size_t(i)];
    fields[std::size_t(Rows::normal_stress(i))] = stress[std::size_t(i)];
    for (int j = i + 1; j < 3; ++j)
      fields[std::size_t(Rows::shear_stress(i, j))] = stress[Elasticity<3>::pair(i, j)];
  }
  return fields;
}

}  // namespace

SpaceFields fields_of_motion(const Elasticity<3>& stiffness, const Point<3>& slowness,
                             const Point<3>& velocity) {
  return nine_fields<double>(stiffness, slowness, velocity);
}

SpaceStackResponse::SpaceStackResponse(SpaceStack stack) : stack_(std::move(stack)) {
  const auto& layers = stack_.column.layers;
  const auto& p = stack_.slowness;
  const auto add = [&](std::size_t layer, bool down, Complex q, const std::array<Complex, 3>& motion) {
    waves_.push_back({{layer, reference_of(layer, down), q},
                      nine_fields<Complex>(elasticity_of<3>(layers[layer]), {p[0], p[1], q}, motion)});
  };
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    first_wave_.push_back(waves_.size());
    for (const bool down : {true, false}) {
      if (comes_from_outside(layer, down)) continue;
      for (const auto& wave : layer_waves(layers[layer], {p[0], p[1]}, down))
        add(layer, down, wave.down, wave.motion);
    }
  }
  first_wave_.push_back(waves_.size());
  const auto& m = stack_.motion;
  add(stack_.from_top ? 0 : layers.size() - 1, stack_.from_top, p[2], {m[0], m[1], m[2]});
}

bool SpaceStackResponse::comes_from_outside(std::size_t layer, bool down) const {
  if (down) return layer == 0 && stack_.ends[0] == EdgeLaw::absorbing;
  return layer + 1 == stack_.column.layers.size() && stack_.ends[1] == EdgeLaw::absorbing;
}

/// Where the amplitude of a wave is 1: at the face that it leaves, in half-spaces at their face.
double SpaceStackResponse::reference_of(std::size_t layer, bool down) const {
  const double top = stack_.column.depths_m[layer], bottom = stack_.column.depths_m[layer + 1];
  if (comes_from_outside(layer, true)) return bottom;
  if (comes_from_outside(layer, false)) return top;
  return down ? top : bottom;
}

std::vector<Complex> SpaceStackResponse::solve(Complex omega) const {
  SpaceEquations equations(waves_.size() - 1);
  const auto& first = stack_.column.layers.front();
  const double unit = first.rho * first.vp;
  std::size_t row = 0;
  const auto value = [&](const Wave& wave, std::size_t field, double z) {
    const auto decay = std::exp(Complex(0, -1) * omega * wave.slowness * (z - wave.reference_m));
    return wave.fields[field] * decay / (field < 3 ? 1 : unit);
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
    vanishes(law == EdgeLaw::free ? traction(2) : velocity(2), z, layer);
    for (int axis = 0; axis < 2 && solid(layer); ++axis)
      vanishes(law == EdgeLaw::rigid ? velocity(axis) : traction(axis), z, layer);
  };
  const auto face = [&](std::size_t above, double z) {
    const bool welded = solid(above) && solid(above + 1);
    for (int axis = 2; axis >= 0; --axis) {
      for (const auto field : {velocity(axis), traction(axis)}) {
        if (axis < 2 && !welded) continue;
        add_of_layer(field, z, above, 1);
        add_of_layer(field, z, above + 1, -1);
        ++row;
      }
      for (const auto layer : {above, above + 1})
        if (axis < 2 && !welded && solid(layer)) vanishes(traction(axis), z, layer);
    }
  };
  const auto& depths = stack_.column.depths_m;
  end(0, stack_.ends[0], depths.front());
  for (std::size_t n = 0; n + 1 < stack_.column.layers.size(); ++n) face(n, depths[n + 1]);
  end(stack_.column.layers.size() - 1, stack_.ends[1], depths.back());
  auto amplitudes = equations.solve();
  amplitudes.emplace_back(1);
  return amplitudes;
}

}  // namespace slipwave::solver
