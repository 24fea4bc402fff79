#pragma once

#include <netcdf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/netcdf_file.hpp"

namespace slipwave {

struct NetcdfFile::Impl {
  std::string shown_name;
  int id = -1;              // of an open file, else -1
  std::vector<char> bytes;  // of a file that lies in memory
  std::uint64_t file_bytes = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (id >= 0) nc_close(id);
  }
  /// Throws Error "file: [variable: ]cause" unless `status` is NC_NOERR.
  void check(int status, const std::string& variable = "") const;
  [[noreturn]] void fail(const std::string& variable, const std::string& sentence) const;
  int variable_id(const std::string& name) const;  // "" is NC_GLOBAL
  /// Refuses more than a file of this length can hold, however well compressed.
  void check_size(const std::string& variable, const std::vector<std::size_t>& shape,
                  std::size_t width) const;
};

}  // namespace slipwave
