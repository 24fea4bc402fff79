// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// One thing the bytes of a run's outputs depend on: in words, or of large things a checksum.
struct Trait {
  std::string name;  // "order"
  std::string value;
  bool in_words = true;
};

/// All of them: two runs whose identities are the same give the same outputs.
using Identity = std::vector<Trait>;

/// Returns the identity of everything a scene holds but the tiling.
template <int D>
Identity identity_of(const Scene<D>& scene);

/// The first thing in which a found run is not the expected one, as the end of a sentence: "order 3, expected
/// order 5"; nothing where they are the same.
std::optional<std::string> difference_of(const Identity& found, const Identity& expected);

void serialize(Archive& archive, Identity& identity);

}  // namespace slipwave
