// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/netcdf_file.hpp"

namespace slipwave::plot {

/// A file that can be drawn, opened as far as its kind needs.
struct InputFile {
  enum class Kind { gather, model, snapshots, spectra, accuracy };
  std::string path;
  Kind kind = Kind::gather;
  std::optional<NetcdfFile> file;  // but for gathers
  std::vector<char> taken;         // bytes already read of a gather's pipe

  /// The commands that made it; "" of gathers, whose textual header holds them.
  std::string history() const;
};

/// Finds out what kind of file it is; "-" is standard input. `su`: traces are Seismic Unix, which cannot be
/// told by their looks. Throws Error naming the file when it cannot be drawn.
InputFile open_input(const std::string& path, bool su);

}  // namespace slipwave::plot
