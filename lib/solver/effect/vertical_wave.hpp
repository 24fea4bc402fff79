// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "solver/effect/incident_wave.hpp"

namespace slipwave::solver {

/// The incident wave of a 2-D plane wave that travels straight down or up: along each absorbing side that
/// which the column of cells there lets through, computed with the scheme itself. It costs as much as two
/// columns, leaves nothing of the scheme's errors in the scattered field, and both sides may be of different
/// layers. `entering` is the wave in the medium of the boundary that it enters by.
template <class Real>
std::unique_ptr<IncidentWave<2, Real>> make_vertical_wave(const Scene<2>& scene, const Source<2>& source,
                                                          std::unique_ptr<IncidentWave<2, Real>> entering,
                                                          const Domain<2>& domain, double dt_s);

}  // namespace slipwave::solver
