// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/finer_model.hpp"

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/layers.hpp"
#include "model/tilted_mean.hpp"

namespace slipwave {
namespace {

/// Words of a command line, single quotes removed.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, any = false;
  for (const char c : command + ' ') {
    if (c == '\'') {
      quoted = !quoted;
      any = true;
    } else if (c == ' ' && !quoted) {
      if (any) words.push_back(word);
      word.clear();
      any = false;
    } else {
      word += c;
      any = true;
    }
  }
  return words;
}

struct LayersCommand {
  std::string size, step;
  std::vector<std::string> tops;
  std::vector<Layer> layers;
  InputUnits units;
  FitChoice choice;
  Average average = Average::tilted;
};

/// Nothing where the history is not one command of sw-layers.
std::optional<LayersCommand> command_of(const std::string& history) {
  if (history.find('\n') != std::string::npos) return std::nullopt;
  const auto words = words_of(history);
  if (words.empty() || words[0] != "sw-layers") return std::nullopt;
  LayersCommand command;
  for (std::size_t n = 1; n < words.size(); ++n) {
    auto word = words[n];
    std::string value;
    if (const auto equals = word.find('='); word.rfind("--", 0) == 0 && equals != std::string::npos) {
      value = word.substr(equals + 1);
      word.erase(equals);
    } else if (word == "--no-average") {
      command.average = Average::none;
      continue;
    } else if (n + 1 < words.size()) {
      value = words[n + 1];
    }
    if (word == "--size") command.size = value;
    if (word == "--step") command.step = value;
    if (word == "--layer") command.tops.push_back(value);
    if (word == "--units") command.units = InputUnits::parse(value);
    if (word == "--average") command.average = parse_average(value);
    if (word == "--fit") command.choice = parse_fit(value);
  }
  for (const auto& top : command.tops) command.layers.push_back(parse_layer(top, command.units));
  if (command.size.empty() || command.step.empty() || command.layers.empty()) return std::nullopt;
  return command;
}

Medium<2> medium_of(LayersCommand& command, double spacing_m, const Scene<2>& scene) {
  // What is left out is left out, and not an error, in other cells.
  command.choice.asked = false;
  const auto grid = grid_of_size<2>(parse_size<2>(command.size), spacing_m);
  const auto fit = fit_layers<2>(grid, command.layers, command.choice);
  auto medium = layered_medium<2>(fit.grid, command.layers, command.average, fit.rows);
  if (tilted_means(scene.model.medium) == 0) drop_tilted_means(medium);
  // Attenuation that was taken out (--without), and what was unrelaxed.
  for (const auto quality : {Property::qp, Property::qs})
    if (!scene.model.medium.has(quality)) medium[quality] = Field<2>();
  if (scene.attenuation) unrelax(medium, *scene.attenuation);
  return medium;
}

bool equal(const Medium<2>& a, const Medium<2>& b) {
  if (!(a.grid() == b.grid())) return false;
  for (const Property property : a.properties())
    if (!b.has(property) ||
        !std::equal(a[property].begin(), a[property].end(), b[property].begin(), b[property].end()))
      return false;
  return true;
}

}  // namespace

std::optional<Model<2>> finer_model(const Scene<2>& scene, double spacing_m) {
  const auto& model = scene.model;
  if (!model.fracture_sets.empty() || !model.prestress_pa.empty()) return std::nullopt;
  std::optional<LayersCommand> command;
  try {
    command = command_of(model.history);
    if (!command || !equal(medium_of(*command, parse_number(command->step), scene), model.medium))
      return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  Model<2> finer = model;
  finer.medium = medium_of(*command, spacing_m, scene);
  finer.fracture = {};
  return finer;
}

bool has_finer_geometry(const Scene<2>& scene) {
  return finer_model(scene, scene.model.grid().spacing_m).has_value();
}

}  // namespace slipwave
