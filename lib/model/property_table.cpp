#include <limits>

#include "model/property.hpp"

namespace slipwave {

// Nothing else may stand in this file: see material_properties().

std::span<const PropertyRow> material_properties() {
  constexpr double any = std::numeric_limits<double>::infinity();
  static const std::vector<std::string> m_s = {"m s-1", "m/s", "m s^-1"},
                                        km_s = {"km s-1", "km/s", "km s^-1"},
                                        kg_m3 = {"kg m-3", "kg/m3", "kg/m^3", "kg m^-3"},
                                        g_cm3 = {"g cm-3", "g/cm3", "g/cc", "g/cm^3", "g cm^-3"};
  // The order is that of the variables in a file.
  static const std::vector<PropertyRow> rows = {
      {"vp", "P-wave speed", "m s-1", "m/s", m_s, km_s, 0, any, Mean::elastic, {}},
      {"vs", "S-wave speed, 0 = fluid", "m s-1", "m/s", m_s, km_s, 0, any, Mean::elastic, {}},
      {"rho", "density, 0 = void", "kg m-3", "kg/m3", kg_m3, g_cm3, 0, any, Mean::elastic, {}},
  };
  return rows;
}

}  // namespace slipwave
