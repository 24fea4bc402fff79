// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/parser.hpp"

namespace slipwave::cli {
namespace {

int int_of(const std::string& text) {
  const auto value = parse_integer(text);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    throw Error("found '" + text + "', expected a smaller whole number", ErrorKind::usage);
  }
  return int(value);
}

}  // namespace

bool truth_of(const std::string& text) {
  for (const char* yes : {"", "true", "yes", "on", "1"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"false", "no", "off", "0"}) {
    if (text == no) return false;
  }
  throw Error("found '" + text + "', expected true or false", ErrorKind::usage);
}

Options::Options() = default;
Options::~Options() = default;

Options::Option& Options::declare(const std::string& name, const std::string& placeholder,
                                  const std::string& help) {
  Option option;
  const auto comma = name.find(',');
  option.name = name.substr(0, comma);
  if (comma != std::string::npos) option.short_name = name.substr(comma + 1);
  option.placeholder = placeholder;
  option.help = help;
  options_.push_back(option);
  return options_.back();
}

void Options::add(const std::string& name, std::string& to, const std::string& placeholder,
                  const std::string& help) {
  auto& option = declare(name, placeholder, help);
  option.shown_default = to;
  const bool may_be_empty = placeholder == "TEXT" || !to.empty();
  option.store = [&to, placeholder, may_be_empty](const auto& values) {
    if (values.back().empty() && !may_be_empty)
      throw Error("found '', expected " + placeholder, ErrorKind::usage);
    to = values.back();
  };
}

void Options::add(const std::string& name, double& to, const std::string& placeholder,
                  const std::string& help) {
  auto& option = declare(name, placeholder, help);
  if (to == to) option.shown_default = shown(to);
  option.store = [&to](const auto& values) { to = parse_number(values.back()); };
}

void Options::add(const std::string& name, int& to, const std::string& placeholder, const std::string& help) {
  auto& option = declare(name, placeholder, help);
  option.shown_default = std::to_string(to);
  option.store = [&to](const auto& values) { to = int_of(values.back()); };
}

void Options::add(const std::string& name, std::optional<double>& to, const std::string& placeholder,
                  const std::string& help) {
  auto& option = declare(name, placeholder, help);
  option.store = [&to](const auto& values) { to = parse_number(values.back()); };
}

void Options::add(const std::string& name, std::optional<int>& to, const std::string& placeholder,
                  const std::string& help) {
  auto& option = declare(name, placeholder, help);
  option.store = [&to](const auto& values) { to = int_of(values.back()); };
}

void Options::add(const std::string& name, std::vector<std::string>& to, const std::string& placeholder,
                  const std::string& help) {
  auto& option = declare(name, placeholder, help);
  option.many = true;
  option.shown_default = joined_by(to, " ");
  option.store = [&to](const auto& values) { to = values; };
}

void Options::add(const std::string& name, bool& to, const std::string& help) {
  auto& option = declare(name, "", help);
  option.store = [&to](const auto& values) { to = truth_of(values.back()); };
}

void Options::add_choice(const std::string& name, std::string& to, std::vector<std::string> choices,
                         const std::string& help) {
  // A list that is wider than a line stands in the help instead.
  constexpr std::size_t widest = 60;
  const auto list = joined_by(choices, "|");
  const bool fits = list.size() <= widest;
  auto& option = declare(name, fits ? list : "NAME", fits ? help : help + ": " + joined(choices));
  option.shown_default = to;
  option.store = [&to, choices = std::move(choices)](const auto& values) {
    if (std::find(choices.begin(), choices.end(), values.back()) == choices.end()) {
      throw Error("found '" + values.back() + "', expected one of " + joined(choices), ErrorKind::usage);
    }
    to = values.back();
  };
}

Options::Option& Options::declared(const std::string& name) {
  for (auto& option : options_)
    if (option.name == name) return option;
  throw std::logic_error("there is no option --" + name);
}

void Options::headings(const std::vector<std::pair<std::string, std::string>>& first_and_title) {
  for (const auto& [name, title] : first_and_title) declared(name).heading = title;
}

void Options::common(const std::vector<std::string>& names) {
  for (const auto& name : names) declared(name).common = true;
}

void Options::require(const std::string& name) {
  for (auto& option : options_) option.required = option.required || option.name == name;
  for (auto& positional : positionals_)
    positional.required = positional.required || positional.placeholder == name;
}

void Options::needs(const std::string& name, const std::vector<std::string>& others) {
  for (const auto& other : others) declared(other);
  rules_.push_back({declared(name).name, others, false, ""});
}

void Options::excludes(const std::string& name, const std::vector<std::string>& others,
                       const std::string& why) {
  for (const auto& other : others) declared(other);
  rules_.push_back({declared(name).name, others, true, why});
}

std::vector<std::string> Options::names() const {
  std::vector<std::string> names;
  for (const auto& option : options_) names.push_back(option.name);
  return names;
}

void Options::positional(std::string& to, const std::string& placeholder) {
  positionals_.push_back({placeholder, false, false, [&to](const auto& values) { to = values.back(); }});
}

void Options::positional(std::vector<std::string>& to, const std::string& placeholder) {
  positionals_.push_back({placeholder, true, false, [&to](const auto& values) { to = values; }});
}

void Options::add_threads() { declare("threads", "N", "").store = nullptr; }

void Options::add_log() {
  auto& option = declare("log", "FILE", "append all messages, with the time, to this file");
  option.provenance = false;
  option.store = nullptr;
}

std::string quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+./,:@%^";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) {
    if (letter == '\'') {
      text += "'\\''";
    } else {
      text += letter;
    }
  }
  return text + "'";
}

}  // namespace slipwave::cli
