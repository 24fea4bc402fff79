// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave {

/// Thrown to end a run after a signal, once everything is in order; main then dies of that
/// signal (die_of).
struct Interrupted {
  int signal_number;
};

/// While it lives the first signal but QUIT and PIPE is only noted; another one ends the process at once, as
/// without it. One at a time. Needs the handlers of remove_temporaries_on_signals().
class SignalWatch {
 public:
  SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  ~SignalWatch();
  /// The signal that came, 0 as long as none has.
  int noted() const;
};

/// For signal handlers: whether the signal was noted by a living SignalWatch and has no other effect.
bool note_signal(int signal_number) noexcept;

/// Says whether a line stands unfinished on standard error, as a progress bar does: die_of() finishes it, so
/// that the shell's next line has its own.
void leave_line_open(bool open) noexcept;

/// Ends the process by the signal, so that the shell sees 128 + N.
void die_of(int signal_number);

}  // namespace slipwave
