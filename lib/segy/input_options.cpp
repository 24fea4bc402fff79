// SPDX-License-Identifier: BSD-3-Clause
#include "segy/input_options.hpp"

#include "base/error.hpp"
#include "segy/sample_format.hpp"

namespace slipwave::segy {

ReadOptions InputOptions::read_options() const {
  ReadOptions options;
  options.su = su;
  if (endian != "auto") options.endian = endian == "big" ? Endian::big : Endian::little;
  if (format != "auto") options.format = in_place("--format", [&] { return format_named(format).code; });
  return options;
}

}  // namespace slipwave::segy
