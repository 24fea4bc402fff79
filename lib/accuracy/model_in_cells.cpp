#include "accuracy/model_in_cells.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/layers.hpp"
#include "model/resample.hpp"
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

template <int D>
bool equal(const Medium<D>& a, const Medium<D>& b) {
  if (!(a.grid() == b.grid())) return false;
  for (const Property property : a.properties())
    if (!b.has(property) ||
        !std::equal(a[property].begin(), a[property].end(), b[property].begin(), b[property].end()))
      return false;
  return true;
}

}  // namespace

template <int D>
struct ModelInCells<D>::Command {
  std::string size, step;
  std::vector<std::string> tops;
  std::vector<Layer> layers;
  InputUnits units;
  FitChoice choice;
  Average average = Average::tilted;

  /// Null where the first line of a history is no command of sw-layers.
  static std::unique_ptr<Command> of(const std::string& history) {
    const auto words = words_of(history.substr(0, history.find('\n')));
    if (words.empty() || words[0] != "sw-layers") return nullptr;
    auto command = std::make_unique<Command>();
    for (std::size_t n = 1; n < words.size(); ++n) {
      auto word = words[n];
      std::string value;
      if (const auto equals = word.find('='); word.rfind("--", 0) == 0 && equals != std::string::npos) {
        value = word.substr(equals + 1);
        word.erase(equals);
      } else if (word == "--no-average") {
        command->average = Average::none;
        continue;
      } else if (n + 1 < words.size()) {
        value = words[n + 1];
      }
      command->take(word, value);
    }
    for (const auto& top : command->tops) command->layers.push_back(parse_layer(top, command->units));
    // What is left out is left out, and not an error, in other cells.
    command->choice.asked = false;
    const bool complete = !command->size.empty() && !command->step.empty() && !command->layers.empty();
    return complete ? std::move(command) : nullptr;
  }
  void take(const std::string& option, const std::string& value) {
    if (option == "--size") size = value;
    if (option == "--step") step = value;
    if (option == "--layer") tops.push_back(value);
    if (option == "--units") units = InputUnits::parse(value);
    if (option == "--average") average = parse_average(value);
    if (option == "--fit") choice = parse_fit(value);
  }
};

template <int D>
ModelInCells<D>::ModelInCells(const Scene<D>& scene) : scene_(scene) {
  try {
    command_ = Command::of(scene.model.history);
    if (command_ &&
        !equal(medium_of(parse_number(command_->step), command_->choice, false), scene.model.medium))
      command_.reset();
    if (command_ && on_faces()) command_->choice = {};
    tops_cut_cells_ = command_ && !scene.model.grid().rows && !on_faces();
  } catch (const Error&) {
    command_.reset();
  }
}

/// Whether every top lies on faces of the cells as they are. In other cells that takes rows that follow them.
template <int D>
bool ModelInCells<D>::on_faces() const {
  if (scene_.model.grid().rows) return false;
  const auto fit = fit_layers<D>(scene_.model.grid(), command_->layers, {});
  return !fit.grid.rows && fit.left_out.empty();
}

template <int D>
ModelInCells<D>::~ModelInCells() = default;

template <int D>
bool ModelInCells<D>::could_be_fitted() const {
  const auto& choice = command_ ? command_->choice : FitChoice{};
  return command_ && !(choice.surfaces && choice.floors && choice.layers);
}

template <int D>
std::size_t ModelInCells<D>::left_out(double spacing_m) const {
  if (!command_) return 0;
  const auto grid = grid_over<D>(parse_size<D>(command_->size), spacing_m);
  return fit_layers<D>(grid, command_->layers, command_->choice).left_out.size();
}

template <int D>
Medium<D> ModelInCells<D>::medium_of(double spacing_m, const FitChoice& choice, bool covered) const {
  const auto size = parse_size<D>(command_->size);
  const auto grid = covered ? grid_over<D>(size, spacing_m) : grid_of_size<D>(size, spacing_m);
  const auto fit = fit_layers<D>(grid, command_->layers, choice);
  auto medium = layered_medium<D>(fit.grid, command_->layers, command_->average, fit.rows);
  if (tilted_means(scene_.model.medium) == 0) drop_tilted_means(medium);
  // Attenuation that was taken out (--without), and what was unrelaxed.
  for (const auto quality : {Property::qp, Property::qs})
    if (!scene_.model.medium.has(quality)) medium[quality] = Field<D>();
  if (scene_.attenuation) unrelax(medium, *scene_.attenuation);
  return medium;
}

template <int D>
Model<D> ModelInCells<D>::with_medium(Medium<D> medium, double spacing_m) const {
  const bool fractured = !scene_.model.fracture_sets.empty() || !scene_.model.prestress_pa.empty();
  auto model = fractured ? regridded(scene_.model, spacing_m, Extent::covered) : scene_.model;
  if (!fractured) model.fracture = {};
  // Fractures stand in the cells of that grid.
  if (!fractured || model.grid() == medium.grid()) model.medium = std::move(medium);
  return model;
}

template <int D>
Model<D> ModelInCells<D>::of(double spacing_m) const {
  if (spacing_m == scene_.model.grid().spacing_m) return scene_.model;
  if (!command_) return regridded(scene_.model, spacing_m, Extent::covered);
  return with_medium(medium_of(spacing_m, command_->choice, true), spacing_m);
}

template <int D>
Model<D> ModelInCells<D>::fitted(double spacing_m) const {
  return with_medium(medium_of(spacing_m, {}, true), spacing_m);
}

template class ModelInCells<2>;
template class ModelInCells<3>;

}  // namespace slipwave
