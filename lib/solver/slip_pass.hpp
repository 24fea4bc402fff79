#pragma once

#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "solver/domain.hpp"
#include "solver/pass.hpp"

namespace slipwave::solver {

/// The slip correction of all fracture cells at the end of a step (theory.md (S4)), in the order the scene
/// asks for. Cells of the absorbing zones do not slip. Keeps a reference to the state.
template <int D, class Real>
std::unique_ptr<Pass> make_slip_pass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                     double dt_s);

/// Numbers of the lines that hold fracture cells, ascending.
template <int D>
std::vector<std::int64_t> fracture_lines(const Layout<D>& layout, const Domain<D>& domain,
                                         const Model<D>& model);

}  // namespace slipwave::solver
