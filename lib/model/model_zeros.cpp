// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_zeros.hpp"

#include <span>

#include "base/instantiate.hpp"
#include "base/memory.hpp"

namespace slipwave {

template <int D>
void release_zeros(const Model<D>& model) {
  const auto release = [](const auto& field) { release_zero_pages(std::as_bytes(std::span(field))); };
  for (const auto property : model.medium.properties()) release(model.medium[property]);
  for (const auto& stress : model.prestress_pa) release(stress);
  release(model.fracture);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, release_zeros);

}  // namespace slipwave
