// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segy/words.hpp"

namespace slipwave {

/// Numbers the traces of a survey as a regular cube, for programs that take files for nothing else: the
/// in-line is the shot, the cross-line the channel, and the place of the offset holds the code of the
/// component (trid), fastest. Positions stay.
class CubeNumbers {
 public:
  /// Traces in the order of shot, channel, component. Throws Error where a trace is another one than that of
  /// the first shot.
  void number(segy::TraceWords& words);
  /// After the last trace: throws Error when the last shot lacks some.
  void finish() const;

 private:
  struct Place {
    std::int64_t channel = 0, component = 0;
    bool operator==(const Place&) const = default;
    bool operator<(const Place& other) const {
      return channel != other.channel ? channel < other.channel : component < other.component;
    }
  };
  static std::string shown(const Place& place);
  [[noreturn]] static void refuse(const std::string& what);

  std::vector<Place> of_first_shot_;
  std::int64_t first_shot_ = 0, shot_ = 0;
  std::int64_t traces_ = 0;
  std::size_t next_ = 0;  // within its shot
};

}  // namespace slipwave
