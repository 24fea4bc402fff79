// SPDX-License-Identifier: BSD-3-Clause
#include "base/interruption.hpp"

#include <atomic>
#include <csignal>

namespace slipwave {
namespace {

constexpr int nobody_looks = -1;
// A signal handler can reach nothing but static storage.
std::atomic<int> noted_signal{nobody_looks};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

SignalWatch::SignalWatch() { noted_signal = 0; }

SignalWatch::~SignalWatch() { noted_signal = nobody_looks; }

int SignalWatch::noted() const { return noted_signal; }

bool note_signal(int signal_number) noexcept {
  int none = 0;
  return signal_number != SIGPIPE && noted_signal.compare_exchange_strong(none, signal_number);
}

void die_of(int signal_number) {
  std::signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace slipwave
