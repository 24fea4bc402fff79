// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "rock/medium.hpp"

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

/// qs and qp of solids from vs in m/s, both at least 5; infinite elsewhere. Rules:
///   vs/N     qs = vs/N, qp = 2 qs
///   olsen    qs = 0.02 vs below 1500 m/s, else 0.1 vs, qp = 1.5 qs (Olsen, Day & Bradley 2003)
///   brocher  qs = -16 + 104.13 v - 25.225 v^2 + 8.2184 v^3 with v = vs/1000, 13 below 300 m/s, qp = 2 qs
///            (Brocher 2008)
/// qp is never more than shear loss alone makes it, 3/4 (vp/vs)^2 qs. Throws a usage Error for another rule.
template <int D>
void add_q_from_vs(Medium<D>& medium, const std::string& rule);

/// An optional property that is the same everywhere; a qs in solids only.
template <int D>
void add_constant(Medium<D>& medium, Property property, double value);

}  // namespace slipwave
