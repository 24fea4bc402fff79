// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "model/space_motion.hpp"
#include "scene/edges.hpp"
#include "solver/effect/layered_wave.hpp"
#include "solver/effect/stack_series.hpp"

namespace slipwave::solver {

/// The nine fields of a 3-D state, in the order of its rows.
using SpaceFields = std::array<double, std::size_t(FieldRows<3>::count)>;

/// Fields of a wave of a slowness and velocity in a rock, s/m and m/s.
SpaceFields fields_of_motion(const Elasticity<3>& stiffness, const Point<3>& slowness,
                             const Point<3>& velocity);

/// A plane wave of any direction that falls on layers of any symmetry.
struct SpaceStack {
  ColumnOfLayers column;
  std::array<EdgeLaw, 2> ends{};  // of top and bottom
  bool from_top = true;
  Point<3> slowness{}, motion{};  // of the incident wave, s/m and of unit size
};

/// All waves in such a stack for one angular frequency, as PlaneStackResponse has those of a plane: three a
/// rock down and up, one a fluid (theory.md (A18)).
class SpaceStackResponse {
 public:
  using Complex = std::complex<double>;
  explicit SpaceStackResponse(SpaceStack stack);
  /// Amplitudes of all waves(); the last is that of the incident wave.
  std::vector<Complex> solve(Complex omega) const;
  struct Wave : StackWave {
    std::array<Complex, std::size_t(FieldRows<3>::count)> fields;
  };
  const std::vector<Wave>& waves() const { return waves_; }
  const SpaceStack& stack() const { return stack_; }

 private:
  bool comes_from_outside(std::size_t layer, bool down) const;
  double reference_of(std::size_t layer, bool down) const;
  bool solid(std::size_t layer) const { return stack_.column.layers[layer].vs > 0; }

  SpaceStack stack_;
  std::vector<Wave> waves_;
  std::vector<std::size_t> first_wave_;  // of each layer and behind the last
};

}  // namespace slipwave::solver
