#pragma once

#include <memory>

#include "scene/scene.hpp"
#include "solver/domain.hpp"
#include "solver/pass.hpp"

namespace slipwave::solver {

/// What a point source puts in, half before and half after the recorder, so that the
/// fields it sees lie in the middle (trapezoidal rule in time). Keeps a reference to the state.
template <int D, class Real>
std::unique_ptr<Pass> make_source_pass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                       const Source<D>& source, double unit);

}  // namespace slipwave::solver
