// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "cli/tool.hpp"

namespace slipwave::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// "7 s", "2 min 05 s", "3 h 10 min".
std::string duration(double seconds) {
  char text[40];
  const long whole = std::lround(seconds);
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

/// A line drawn over itself: "sw-shoot: steps [#####.....]  50 % 210/s, 7 s left".
class Bar {
 public:
  explicit Bar(std::string title) : title_(std::move(title)), start_(Clock::now()) {}

  void operator()(std::int64_t done, std::int64_t total) {
    const auto now = Clock::now();
    const bool last = done >= total;
    if (finished_ || (!last && now - drawn_ < std::chrono::milliseconds(200))) return;
    drawn_ = now;
    finished_ = last;
    constexpr int width = 30;
    const double share = total > 0 ? std::min(1.0, double(done) / double(total)) : 1.0;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const std::string bar = std::string(std::size_t(share * width), '#');
    char rate[32] = "";
    if (seconds > 0) std::snprintf(rate, sizeof rate, "%.3g/s, ", double(done) / seconds);
    const std::string rest = last        ? duration(seconds)
                             : share > 0 ? duration(seconds / share - seconds) + " left"
                                         : "";
    std::fprintf(stderr, "\r%s [%-*s] %3d %% %s%s\033[K%s", title_.c_str(), width, bar.c_str(),
                 int(share * 100), rate, rest.c_str(), last ? "\n" : "");
    std::fflush(stderr);
  }

 private:
  std::string title_;
  Clock::time_point start_;
  Clock::time_point drawn_{};
  bool finished_ = false;
};

/// A line each time another tenth is done.
class Lines {
 public:
  explicit Lines(std::string title) : title_(std::move(title)) {}

  void operator()(std::int64_t done, std::int64_t total) {
    const int tenth = total > 0 ? int(done * 10 / total) : 10;
    if (tenth <= said_) return;
    said_ = tenth;
    std::fprintf(stderr, "%s %d %%\n", title_.c_str(), tenth * 10);
  }

 private:
  std::string title_;
  int said_ = 0;
};

}  // namespace

Progress Context::progress(const std::string& what) const {
  if (quiet) return {};
  const std::string title = tool + ": " + what;
  if (isatty(STDERR_FILENO)) return Bar(title);
  if (verbose) return Lines(title);
  return {};
}

}  // namespace slipwave::cli
