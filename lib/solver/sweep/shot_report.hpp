#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace slipwave {

/// The work of slip, summed over cells (theory.md 2.3); energies in J, per metre in 2-D.
struct SlipTotals {
  std::int64_t cells = 0, slipped = 0;  // fractured ones, and those that slipped at any time
  double dissipated = 0;                // turned into heat on the planes
  double out_of_waves = 0;              // its share from the waves, the rest came from the prestress
};

/// The energy balance of a shot, J (2-D: J per metre).
struct ShotReport {
  std::optional<SlipTotals> slip;
  std::optional<double> source_work;  // of point sources
  double energy_left = 0;             // kinetic and elastic, in rock and springs of the model at the end
};

namespace solver {

/// How many cells something works on, for --plan.
struct EffectShare {
  std::string name;
  std::int64_t cells = 0;
};

}  // namespace solver
}  // namespace slipwave
