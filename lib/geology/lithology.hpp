// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rock/averaging.hpp"

namespace slipwave {

enum class Lithology { shale, sand, limestone, evaporite };

/// A pore fluid.
struct Fluid {
  double bulk_modulus_pa = 0;
  double rho = 0;  // kg/m3
};

// At some 1.5 km of burial, after the relations of Batzle & Wang (1992, Geophysics 57, 1396-1408).
inline constexpr Fluid brine{2.6e9, 1030};
inline constexpr Fluid oil{1.0e9, 780};
inline constexpr Fluid gas{0.04e9, 150};

/// vs in m/s of rock full of brine with P speed `vp`: the mud-rock line vs = 0.8621 vp - 1172.4 m/s
/// (Castagna, Batzle & Eastwood 1985) for shale, 0.80416 vp - 855.9 m/s for sand and
/// -0.05508e-3 vp^2 + 1.0168 vp - 1030.5 m/s for limestone (Greenberg & Castagna 1992), vp/sqrt(3) for
/// evaporites. At least vp/5, about what soft sediments have at the sea floor (Hamilton 1979, J. Acoust. Soc.
/// Am. 66, 1093-1101), where those lines lead too low.
double vs_of(Lithology rock, double vp);

/// Density in kg/m3 by Gardner's relation d (vp/km/s)^f with the constants of the lithology (Castagna, Batzle
/// & Kan 1993): d = 1750, f = 0.265 for shale; 1660, 0.261 for sand; 1359, 0.386 for limestone. Evaporites
/// have 2140, the density of salt.
double density_of(Lithology rock, double vp);

/// Rock full of brine: vp, vs_of(), density_of().
Material brine_saturated(Lithology rock, double vp);

/// Sand with its brine replaced by another fluid, by Gassmann's relation (1951; Smith, Sondergeld & Rai 2003,
/// eq. 1): mu stays, the bulk modulus K of the saturated rock goes by
///     K/(K0 - K) - Kf/(phi (K0 - Kf)) = the same before and after,
/// with grains of K0 = 36.6 GPa and 2650 kg/m3 and the porosity phi that the density implies, kept within
/// 0.02 to 0.4. The dry frame's bulk modulus is at least 0.9 mu, as in clean sand (Murphy, Reischer & Hsu
/// 1993).
Material with_fluid(const Material& sand, const Fluid& fluid);

}  // namespace slipwave
