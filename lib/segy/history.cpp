// SPDX-License-Identifier: BSD-3-Clause
#include "segy/history.hpp"

#include <algorithm>

#include "base/parse.hpp"

namespace slipwave::segy {
namespace {

constexpr std::string_view stanza_name = "((slipwave: history";
constexpr std::size_t kept_columns = text_columns - 1;

std::string trimmed(std::string_view line) {
  const auto end = line.find_last_not_of(std::string_view(" \0", 2));
  return std::string(line.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

History history_in_stanza(const std::vector<ExtendedText>& extended) {
  std::vector<std::string> commands;
  bool goes_on = false;
  for (const auto& block : extended) {
    if (!holds_history(block)) continue;
    auto lines = lines_of(block.text);
    lines.erase(lines.begin());
    for (const auto& line : lines) {
      const bool broken = line.back() == '\\';
      const auto content = broken ? line.substr(0, kept_columns) : trimmed(line);
      if (goes_on)
        commands.back() += content;
      else if (!content.empty())
        commands.push_back(content);
      goes_on = broken;
    }
  }
  return {joined_by(commands, "\n"), true};
}

}  // namespace

bool holds_history(const ExtendedText& extended) { return extended.text.starts_with(stanza_name); }

History history_in_text(const std::string& text) {
  std::vector<std::string> commands;
  bool complete = true, in_command = false;
  for (const auto& line : lines_of(text)) {
    const auto content = trimmed(std::string_view(line).substr(text_prefix));
    const auto blanks = std::min(content.find_first_not_of(' '), content.size());
    if (content == "..." || (in_command && content == "  ...")) {
      complete = false;
    } else if (blanks == 0) {
      in_command = content.starts_with("sw-");
      if (in_command) commands.push_back(content);
    } else if (in_command) {
      // Two blanks where a blank was, one where a long word was broken.
      commands.back() += blanks == 1 ? content.substr(1) : " " + content.substr(2);
    }
  }
  return {joined_by(commands, "\n"), complete};
}

History history_of(const FileHeader& header) {
  if (header.su) return {};
  if (std::any_of(header.extended.begin(), header.extended.end(), holds_history))
    return history_in_stanza(header.extended);
  return history_in_text(header.text);
}

std::vector<ExtendedText> history_stanza(const std::string& commands, TextEncoding encoding) {
  std::vector<std::string> lines;
  for (std::string command : split(commands, '\n')) {
    for (; command.size() > kept_columns; command.erase(0, kept_columns))
      lines.push_back(command.substr(0, kept_columns) + '\\');
    lines.push_back(command);
  }
  std::vector<ExtendedText> blocks;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (n % (text_lines - 1) == 0) {
      std::string name = std::string(stanza_name) + " ver 1.0))";
      name.resize(text_columns, ' ');
      blocks.push_back({std::move(name), encoding});
    }
    lines[n].resize(text_columns, ' ');
    blocks.back().text += lines[n];
  }
  for (auto& block : blocks) block.text.resize(text_bytes, ' ');
  return blocks;
}

}  // namespace slipwave::segy
