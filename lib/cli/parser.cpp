// SPDX-License-Identifier: BSD-3-Clause
#include "cli/parser.hpp"

#include <algorithm>
#include <boost/program_options.hpp>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "base/nearest.hpp"
#include "base/parse.hpp"
#include "io/input_bytes.hpp"

namespace slipwave::cli {
namespace {

namespace po = boost::program_options;

// Not part of the provenance: the bytes of the output do not depend on them.
const std::set<std::string> without_effect = {
    "config",         "output",        "threads",          "quiet",
    "verbose",        "checkpoint",    "checkpoint-every", "shots-in-parallel",
    "ranks-per-shot", "keep-unstable", "executor"};
// Only sensible on the command line.
const std::set<std::string> not_in_config = {"help", "help-all", "version", "config"};

constexpr int most_threads = 4096;

// Of --help.
constexpr std::size_t help_width = 80, help_column = 24;

/// A text broken at blanks into lines of at most help_width columns (the first with `indent` blanks that it
/// has already, the others behind `hanging` ones); a longer word stands alone.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t hanging) {
  constexpr std::size_t continuation = 2;  // " \\" may follow
  const std::size_t room = help_width - continuation;
  std::string lines(indent, ' ');
  std::size_t used = indent;
  for (const auto& word : split(std::string_view(text).substr(indent), ' ')) {
    const bool first = used == indent && lines.size() == indent;
    if (!first && used + 1 + word.size() > room) {
      lines += '\n' + std::string(hanging, ' ');
      used = hanging;
    } else if (!first) {
      lines += ' ';
      ++used;
    }
    lines += word;
    used += word.size();
  }
  return lines + '\n';
}

std::string without_dashes(const std::string& name) {
  const auto start = name.find_first_not_of('-');
  return start == std::string::npos ? "" : name.substr(start);
}

}  // namespace

void Parser::declare_common() {
  for (auto& option : options_.options_) {
    if (option.name == "threads" && !option.store) {
      option.help = "number of threads [all cores]";
      option.store = [this](const auto& values) {
        const auto count = parse_integer(values.back());
        if (count < 1 || count > most_threads) {
          refuse("found '" + values.back() + "', expected a whole number from 1 to " +
                 std::to_string(most_threads));
        }
        common_.threads = int(count);
      };
    }
  }
  for (auto& option : options_.options_)
    if (!option.provenance && !option.store)
      option.store = [this](const auto& values) { common_.log = values.back(); };
  const bool has_more = this->has_more();
  options_.add("config", common_.config, "FILE", "read further options from this INI file");
  options_.add("quiet,q", common_.quiet, "suppress warnings and progress");
  options_.add("verbose,v", common_.verbose, "print more");
  options_.add("help,h", common_.help, has_more ? "show the common options" : "show this help");
  if (has_more) options_.add("help-all", common_.help_all, "show all options, as the man page does");
  options_.add("version", common_.version, "show the version");
  if (has_more) options_.common({"config", "help-all"});
  const auto has_heading = [](const auto& option) { return !option.heading.empty(); };
  if (std::any_of(options_.options_.begin(), options_.options_.end(), has_heading))
    options_.headings({{is_declared("--threads") ? "threads" : "config", "General"}});
}

void Parser::parse(int argc, const char* const* argv) {
  // Who asks for help gets it, whatever else is wrong.
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    common_.help = common_.help || word == "--help" || word == "-h";
    common_.help_all = common_.help_all || word == "--help-all";
  }
  if (common_.help || common_.help_all) return;
  read_command_line(argc, argv);
  for (const auto& option : options_.options_) {
    if (option.name == "version" || option.name == "config") {
      const auto found = given_.find(option.name);
      if (found != given_.end()) in_place("--" + option.name, [&] { option.store(found->second); });
    }
  }
  if (common_.version) return;
  in_force_ = own_;
  if (given_.count("config")) read_config();
  store();
  check_rules();
}

