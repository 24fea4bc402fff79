#include "model/property.hpp"

namespace slipwave {

const PropertyRow& row_of(Property property) { return material_properties()[std::size_t(property)]; }

std::optional<Property> find_property(const std::string& name) {
  for (const Property property : all_properties())
    if (row_of(property).name == name) return property;
  return {};
}

std::vector<Property> all_properties() {
  std::vector<Property> all;
  for (std::size_t n = 0; n < material_properties().size(); ++n) all.push_back(Property(n));
  return all;
}

std::vector<std::string> property_names() {
  std::vector<std::string> names;
  for (const auto& row : material_properties()) names.push_back(row.name);
  return names;
}

}  // namespace slipwave
