// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/scene.hpp"

namespace slipwave {

/// A scene whose traces are known in closed form: a line force along z, Ricker 30 Hz, at the centre of a
/// square of 4980 m of vp 4500, vs 2250, rho 2500, in cells of 5 m; vx and vz for 0.76 s at 10 and 20
/// dominant S wavelengths (750 and 1500 m) along four azimuths. Nothing comes back from the edges in that
/// time.
Scene<2> full_space_case();

/// Its traces at the scene's sampling, by Hankel functions in the frequency domain,
///   u_i = F [g_s delta_iz + (g_s - g_p),iz/ks^2]/mu,   g = H0(2)(k r)/(4 i),
/// exact to 1e-6 of the peak.
Gather full_space_traces();

}  // namespace slipwave
