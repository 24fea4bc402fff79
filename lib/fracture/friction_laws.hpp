// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fracture/coulomb.hpp"
#include "fracture/slip_weakening.hpp"

namespace slipwave {

/// All friction laws as arguments of a template.
template <template <class...> class Of>
using OfFrictionLaws = Of<Coulomb, SlipWeakening>;

/// Calls `act` with an object of the law of that name; of planes that never slide, with Coulomb.
template <class Act>
auto with_friction_law(FrictionLaw law, const Act& act) {
  switch (law) {
    case FrictionLaw::slip_weakening:
      return act(SlipWeakening());
    case FrictionLaw::coulomb:
    case FrictionLaw::none:
      break;
  }
  return act(Coulomb());
}

}  // namespace slipwave
