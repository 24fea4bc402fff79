// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/error.hpp"
#include "base/words.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {
namespace {

std::string lower_attribute(const NetcdfFile& file, const std::string& variable, const std::string& name) {
  return lower(trimmed(file.text_attribute(variable, name).value_or("")));
}

std::string place_of(const NetcdfFile& file, const std::string& variable) {
  return file.shown_name() + ": " + variable + ": ";
}

/// "[3,4]": where value `n` of a block stands in its variable.
std::string element(std::size_t n, const std::vector<std::size_t>& start,
                    const std::vector<std::size_t>& count) {
  std::string place;
  for (std::size_t axis = count.size(); axis-- > 0; n /= count[axis])
    place = std::to_string(start[axis] + n % count[axis]) + (place.empty() ? "" : ",") + place;
  return place.empty() ? "" : "[" + place + "]";
}

const char* shown(VerticalSense sense) { return sense == VerticalSense::up ? "upwards" : "downwards"; }

/// What a name says of the way heights are counted; `words` are parts of it.
std::optional<VerticalSense> sense_of_name(const std::string& name) {
  const auto holds = [&](std::string_view word) { return name.find(word) != std::string::npos; };
  if (holds("depth")) return VerticalSense::down;
  if (holds("altitude") || holds("elevation") || holds("height") || holds("topo")) return VerticalSense::up;
  return {};
}

std::optional<VerticalSense> sense_of_positive(const NetcdfFile& file, const std::string& variable) {
  const auto given = file.text_attribute(variable, "positive");
  if (!given) return {};
  const auto word = lower(trimmed(*given));
  if (word == "up") return VerticalSense::up;
  if (word == "down") return VerticalSense::down;
  throw Error(place_of(file, variable) + "found positive '" + excerpt(*given) + "', expected up or down");
}

}  // namespace

UnitConversion conversion_of(const NetcdfFile& file, const std::string& variable, const std::string& into) {
  const auto unit = file.text_attribute(variable, "units");
  if (!unit || unit->find_first_not_of(' ') == std::string::npos) return {};
  const auto conversion =
      in_place(file.shown_name() + ": " + variable, [&] { return unit_conversion(*unit, into); });
  if (!conversion) throw Error(place_of(file, variable) + unit_refusal(*unit, into));
  return *conversion;
}

std::vector<double> values_in(const NetcdfFile& file, const std::string& variable, const std::string& into) {
  const auto shape = file.variable(variable).shape;
  return values_in(file, variable, into, std::vector<std::size_t>(shape.size(), 0), shape);
}

std::vector<double> values_in(const NetcdfFile& file, const std::string& variable, const std::string& into,
                              const std::vector<std::size_t>& start, const std::vector<std::size_t>& count) {
  auto values = file.get<double>(variable, start, count);
  const auto first = [&](const std::string& attribute) -> std::optional<double> {
    const auto numbers = file.number_attribute(variable, attribute);
    return numbers && !numbers->empty() ? std::optional(numbers->front()) : std::nullopt;
  };
  const auto fill = first("_FillValue"), missing = first("missing_value");
  const double scale = first("scale_factor").value_or(1), offset = first("add_offset").value_or(0);
  const auto conversion = conversion_of(file, variable, into);
  for (std::size_t n = 0; n < values.size(); ++n) {
    double& value = values[n];
    if (!std::isfinite(value) || value == fill || value == missing)
      throw Error(file.shown_name() + ": " + variable + element(n, start, count) + " is " +
                  (std::isinf(value) ? "infinite" : "missing (NaN or its _FillValue)") +
                  ", expected a number");
    value = value * scale + offset;
    if (conversion.changes()) value = conversion(value);
  }
  return values;
}

std::optional<VerticalSense> vertical_sense(const NetcdfFile& file, const std::string& variable) {
  const auto positive = sense_of_positive(file, variable);
  const auto standard = sense_of_name(lower_attribute(file, variable, "standard_name"));
  if (positive && standard && positive != standard)
    throw Error(place_of(file, variable) + "found positive '" +
                excerpt(*file.text_attribute(variable, "positive")) + "' and standard_name '" +
                excerpt(*file.text_attribute(variable, "standard_name")) + "', which counts " +
                shown(*standard) + ", expected them to agree (CF 4.3): correct one, as with ncatted");
  if (positive) return positive;
  if (standard) return standard;
  const auto by_name = sense_of_name(lower(variable));
  const auto described = sense_of_name(lower_attribute(file, variable, "long_name"));
  if (by_name && described && by_name != described)
    throw Error(place_of(file, variable) + "found long_name '" +
                excerpt(*file.text_attribute(variable, "long_name")) + "', which counts " +
                shown(*described) + ", expected the attribute positive to say which way " + variable +
                " counts");
  return by_name ? by_name : described;
}

bool names_height(const std::string& name) { return sense_of_name(lower(name)) == VerticalSense::up; }

bool is_vertical(const NetcdfFile& file, const std::string& dimension) {
  const auto name = lower(dimension);
  if (name == "z" || name == "nz" || sense_of_name(name)) return true;
  if (!file.has_variable(dimension)) return false;
  return lower_attribute(file, dimension, "axis") == "z" || file.text_attribute(dimension, "positive") ||
         sense_of_name(lower_attribute(file, dimension, "standard_name"));
}

bool is_horizontal(const NetcdfFile& file, const std::string& dimension, char axis) {
  const auto name = lower(dimension);
  if (name == std::string(1, axis) || name == std::string("n") + axis) return true;
  return file.has_variable(dimension) && lower_attribute(file, dimension, "axis") == std::string(1, axis);
}

std::vector<double> depths_of(const NetcdfFile& file, const std::string& variable) {
  auto depths = values_in(file, variable, "m");
  if (depths.empty()) return depths;
  const auto sense = vertical_sense(file, variable);
  const auto [least, largest] = std::minmax_element(depths.begin(), depths.end());
  // "depth" is what many call heights below zero, too.
  const bool said = sense == VerticalSense::up || file.text_attribute(variable, "positive") ||
                    (sense_of_name(lower_attribute(file, variable, "standard_name")) && *largest > 0);
  const bool named = sense || lower(variable) == "z";
  if (!said && (*least < 0 || !named))
    throw Error(place_of(file, variable) + "found " + slipwave::shown(*least) + " to " +
                slipwave::shown(*largest) +
                " m without the attribute positive, expected it to say whether they count up (" +
                slipwave::shown(0.0 - *largest) + " to " + slipwave::shown(0.0 - *least) +
                " m deep) or down: ncatted -a positive," + variable + ",c,c,up FILE");
  if (sense == VerticalSense::up)
    for (auto& depth : depths) depth = 0.0 - depth;
  return depths;
}

}  // namespace slipwave
