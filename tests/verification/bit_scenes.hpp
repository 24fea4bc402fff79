// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave::solver {

/// A scene whose outcome is the same to the last bit whoever computes it and however its work is cut. `name`
/// is of letters and digits. In the long form (SLIPWAVE_LONG) it is larger and longer.
struct BitScene {
  std::string name;
  std::function<std::variant<Scene<2>, Scene<3>>()> make;
  friend void PrintTo(const BitScene& of, std::ostream* to) { *to << of.name; }
};

/// One for each path through the solver.
std::vector<BitScene> bit_scenes();

/// Calls body with every scene of either dimension.
template <class Body>
void with_scene(const BitScene& of, Body&& body) {
  std::visit(body, of.make());
}

/// Takes away the effect that a scene is there for, if it is there for one.
template <int D>
bool remove_effect_of(Scene<D>& scene);

}  // namespace slipwave::solver
