// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solver/sweep/extension_errors.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// Below what single precision shows of a value, errors are rounding.
inline constexpr double least_error = 1e-9;

/// Returns by how much a velocity of slope 1 lies off below the free surface that a cell ends at, on side 1,
/// as it is recorded, or in the field that sources answer to, where sweeps along one axis give the slope
/// (theory.md (A23)). Empty where there are none or the steps are not known.
template <int D>
ExtensionErrors errors_below_surface(const Domain<D>& domain, const Index<D>& at, int axis, int along,
                                     int velocity, bool of_source);

/// Returns what a moment that adds to stress (i, j) of a solid with these weights, from cells round `centre`,
/// adds besides, below free surfaces: it takes away the errors with which strains there answer to it
/// (theory.md (A23a)). Empty in curvilinear rows.
template <int D>
std::vector<ValueWeight> moment_corrections(const Layout<D>& layout, const Domain<D>& domain,
                                            const Index<D>& centre, const std::vector<ValueWeight>& weights,
                                            int i, int j);

}  // namespace slipwave::solver
