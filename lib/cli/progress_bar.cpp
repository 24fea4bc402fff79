// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/interruption.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"

namespace slipwave::cli {

std::string duration_in_words(double seconds) {
  char text[40];
  const long whole = std::lround(seconds);
  if (seconds < 9.95) {
    std::snprintf(text, sizeof text, "%.*f s", seconds < 0.995 ? 2 : 1, seconds);
  } else if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

std::string bytes_in_words(double bytes) {
  const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < std::size(units); ++unit) bytes /= 1024;
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, units[unit]);
  return text;
}

std::string ProgressRate::words(std::int64_t done, std::int64_t total, double now_s) {
  if (!begun_) begun_ = Start{done, now_s};
  const double part = double(done - begun_->done), seconds = now_s - begun_->at_s;
  if (!(part > 0) || !(seconds > 0)) return "";
  const double a_second = part / seconds;
  char number[32];
  std::snprintf(number, sizeof number, "%.3g ", a_second);
  const std::string rate = (things_ == bytes ? bytes_in_words(a_second) : number + things_) + "/s";
  return done >= total ? rate : rate + ", " + duration_in_words(double(total - done) / a_second) + " left";
}

namespace {

using Clock = std::chrono::steady_clock;

/// A line drawn over itself: "sw-shoot: shot 1 [#####.....]  50 % 210 steps/s, 7 s left".
class Bar {
 public:
  Bar(std::string title, const std::string& things)
      : title_(std::move(title)), rate_(things), start_(Clock::now()) {}

  void operator()(std::int64_t done, std::int64_t total) {
    const auto now = Clock::now();
    const bool last = done >= total;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const bool first = drawn_ == Clock::time_point();
    if (finished_ || (!last && !first && now - drawn_ < std::chrono::milliseconds(200))) return;
    drawn_ = now;
    finished_ = last;
    constexpr int width = 30;
    const double share = total > 0 ? std::min(1.0, double(done) / double(total)) : 1.0;
    const std::string bar = std::string(std::size_t(share * width), '#');
    std::string words = rate_.words(done, total, seconds);
    if (last) words += (words.empty() ? "" : ", ") + duration_in_words(seconds);
    std::fprintf(stderr, "\r%s [%-*s] %3d %% %s\033[K%s", title_.c_str(), width, bar.c_str(),
                 int(share * 100), words.c_str(), last ? "\n" : "");
    std::fflush(stderr);
    leave_line_open(!last);
  }

 private:
  std::string title_;
  ProgressRate rate_;
  Clock::time_point start_;
  Clock::time_point drawn_{};
  bool finished_ = false;
};

/// A line each time another tenth is done.
class Lines {
 public:
  Lines(std::string title, const std::string& things, std::function<void(const std::string&)> write)
      : title_(std::move(title)), rate_(things), start_(Clock::now()), write_(std::move(write)) {}

  void operator()(std::int64_t done, std::int64_t total) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    const std::string rate = rate_.words(done, total, seconds);
    const int tenth = total > 0 ? int(done * 10 / total) : 10;
    if (tenth <= said_) return;
    said_ = tenth;
    write_(title_ + " " + std::to_string(tenth * 10) + " %" + (rate.empty() ? "" : ", " + rate));
  }

 private:
  std::string title_;
  ProgressRate rate_;
  Clock::time_point start_;
  std::function<void(const std::string&)> write_;
  int said_ = 0;
};

}  // namespace

Progress Context::progress(const std::string& what, const std::string& things) const {
  std::vector<Progress> all;
  if (!quiet && isatty(STDERR_FILENO))
    all.emplace_back(Bar(tool + ": " + what, things));
  else if (!quiet && verbose)
    all.emplace_back(Lines(tool + ": " + what, things,
                           [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }));
  if (log) all.emplace_back(Lines(what, things, [own = log](const std::string& line) { own->write(line); }));
  if (all.size() < 2) return all.empty() ? Progress() : all.front();
  return [all](std::int64_t done, std::int64_t total) mutable {
    for (auto& one : all) one(done, total);
  };
}

}  // namespace slipwave::cli
