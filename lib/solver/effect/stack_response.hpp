// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "rock/elasticity.hpp"
#include "scene/edges.hpp"
#include "scene/plane_wave.hpp"
#include "solver/effect/stack_series.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The fields of a D-dimensional state, in the order of its rows.
template <int D, class Number = double>
using WaveFields = std::array<Number, std::size_t(FieldRows<D>::count)>;

/// Fields of a wave of a slowness and velocity in a rock, s/m and m/s.
template <int D, class Number>
WaveFields<D, Number> fields_of_motion(const Elasticity<D>& stiffness,
                                       const std::array<Number, std::size_t(D)>& slowness,
                                       const std::array<Number, std::size_t(D)>& velocity);

/// A stack of layers of any symmetry on which a plane wave falls; the first and the last are half-spaces
/// where their end absorbs. A layer is fluid where vs = 0.
template <int D>
struct LayerStack {
  LevelLayers layers;
  std::array<EdgeLaw, 2> ends{};  // of top and bottom
  bool from_top = true;
  Point<D> slowness{}, motion{};  // of the incident wave, s/m and of unit size
};

/// All waves in such a stack for one angular frequency, D a rock down and up, one a fluid, by continuity of
/// motion and traction at all interfaces (theory.md (A16), (A18)). They are per unit of the incident wave's
/// particle velocity at the first interface it comes to, or the end where there is none. The time factor is
/// exp(i omega t); omega may lie below the real axis.
template <int D>
class StackResponse {
 public:
  using Complex = std::complex<double>;
  explicit StackResponse(LayerStack<D> stack);
  /// Amplitudes of all waves(); the last is that of the incident wave.
  std::vector<Complex> solve(Complex omega) const;
  struct Wave : StackWave {
    WaveFields<D, Complex> fields;
  };
  const std::vector<Wave>& waves() const { return waves_; }
  const LayerStack<D>& stack() const { return stack_; }
  /// The depth at which the amplitude of the incident wave is 1.
  double reference_m() const { return waves_.back().reference_m; }

 private:
  bool comes_from_outside(std::size_t layer, bool down) const;
  double reference_of(std::size_t layer, bool down) const;
  bool solid(std::size_t layer) const { return stack_.layers.rocks[layer].vs > 0; }

  LayerStack<D> stack_;
  std::vector<Wave> waves_;
  std::vector<std::size_t> first_wave_;  // of each layer and behind the last
};

}  // namespace slipwave::solver
