// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace slipwave {

/// While it lives, the end of a child is told, also to a process that was started to ignore such news.
class ChildrenHeard {
 public:
  ChildrenHeard() {
    struct sigaction standard {};
    standard.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &standard, &before_);
  }
  ChildrenHeard(const ChildrenHeard&) = delete;
  ChildrenHeard& operator=(const ChildrenHeard&) = delete;
  ~ChildrenHeard() { sigaction(SIGCHLD, &before_, nullptr); }

 private:
  struct sigaction before_ {};
};

}  // namespace slipwave
