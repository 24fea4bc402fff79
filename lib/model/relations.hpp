#pragma once

#include "grid/field.hpp"

namespace slipwave {

/// Density of water that rho_by_gardner puts where vs = 0.
inline constexpr float water_density = 1000;

/// vs = (vp - 1360 m/s) / 1.16, the mud-rock line (Castagna, Batzle & Eastwood 1985, eq. 1), in solids; 0
/// where vp is at most `fluid_vp`.
template <int D>
Field<D> vs_by_castagna(const Field<D>& vp, double fluid_vp = 1500);

/// rho = 310 vp^(1/4) kg/m3, vp in m/s (Gardner, Gardner & Gregory 1974), in solids; `water_density` where vs
/// = 0; 0 where vp = 0 (void).
template <int D>
Field<D> rho_by_gardner(const Field<D>& vp, const Field<D>& vs);

}  // namespace slipwave
