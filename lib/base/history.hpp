// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace slipwave {

/// What files say of how they were made: command lines, one a line, the newest last, quoted as a shell needs
/// them, names of inputs first. None says where its output went, and one after another nothing of the name of
/// its only input: that is what the command before it made.

/// Adds a command to a history.
void append_history(std::string& history, const std::string& command);

/// One line for a shell that makes the file of this history again, on standard output: its commands as a pipe
/// from the last one on that reads no other's output.
std::string pipeline_of(const std::string& history);

}  // namespace slipwave
