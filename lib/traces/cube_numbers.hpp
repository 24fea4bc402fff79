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

/// Numbers the traces of receivers that cover an area as a regular cube: in-lines along x, one for each y of
/// receivers, cross-lines by their x, and the place of the offset counts the records of a receiver (shot and
/// component) from 1, fastest. Positions stay.
class AreaNumbers {
 public:
  /// Traces in the order of receiver y, receiver x, shot, component. Throws Error where lines differ in their
  /// x, or receivers in their records.
  void number(segy::TraceWords& words);
  /// After the last trace: throws Error when the last line, or its last receiver, lacks some.
  void finish() const;

 private:
  struct Record {
    std::int64_t shot = 0, component = 0;
    bool operator==(const Record&) const = default;
  };
  static std::string shown(const Record& record);
  [[noreturn]] static void refuse(const std::string& what);
  void begin_receiver(std::int64_t y, std::int64_t x, const std::string& found);

  std::vector<std::int64_t> x_of_line_;  // of the first one
  std::vector<Record> records_;          // of the first receiver
  std::int64_t x_ = 0, y_ = 0;
  std::size_t line_ = 0, column_ = 0, next_ = 0;  // of those, from 0; next_ among the records
  std::int64_t traces_ = 0;
};

}  // namespace slipwave
