#pragma once

#include <optional>
#include <string>

#include "scene/scene.hpp"
#include "solver/record/stability_check.hpp"
#include "solver/simulation.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// What a cell of the computed grid is made of and which effects of the shot are in it or within ten cells,
/// nearest first: "vp=3000 vs=1700 rho=2300, in fracture set cracks, 5 m from an interface".
template <int D>
std::string surroundings(const Scene<D>& scene, const Domain<D>& domain, std::size_t shot,
                         const Index<D>& at);

/// The first step at whose end the fields have diverged, and where. For that the shot is simulated again from
/// its beginning and checked after every step from the last check on that passed. Nothing where that would
/// take more than `most_again` cell steps.
template <int D, class Real>
std::optional<DivergedFields<D>> first_divergence(const Scene<D>& scene, std::size_t shot,
                                                  const Divergence<D>& seen, bool snapshots);
constexpr double most_again = 2e9;  // about ten seconds of a core

}  // namespace slipwave::solver
