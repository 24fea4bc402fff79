// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "segy/file_header.hpp"

namespace slipwave::segy {

/// What a file of traces says of the commands that made it (base/history.hpp).
struct History {
  std::string commands;  // one a line; empty: none of ours
  bool complete = true;  // false: the textual header had no room for all of them
};

/// Returns the history of the user stanza ((slipwave: history)) in the extended textual headers, or else of
/// the lines of the textual header that begin with the name of a tool.
History history_of(const FileHeader& header);

/// What the textual header alone says.
History history_in_text(const std::string& text);

/// Whether an extended textual header belongs to the stanza.
bool holds_history(const ExtendedText& extended);

/// The stanza as extended textual headers of 40 lines x 80: commands broken at column 79, a backslash in
/// column 80 where one continues.
std::vector<ExtendedText> history_stanza(const std::string& commands, TextEncoding encoding);

}  // namespace slipwave::segy
