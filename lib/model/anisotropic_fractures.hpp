// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

namespace slipwave {

/// Why the fractures of a model cannot be computed in its anisotropic rock.
struct AnisotropicFault {
  std::string text;         // "..., expected ..."
  bool of_opening = false;  // there is none where planes stay closed
};

/// Returns the fault of the first cell or face that has one (theory/anisotropy.md): of planes that open, or
/// lie askew (lie_askew()) and weaken where they cross or are springs that slide or have dashpots; in 3-D
/// springs of single fractures that lie askew; fractures on faces, whatever they are. Returns nothing where
/// all can be computed.
template <int D>
std::optional<AnisotropicFault> fault_in_anisotropic_rock(const Model<D>& model);

}  // namespace slipwave
