// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/tool.hpp"
#include "segy/input_options.hpp"

namespace slipwave {

/// The options of every tool that reads traces.
struct TraceInput : segy::InputOptions {
  void declare(cli::Options& options) {
    options.add_choice("endian", endian, {"auto", "big", "little"}, "byte order of the input");
    options.add("format", format, "NAME", "sample format of the input: ibm, ieee, int16, ... or its code");
    options.add("su", su, "read the input as Seismic Unix");
  }

  /// For tools that use the whole traces of an input that ends too early and then say so
  /// (Reader::expect_whole).
  segy::ReadOptions to_damage() const {
    segy::ReadOptions options = read_options();
    options.to_damage = true;
    return options;
  }
};

}  // namespace slipwave
