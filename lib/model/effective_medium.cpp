// SPDX-License-Identifier: BSD-3-Clause
#include "model/effective_medium.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {
namespace {

void check_springs(const SlipSystem<2>& system) {
  if (!system.compliance.gives())
    refuse("these planes have no compliance; expected --compliance, --stiffness or --crack-density");
  if (system.slides()) refuse("an effective medium does not slide, expected planes without friction");
  if (system.compliance.damped()) refuse("an effective medium has no dashpots, expected springs alone");
  if (std::abs(system.normal[0] * system.normal[1]) > 1e-9)
    refuse("planes dip by " + shown(dip_of_normal(system.normal), 4) +
           " degrees to the axes of the rock, expected planes along or across them (0 or 90)");
}

}  // namespace

Elasticity<2> effective_elasticity(const Elasticity<2>& rock, const std::vector<SlipSystem<2>>& systems) {
  const double determinant = rock(1, 1) * rock(3, 3) - rock(1, 3) * rock(1, 3);
  double s11 = rock(3, 3) / determinant, s33 = rock(1, 1) / determinant, s55 = 1 / rock(5, 5);
  const double s13 = -rock(1, 3) / determinant;
  for (const auto& system : systems) {
    check_springs(system);
    const auto of = compliance_in(system.compliance, rock(3, 3) - 2 * rock(5, 5), rock(5, 5));
    (std::abs(system.normal[0]) > 0.5 ? s11 : s33) += of.normal;
    s55 += of.tangential;
  }
  const double inverse = s11 * s33 - s13 * s13;
  return vertical_symmetry(s33 / inverse, -s13 / inverse, s11 / inverse, 1 / s55);
}

namespace {

/// Between -90 and 90 degrees.
double dip_between(double dip) {
  dip = std::fmod(dip, 180);
  return dip > 90 ? dip - 180 : dip <= -90 ? dip + 180 : dip;
}

/// Planes as beds that dip by so much see them; those along or across them are exactly so.
std::vector<SlipSystem<2>> seen_from(double tilt, std::vector<SlipSystem<2>> systems) {
  for (auto& system : systems) {
    const double dip = dip_between(dip_of_normal(system.normal) - tilt), whole = 90 * std::round(dip / 90);
    system.normal = normal_of_dip(std::abs(dip - whole) < 1e-4 ? std::abs(whole) : dip);
  }
  return systems;
}

/// The tilt of the axes of a rock full of these planes: of isotropic rock that of the planes, 0 where one
/// family is level.
double tilt_of(const Material& rock, const std::vector<SlipSystem<2>>& systems) {
  if (rock.is_anisotropic() || systems.empty()) return rock.tilt;
  const double dip = dip_of_normal(systems[0].normal);
  return is_oblique<2>(systems[0].normal) ? dip : 0;
}

}  // namespace

FractureCount make_effective(Model<2>& model, const std::vector<SlipSystem<2>>& systems,
                             const std::function<bool(const Point<2>&)>& inside) {
  FractureCount count;
  const auto cells = find_solid_cells(model, inside, count);
  auto& medium = model.medium;
  for (const auto property : {Property::epsilon, Property::delta})
    if (!medium.has(property)) medium[property] = Field<2>(medium.grid());
  for (const auto cell : cells) {
    const auto rock = material_of(medium, cell);
    if (rock.constants)
      refuse("the rock at " + place_of(model.grid(), std::int64_t(cell)) +
             " has elastic constants, expected speeds and parameters; leave --effective out");
    const double tilt = tilt_of(rock, systems);
    const auto of_beds = seen_from(tilt, systems);
    for (std::size_t n = 0; n < systems.size(); ++n)
      if (is_oblique<2>(of_beds[n].normal))
        refuse("planes dip by " + shown(dip_of_normal(systems[n].normal), 4) + " degrees in " +
               (rock.is_anisotropic() ? "rock whose beds dip by " : "rock with planes that dip by ") +
               shown(tilt, 4) + " at " + place_of(model.grid(), std::int64_t(cell)) +
               ", expected the same dip or a right angle to it; other planes are springs");
    const auto c = effective_elasticity(upright_elasticity<2>(rock), of_beds);
    if (c(3, 3) <= c(5, 5))
      refuse("in the cell at " + place_of(model.grid(), std::int64_t(cell)) +
             " P waves across the planes would be slower than S waves; expected less normal compliance, or "
             "leave --effective out and the planes are springs");
    auto effective = material_of(c, rock.rho);
    if (effective.is_anisotropic()) effective.tilt = tilt;
    if (effective.tilt != 0 && !medium.has(Property::tilt)) medium[Property::tilt] = Field<2>(medium.grid());
    put(medium, cell, effective);
  }
  return count;
}

}  // namespace slipwave
