// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace slipwave::cli {

/// "0.25 s", "7.2 s", "41 s", "2 min 05 s", "3 h 10 min".
std::string duration_in_words(double seconds);
/// "55.2 MiB".
std::string bytes_in_words(double bytes);

/// How fast things are done since the first call, which after a checkpoint is not at the first of them.
class ProgressRate {
 public:
  /// Name of things that are counted by the byte.
  static constexpr const char* bytes = "bytes";
  explicit ProgressRate(std::string things) : things_(std::move(things)) {}
  /// "210 steps/s, 7.1 s left", at the end "210 steps/s"; nothing at the first call.
  std::string words(std::int64_t done, std::int64_t total, double now_s);

 private:
  struct Start {
    std::int64_t done = 0;
    double at_s = 0;
  };
  std::string things_;
  std::optional<Start> begun_;
};

}  // namespace slipwave::cli
