// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/model.hpp"

namespace slipwave {

/// A wave as cells of fractures feel it.
struct WaveOnPlanes {
  double hz, strain_rate;  // peak, 1/s
};

/// What planes of a cell have against a wave.
struct PlanesUnderWave {
  double strength_pa = 0;            // S: under the prestress, or else under the wave's own pressure
  double traction_pa = 0;            // the wave's shear traction, mu times its strain, at most
  double competing_viscosity_s = 0;  // with which 2 pi f eta S = mu (S24); 0 without strength
};

/// The pressure of the wave is lambda + 2 mu times its strain; springs below the friction count.
template <int D>
PlanesUnderWave planes_under(const Model<D>& model, std::size_t cell, const SlipSystem<D>& system,
                             const WaveOnPlanes& wave);

/// The viscosity at which slip competes with a wave in the middle one of the cells of set `code` (1-based):
/// an excess over the strength decays within a radian of the wave. A tenth of it is near dry friction, ten
/// times as much hardly slips. Throws a usage Error where the planes have no strength.
template <int D>
PlanesUnderWave competing_slip(const Model<D>& model, std::size_t code, const WaveOnPlanes& wave);

/// How fast the shortest waves along dry or viscous planes grow that slide under pressure (theory.md (S29)),
/// in the direction in which they grow fastest.
struct BandGrowth {
  double dry_m_s = 0;   // of dry planes: growth rate over wave number
  double relaxing = 0;  // of viscous ones: growth rate times relaxation time, of the shortest waves
};
BandGrowth band_growth(double friction, double vp, double vs);

}  // namespace slipwave
