#pragma once

#include <string>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "segy/reader.hpp"
#include "segy/sample_format.hpp"

namespace slipwave {

/// The options of every tool that reads traces: what the user knows better than the file.
struct TraceInput {
  std::string endian = "auto";
  std::string format = "auto";
  bool su = false;

  void declare(cli::Options& options) {
    options.add_choice("endian", endian, {"auto", "big", "little"}, "byte order of the input");
    options.add("format", format, "NAME", "sample format of the input: ibm, ieee, int16, ... or its code");
    options.add("su", su, "read the input as Seismic Unix");
  }

  segy::ReadOptions read_options() const {
    segy::ReadOptions options;
    options.su = su;
    if (endian != "auto") options.endian = endian == "big" ? segy::Endian::big : segy::Endian::little;
    if (format != "auto")
      options.format = in_place("--format", [&] { return segy::format_named(format).code; });
    return options;
  }
};

}  // namespace slipwave
