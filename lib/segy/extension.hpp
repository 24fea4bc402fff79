// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segy/words.hpp"

namespace slipwave::segy {

/// Extension 1 among the additional headers of a trace, in file order; nothing where the first of them has
/// another name.
std::optional<ExtensionWords> extension_of(std::span<const std::uint8_t> headers, Endian endian);

/// A real word of an extension, or `standard` where there is no extension or the word is 0 or not finite.
double real_or(const std::optional<ExtensionWords>& extension, FieldName<ExtensionLayout> name,
               double standard);

/// Makes extension 1 among `headers` say these numbers of samples and microseconds where it says any.
void set_sampling(std::vector<std::uint8_t>& headers, Endian endian, std::int64_t samples,
                  double interval_us);

}  // namespace slipwave::segy