void Parser::read_command_line(int argc, const char* const* argv) {
  po::options_description known;
  for (const auto& option : options_.options_) {
    const std::string name = option.name + (option.short_name.empty() ? "" : "," + option.short_name);
    if (option.placeholder.empty()) {
      known.add_options()(name.c_str(), "");
    } else {
      known.add_options()(name.c_str(), po::value<std::string>(), "");
    }
  }
  po::positional_options_description anywhere;
  anywhere.add("", -1);
  using namespace po::command_line_style;
  const std::vector<std::string> words(argv + 1, argv + argc);
  std::vector<po::option> parsed;
  try {
    parsed =
        po::command_line_parser(words).options(known).style(default_style & ~allow_guessing).run().options;
  } catch (const po::unknown_option& error) {
    std::string name = error.get_option_name();
    name = name.substr(0, name.find('='));
    const std::string meant = nearest(without_dashes(name), false);
    refuse("unknown option " + name +
           (meant.empty() ? std::string("; --help") + (has_more() ? "-all" : "") + " lists them all"
                          : "; did you mean --" + meant + "?"));
  } catch (const po::error_with_option_name& error) {
    const std::string name = without_dashes(error.get_option_name());
    refuse_without_value(name);
  } catch (const po::error& error) {
    refuse(error.what());
  }
  command_line_ = info_.name;
  for (const auto& option : parsed)
    if (option.string_key.empty()) {
      arguments_.insert(arguments_.end(), option.value.begin(), option.value.end());
      for (const auto& word : option.original_tokens) command_line_ += ' ' + quoted(word);
    }
  for (const auto& option : parsed) {
    if (!option.string_key.empty()) {
      // "--source --plan": Boost takes the next option for the value.
      if (option.original_tokens.size() == 2 && is_declared(option.original_tokens[1])) {
        refuse_without_value(option.string_key);
      }
      auto& values = given_[option.string_key];
      values.insert(values.end(), option.value.begin(), option.value.end());
      if (option.value.empty()) values.emplace_back();
      own_.insert(option.string_key);
    }
    if (!option.string_key.empty())
      add_to_command_line(option.string_key, option.value, option.original_tokens);
  }
}

bool Parser::is_provenance(const std::string& name) const {
  return !without_effect.count(name) &&
         std::none_of(options_.options_.begin(), options_.options_.end(),
                      [&](const auto& option) { return option.name == name && !option.provenance; });
}

/// `words`: the option as it is written. Names of outputs that split what is recorded change what is in each.
void Parser::add_to_command_line(const std::string& name, const std::vector<std::string>& values,
                                 const std::vector<std::string>& words) {
  const bool splits = name == "output" && !values.empty() && values.back().find('{') != std::string::npos;
  if (!is_provenance(name) && !splits) return;
  for (const auto& word : words) command_line_ += ' ' + quoted(word);
}

bool Parser::is_declared(const std::string& word) const {
  return std::any_of(options_.options_.begin(), options_.options_.end(), [&](const auto& option) {
    return word == "--" + option.name || (!option.short_name.empty() && word == "-" + option.short_name);
  });
}

void Parser::refuse_without_value(const std::string& name) const {
  for (const auto& option : options_.options_) {
    if (option.name != name && (option.short_name.empty() || option.short_name != name)) continue;
    if (option.placeholder.empty()) refuse("--" + option.name + ": is a switch, expected no value");
    refuse("--" + option.name + ": found no value, expected " + option.placeholder);
  }
  refuse("--" + name + ": found no value, expected one");
}

void Parser::read_config() {
  const std::string& path = common_.config;
  std::istringstream file(read_text(path));
  po::options_description known;
  for (const auto& option : options_.options_) {
    if (!not_in_config.count(option.name))
      known.add_options()(option.name.c_str(), po::value<std::string>(), "");
  }
  std::vector<po::option> parsed;
  try {
    parsed = po::parse_config_file(file, known, true).options;
  } catch (const po::invalid_config_file_syntax& error) {
    refuse(path + ": found '" + excerpt(error.tokens()) + "', expected NAME = VALUE");
  } catch (const po::error& error) {
    refuse(path + ": " + error.what());
  }
  Values from_file;
  for (const auto& option : parsed) {
    const auto& passed_over = options_.passed_over_;
    if (std::find(passed_over.begin(), passed_over.end(), option.string_key) != passed_over.end()) continue;
    if (option.unregistered) {
      const std::string meant = nearest(option.string_key, true);
      refuse(path + ": unknown option " + excerpt(option.string_key) +
             (meant.empty() ? "" : "; did you mean " + meant + "?"));
    }
    auto& values = from_file[option.string_key];
    values.insert(values.end(), option.value.begin(), option.value.end());
  }
  for (const auto& option : options_.options_) {
    const auto found = from_file.find(option.name);
    if (found == from_file.end() || given_.count(option.name) || is_excluded(option.name)) continue;
    in_place(path, [&] {
      if (!option.many && found->second.size() > 1) refuse(option.name + " is given twice, expected once");
      in_place(option.name, [&] { option.store(found->second); });
    });
    given_[option.name];  // present, already stored
    if (!option.placeholder.empty() || truth_of(found->second.back())) in_force_.insert(option.name);
    for (const auto& value : found->second) {
      if (!option.placeholder.empty())
        add_to_command_line(option.name, {value}, {"--" + option.name + "=" + value});
      else if (truth_of(value))
        add_to_command_line(option.name, {}, {"--" + option.name});
    }
  }
}

