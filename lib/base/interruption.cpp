// SPDX-License-Identifier: BSD-3-Clause
#include "base/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace slipwave {
namespace {

constexpr int nobody_looks = -1;
// A signal handler can reach nothing but static storage.
std::atomic<int> noted_signal{nobody_looks};
std::atomic<bool> line_is_open{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

}  // namespace

SignalWatch::SignalWatch() { noted_signal = 0; }

SignalWatch::~SignalWatch() { noted_signal = nobody_looks; }

int SignalWatch::noted() const { return noted_signal; }

bool note_signal(int signal_number) noexcept {
  int none = 0;
  // A closed pipe takes no more output, and who quits wants the process to end where it is.
  return signal_number != SIGPIPE && signal_number != SIGQUIT &&
         noted_signal.compare_exchange_strong(none, signal_number);
}

void leave_line_open(bool open) noexcept { line_is_open = open; }

void die_of(int signal_number) {
  if (line_is_open.exchange(false) && write(STDERR_FILENO, "\n", 1) != 1) line_is_open = false;
  std::signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace slipwave
