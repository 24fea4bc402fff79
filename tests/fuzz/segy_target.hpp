// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace slipwave::segy {

using Bytes = std::vector<std::uint8_t>;

enum class As { file, pipe };

/// Reads `bytes` decoded and not, and converts what can be read into another format that the bytes choose.
/// Anything but an answer or an Error that names its input ends the process.
void examine(std::span<const std::uint8_t> bytes, As as);

/// A file in each format, byte order, revision and code, with and without extended texts, additional trace
/// headers and trailers, and Seismic Unix, by our own writer; `samples` a trace, 12 traces.
struct Seed {
  std::string name;
  Bytes bytes;
};
std::vector<Seed> seeds(std::int64_t samples);

/// Gives one to eight words of the file header, of the first trace header or of its extension another value,
/// mostly an extreme one.
void change_headers(std::span<std::uint8_t> bytes, std::mt19937& random);

}  // namespace slipwave::segy
