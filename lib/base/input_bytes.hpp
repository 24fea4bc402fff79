#pragma once

#include <string>
#include <vector>

namespace slipwave {

/// "standard input" for "-", else the path: as messages name an input.
std::string shown_input(const std::string& path);

/// All bytes of a file, fifo or ("-") standard input. Throws Error naming it: missing, a directory,
/// unreadable, standard input that is a terminal.
std::vector<char> read_all(const std::string& path);

/// Is `path` a regular file? Throws Error naming it when it is missing or a directory. "-" is none.
bool is_regular_input(const std::string& path);

}  // namespace slipwave
