// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "geology/lithology.hpp"
#include "geology/marmousi_structure.hpp"

namespace slipwave::marmousi {

enum class Filling { brine, oil, gas };

/// The bed at a place. Properties are smooth within a body and jump from one to the next.
struct Bed {
  std::uint64_t body = 0;
  Lithology lithology = Lithology::shale;
  Filling filling = Filling::brine;
  double speed = 1;  // times that of the lithology at its burial
  // Where random numbers vary the bed, those of its formation and its own; else 0.
  std::uint64_t formation_key = 0, bed_key = 0;
};

Bed bed_at(std::uint64_t seed, const Section& section, const Place& place);

/// The rock of a bed at a place: as fast as its burial made it, with its pores filled.
Material material_of(const Bed& bed, const Section& section, const Place& place);

}  // namespace slipwave::marmousi