/// Whether the command line has an option that goes with no other of that name.
bool Parser::is_excluded(const std::string& name) const {
  return std::any_of(options_.rules_.begin(), options_.rules_.end(), [&](const auto& rule) {
    if (!rule.excludes) return false;
    const bool among = std::count(rule.others.begin(), rule.others.end(), name) > 0;
    return (among && own_.count(rule.name)) ||
           (rule.name == name && std::any_of(rule.others.begin(), rule.others.end(),
                                             [&](const auto& other) { return own_.count(other) > 0; }));
  });
}

void Parser::check_rules() const {
  for (const auto& rule : options_.rules_) {
    if (rule.excludes && in_force_.count(rule.name))
      for (const auto& other : rule.others)
        if (in_force_.count(other))
          refuse("found --" + rule.name + " and --" + other + ", expected one of them" +
                 (rule.why.empty() ? "" : ": " + rule.why));
    if (rule.excludes || !own_.count(rule.name)) continue;
    if (std::any_of(rule.others.begin(), rule.others.end(),
                    [&](const auto& other) { return in_force_.count(other) > 0; }))
      continue;
    std::vector<std::string> shown;
    for (const auto& other : rule.others) shown.push_back("--" + other);
    refuse("found --" + rule.name + " without " + joined(shown, " or ") + ", expected " +
           (shown.size() == 1 ? "both" : "one of them"));
  }
}

void Parser::store() {
  for (const auto& option : options_.options_) {
    const auto found = given_.find(option.name);
    const std::string name = "--" + option.name;
    if (found == given_.end()) {
      if (option.required) refuse(name + " is missing; expected " + name + " " + option.placeholder);
      continue;
    }
    if (found->second.empty()) continue;
    if (!option.many && !option.placeholder.empty() && found->second.size() > 1) {
      refuse(name + " is given twice, expected once");
    }
    in_place(name, [&] { option.store(found->second); });
  }
  std::size_t next = 0;
  for (const auto& positional : options_.positionals_) {
    const std::size_t left = arguments_.size() - next;
    if (left == 0) {
      if (positional.required)
        refuse(positional.placeholder + " is missing; usage: " + info_.name + " " + info_.synopsis);
      break;
    }
    const std::size_t count = positional.many ? left : 1;
    positional.store(
        {arguments_.begin() + std::ptrdiff_t(next), arguments_.begin() + std::ptrdiff_t(next + count)});
    next += count;
  }
  if (next < arguments_.size()) {
    const auto& options = options_.options_;
    const auto with_properties = std::find_if(options.begin(), options.end(), [](const auto& option) {
      return option.placeholder.find("NAME=VALUE") != std::string::npos;
    });
    if (with_properties != options.end() && arguments_[next].find('=') != std::string::npos)
      refuse("unexpected argument '" + arguments_[next] + "'; quote it together with what it is of: --" +
             with_properties->name + " '" + with_properties->placeholder + "'");
    refuse("unexpected argument '" + arguments_[next] + "'; usage: " + info_.name + " " + info_.synopsis);
  }
}

std::string Parser::nearest(const std::string& name, bool config) const {
  std::vector<std::string> names;
  for (const auto& option : options_.options_) {
    if (!config || !not_in_config.count(option.name)) names.push_back(option.name);
  }
  return nearest_of(names, name);
}

/// Are there options that --help does not show?
bool Parser::has_more() const {
  return std::any_of(options_.options_.begin(), options_.options_.end(),
                     [](const auto& option) { return option.common; });
}

std::string Parser::help() const {
  const bool all = common_.help_all || !has_more();
  std::string text =
      wrapped("Usage: " + info_.name + " " + info_.synopsis, 0, 7) + wrapped(info_.summary, 0, 0) + "\n";
  std::string heading, shown_heading;
  for (const auto& option : options_.options_) {
    if (!option.heading.empty()) heading = option.heading;
    if (option.help == hidden || !(all || option.common)) continue;
    if (heading != shown_heading) text += (shown_heading.empty() ? "" : "\n") + heading + ":\n";
    shown_heading = heading;
    std::string line = option.short_name.empty() ? "  --" : "  -" + option.short_name + ", --";
    line += option.name + (option.placeholder.empty() ? "" : " " + option.placeholder);
    if (line.size() + 2 > help_column)
      line += '\n' + std::string(help_column, ' ');
    else
      line.resize(help_column, ' ');
    std::string help = option.help;
    if (option.required) help += " (required)";
    if (!option.required && !option.shown_default.empty()) help += " [" + option.shown_default + "]";
    const std::string lines = wrapped(std::string(help_column, ' ') + help, help_column, help_column);
    text += line + lines.substr(help_column);
  }
  std::string example = wrapped("  " + info_.example, 2, 4);
  for (std::size_t at = 0; (at = example.find('\n', at)) + 1 < example.size(); at += 3)
    example.replace(at, 1, " \\\n");
  return text + "\nExample:\n" + example;
}

}  // namespace slipwave::cli
