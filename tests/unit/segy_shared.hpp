// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "scratch.hpp"

namespace slipwave::segy {

/// The folder of data and tools kept beside the checkout; empty when there is none.
inline std::filesystem::path shared_folder() {
  const char* const said = std::getenv("SLIPWAVE_SHARED");
  const std::filesystem::path folder = said != nullptr ? said : SLIPWAVE_SHARED_DEFAULT;
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

inline std::vector<std::uint8_t> bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void put_bytes(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace slipwave::segy
