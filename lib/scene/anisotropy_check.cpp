// SPDX-License-Identifier: BSD-3-Clause
#include "scene/anisotropy_check.hpp"

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "model/anisotropic_fractures.hpp"

namespace slipwave {

template <int D>
void check_anisotropy(const Scene<D>& scene) {
  if (!scene.with_slip) return;
  if (const auto fault = fault_in_anisotropic_rock(scene.model))
    throw Error(fault->text + "; use --without " + (fault->of_opening ? "opening" : "slip") +
                " or --without anisotropy");
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, check_anisotropy);

}  // namespace slipwave
