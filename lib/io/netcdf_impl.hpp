// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <netcdf.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/netcdf_file.hpp"

namespace slipwave {

struct NetcdfFile::Impl {
  std::string shown_name;
  int id = -1;              // of an open file, else -1
  std::vector<char> bytes;  // of a file that lies in memory
  std::uint64_t file_bytes = 0;
  std::string written_path;  // of a file being written, else ""
  mutable bool failed = false;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    // Closing what could not be written can crash in the library; the process ends soon.
    if (id >= 0 && !(failed && !written_path.empty())) nc_close(id);
  }
  /// Opens by what `open` calls, which sets the number, once a child process has survived it.
  void open_probed(const std::function<int(int&)>& open);
  /// Everything that closing a written file can fail on is done and checked before: the library crashes when
  /// closing fails.
  void settle() const;
  /// Throws Error "file: [variable: ]cause" unless `status` is NC_NOERR.
  void check(int status, const std::string& variable = "") const;
  [[noreturn]] void fail(const std::string& variable, const std::string& sentence) const;
  int variable_id(const std::string& name) const;  // "" is NC_GLOBAL
  /// Refuses more than a file of this length can hold, however well compressed.
  void check_size(const std::string& variable, const std::vector<std::size_t>& shape,
                  std::size_t width) const;
};

}  // namespace slipwave
