// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "segy/sample_format.hpp"
#include "segy/sniff.hpp"
#include "segy/writer.hpp"

namespace slipwave {

/// The options of tools that make traces of something else: what kind of file.
struct TraceOutput {
  std::string format = "ieee", revision = "1", endian = "big";
  bool su = false;

  void declare(cli::Options& options) {
    options.add("format", format, "NAME", "sample format: ibm, ieee, int16, ... or its code");
    options.add_choice("revision", revision, {"0", "1", "2"}, "revision of SEG-Y; 2 is written as 2.1");
    options.add_choice("endian", endian, {"big", "little"}, "byte order");
    options.add("su", su, "write Seismic Unix: the machine's byte order, no reel headers");
    options.excludes("su", {"revision", "endian"}, "Seismic Unix has no revision, and the machine's order");
  }

  /// Of a file of that name: one that ends in .su is Seismic Unix.
  segy::FileFormat file_format(const std::string& path) const {
    if (segy::names_su(path)) return segy::format_named_by(path);
    segy::FileFormat wanted;
    wanted.code = in_place("--format", [&] { return segy::format_named(format).code; });
    wanted.revision = su ? 1 : revision[0] - '0';
    wanted.endian = endian == "little" ? segy::Endian::little : segy::Endian::big;
    wanted.su = su;
    if (su) wanted.endian = segy::native_endian;
    return wanted;
  }
};

}  // namespace slipwave
