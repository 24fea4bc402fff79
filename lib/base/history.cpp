// SPDX-License-Identifier: BSD-3-Clause
#include "base/history.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "base/parse.hpp"

namespace slipwave {
namespace {

/// Returns where the word of a command line that begins at `at` ends.
std::size_t end_of_word(std::string_view command, std::size_t at) {
  bool quoted = false;
  for (; at < command.size(); ++at) {
    if (command[at] == '\'')
      quoted = !quoted;
    else if (command[at] == '\\' && !quoted)
      ++at;
    else if (command[at] == ' ' && !quoted)
      break;
  }
  return std::min(at, command.size());
}

/// The words behind the name of the tool that are no options: its inputs.
std::vector<std::string_view> inputs_of(std::string_view command) {
  std::vector<std::string_view> inputs;
  for (auto at = end_of_word(command, 0); at < command.size();) {
    const auto end = end_of_word(command, at + 1);
    const auto word = command.substr(at + 1, end - at - 1);
    if (word.empty() || (word.front() == '-' && word != "-")) break;
    inputs.push_back(word);
    at = end;
  }
  return inputs;
}

/// Whether a command reads nothing that the one before it has written to standard output.
bool begins_anew(std::string_view command) {
  constexpr std::array makers = {"sw-layers", "sw-marmousi", "sw-import"};
  const auto tool = command.substr(0, end_of_word(command, 0));
  if (std::find(makers.begin(), makers.end(), tool) != makers.end()) return true;
  const auto inputs = inputs_of(command);
  return !inputs.empty() && inputs != std::vector<std::string_view>{"-"};
}

}  // namespace

void append_history(std::string& history, const std::string& command) {
  const auto inputs = inputs_of(command);
  if (history.empty() || inputs.size() != 1) {
    if (!history.empty() && history.back() != '\n') history += '\n';
    history += command;
    return;
  }
  if (history.back() != '\n') history += '\n';
  const auto name_ends = end_of_word(command, 0);
  history += command.substr(0, name_ends) + command.substr(name_ends + 1 + inputs.front().size());
}

std::string pipeline_of(const std::string& history) {
  std::string line;
  for (const auto& command : split(history, '\n')) {
    if (command.empty()) continue;
    line = line.empty() || begins_anew(command) ? std::string(command) : line + " | " + std::string(command);
  }
  return line;
}

}  // namespace slipwave
