#include "model/property.hpp"

#include <limits>

namespace slipwave {

std::vector<PropertyRow> property_rows() {
  constexpr double any = std::numeric_limits<double>::infinity();
  const std::vector<std::string> m_s = {"m s-1", "m/s", "m s^-1"}, km_s = {"km s-1", "km/s", "km s^-1"},
                                 kg_m3 = {"kg m-3", "kg/m3", "kg/m^3", "kg m^-3"},
                                 g_cm3 = {"g cm-3", "g/cm3", "g/cc", "g/cm^3", "g cm^-3"};
  return {
      {"vp", "P-wave speed", "m s-1", "m/s", m_s, km_s, 0, any, Mean::elastic, {}},
      {"vs", "S-wave speed, 0 = fluid", "m s-1", "m/s", m_s, km_s, 0, any, Mean::elastic, {}},
      {"rho", "density, 0 = void", "kg m-3", "kg/m3", kg_m3, g_cm3, 0, any, Mean::elastic, {}},
  };
}

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
