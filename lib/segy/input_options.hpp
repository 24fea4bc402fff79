// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segy/reader.hpp"

namespace slipwave::segy {

/// What a user knows better than a file of traces, as options of the tools say it.
struct InputOptions {
  std::string endian = "auto";  // auto, big, little
  std::string format = "auto";  // of samples: a name or its code
  bool su = false;              // Seismic Unix, also where it does not look like it

  /// Throws a usage Error on an unknown format.
  ReadOptions read_options() const;
};

}  // namespace slipwave::segy
